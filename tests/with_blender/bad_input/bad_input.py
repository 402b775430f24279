"""Runs the real rnmbake on the scenes of with_blender/scenes/bad_input_cases.py and looks at what it leaves behind."""
import json
import os
from pathlib import Path
import stat
import subprocess
import sys
import tempfile
import time
import unittest

sys.path.append(str(Path(__file__).resolve().parents[1]))
from harness import OK, SCENES, binary, blender, environment, run_blender  # noqa: E402

LIMIT_SECONDS = 300
QUICK = ("--resolution", "8", "--samples", "1", "--dilate", "0")


class Ended:
    def __init__(self, code, out, err):
        self.code, self.out, self.err = code, out, err
        self.errors = [line for line in err.splitlines() if line.startswith("rnmbake: error: ")]


class BadInput(unittest.TestCase):
    """One folder of scenes for each class, one empty output folder for each test."""

    @classmethod
    def setUpClass(cls):
        cls._folder = tempfile.TemporaryDirectory(prefix="rnmbake-bad-input-")
        cls.addClassCleanup(cls._folder.cleanup)
        cls.scenes = Path(cls._folder.name) / "scenes"
        cls.scenes.mkdir()
        run_blender(SCENES / "bad_input_cases.py", cls.scenes)

    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="case-", dir=self._folder.name)
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.out = self.folder / "out"
        self.temporary = self.folder / "tmp"
        self.temporary.mkdir()

    def environment(self, **more):
        return environment(LC_ALL="C.UTF-8", TMPDIR=str(self.temporary), **more)

    def arguments(self, scene, *flags):
        path = scene if os.path.isabs(str(scene)) else self.scenes / scene
        return [binary(), "bake", str(path), "-o", str(self.out), *QUICK, *flags]

    def bake(self, scene, *flags, **more):
        done = subprocess.run(self.arguments(scene, *flags), env=self.environment(**more), stdin=subprocess.DEVNULL,
                              capture_output=True, encoding="utf-8", timeout=LIMIT_SECONDS)
        return Ended(done.returncode, done.stdout, done.stderr)

    def start(self, project):
        """A project file without further flags, going on in the background in a process group of its own."""
        return subprocess.Popen([binary(), "bake", str(project), "-o", str(self.out), "--jobs", "1"],
                                env=self.environment(), stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                                stderr=subprocess.PIPE, encoding="utf-8", start_new_session=True)

    def assert_refused(self, ended, code, *words):
        """One error line with all these words, the exit code, and nothing left anywhere."""
        self.assertEqual(ended.code, code, ended.err)
        self.assert_one_error(ended, *words)
        self.assert_nothing_left()

    def assert_one_error(self, ended, *words):
        self.assertEqual(len(ended.errors), 1, ended.err)
        for word in words:
            self.assertIn(word, ended.errors[0])

    def assert_nothing_left(self):
        self.assertEqual(files_in(self.out), [])
        self.assert_tidy()

    def assert_tidy(self):
        self.assertEqual(files_in(self.temporary), [], "temporary files are left")

    def manifest(self):
        return json.loads((self.out / "manifest.json").read_text(encoding="utf-8"))

    def lightmaps(self):
        return [name for name in files_in(self.out) if name.endswith(".exr")]

    def assert_whole(self, name):
        """An EXR that the program itself can read to its end."""
        decoded = self.folder / "decoded.exr"
        done = subprocess.run([binary(), "decode", str(self.out / name), "--variant", "single", "--normal",
                               str(flat_normal(self.folder)), "-o", str(decoded)],
                              capture_output=True, encoding="utf-8", timeout=60)
        self.assertEqual(done.returncode, OK, done.stderr)

    def fake_blender(self, script):
        """A program in the place of Blender; $BLENDER is the real one, $REQUEST the launch's request.json."""
        path = self.folder / "fake-blender"
        path.write_text("#!/bin/bash\n" f"BLENDER={blender()}\n" 'REQUEST="${@: -1}"\n' + script, encoding="utf-8")
        path.chmod(path.stat().st_mode | stat.S_IXUSR)
        return str(path)


def files_in(folder):
    """Names relative to the folder, hidden ones too."""
    if not Path(folder).is_dir():
        return []
    return sorted(str(path.relative_to(folder)) for path in Path(folder).rglob("*") if not path.is_dir())


def flat_normal(folder):
    """A 1 x 1 picture (PPM) of the straight-up normal."""
    path = Path(folder) / "normal.ppm"
    path.write_bytes(b"P6 1 1 255\n" + bytes((128, 128, 255)))
    return path


def children_of(pid):
    """All processes below `pid`, from /proc."""
    parents = {}
    for entry in Path("/proc").iterdir():
        if not entry.name.isdigit():
            continue
        try:
            fields = (entry / "stat").read_text().rpartition(")")[2].split()
        except OSError:
            continue
        if fields[0] != "Z":
            parents[int(entry.name)] = int(fields[1])
    found, added = {pid}, True
    while added:
        more = {child for child, parent in parents.items() if parent in found} - found
        found |= more
        added = bool(more)
    return found - {pid}


def wait_for(condition, seconds=60):
    """Whether it came true in time."""
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        if condition():
            return True
        time.sleep(0.05)
    return False
