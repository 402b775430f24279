"""Scenes whose scripts try to get out, through the real rnmbake, Blender and bubblewrap; without --sandbox the same
scripts succeed, so that none passes for want of trying.

    RNMBAKE_BINARY=build/release/rnmbake python3 tests/with_blender/sandbox/sandbox_check.py
"""
import json
import os
from pathlib import Path
import shutil
import socket
import subprocess
import sys
import tempfile
import time
import unittest

sys.path.append(str(Path(__file__).resolve().parents[1]))
from harness import (ENVIRONMENT, INVALID_INPUT, OK, TASKS_FAILED, USAGE, LIMIT_SECONDS, binary, blender,  # noqa: E402
                     environment, run_blender)

HERE = Path(__file__).resolve().parent
QUICK = ("--resolution", "16", "--samples", "4", "--uv", "UVMap", "--cache", "none")  # what is kept was baked in no sandbox
OUTLIVES_SECONDS = 7  # one more than the process that prisoner.py leaves behind
HARMLESS = {"read scene", "write launch"}


def doctor(**more):
    done = subprocess.run([binary(), "doctor", "--json"], env=environment(**more), capture_output=True, encoding="utf-8",
                          timeout=LIMIT_SECONDS)
    return json.loads(done.stdout)["sandbox"]


class Sandboxed(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        sandbox = doctor()
        if not sandbox["usable"]:
            raise unittest.SkipTest(f"SKIPPED: no sandbox on this machine: {sandbox['why_not']}")
        if Path(blender()).read_bytes().startswith(b"#!"):
            raise unittest.SkipTest(f"SKIPPED: {blender()} is a script that starts a Blender elsewhere, which the sandbox hides")
        folder = tempfile.TemporaryDirectory(prefix="rnmbake-sandbox-")
        cls.addClassCleanup(folder.cleanup)
        cls.top = Path(folder.name)
        for name in ("scene", "home", "outside", "tmp"):
            (cls.top / name).mkdir()
        (cls.top / "home" / "diary").write_text("dear diary")

    def setUp(self):
        self.listener = socket.create_server(("127.0.0.1", 0))
        self.addCleanup(self.listener.close)
        self.places = {"beside": str(self.top / "scene" / "beside"), "outside": str(self.top / "outside" / "file"),
                       "home": str(self.top / "home" / "diary"), "scene": str(self.top / "scene" / "wall.png"),
                       "port": self.listener.getsockname()[1]}
        (self.top / "scene" / "wall.png").unlink(missing_ok=True)
        for name in ("tmp", "outside"):
            shutil.rmtree(self.top / name)
            (self.top / name).mkdir()

    def make(self, case):
        scene = self.top / "scene" / f"{case or 'plain'}.blend"
        places = dict(self.places, scene=__file__) if case == "" else self.places
        run_blender(HERE / "sandbox_scene.py", scene, case, json.dumps(places))
        return scene

    def bake(self, scene, out, *flags, command="bake", **more):
        env = environment(HOME=str(self.top / "home"), TMPDIR=str(self.top / "tmp"), A_SECRET_TOKEN="hush", **more)
        return subprocess.run([binary(), command, str(scene), "-o", str(self.top / out), *QUICK, *flags], env=env,
                              stdin=subprocess.DEVNULL, capture_output=True, encoding="utf-8", timeout=LIMIT_SECONDS)

    def findings(self):
        """Of the survey, which is a launch's first."""
        files = sorted((self.top / "tmp").glob("*/*/findings.json"))
        self.assertTrue(files, "no script of the scene has run")
        return json.loads(files[0].read_text())

    def outlived(self):
        """Has a process left a mark in the folder of its launch, where it may write? No other test's process can:
        its folder is gone."""
        time.sleep(OUTLIVES_SECONDS)
        return any((self.top / "tmp").glob("*/*/outlived"))

    def called(self):
        self.listener.setblocking(False)
        try:
            self.listener.accept()[0].close()
            return True
        except BlockingIOError:
            return False


class Escapes(Sandboxed):
    def test_all_succeed_without_a_sandbox(self):
        """Beside those that need root."""
        ended = self.bake(self.make("escape"), "free", "--allow-scripts", "--keep-temporary")
        self.addCleanup(lambda: Path("/tmp/rnmbake-sandbox-check").unlink(missing_ok=True))
        for path in ("/usr/rnmbake-sandbox-check", "/etc/rnmbake-sandbox-check", "/dev/shm/rnmbake-sandbox-check",
                     self.places["beside"]):
            self.addCleanup(lambda path=path: Path(path).unlink(missing_ok=True))
        self.assertEqual(ended.returncode, OK, ended.stderr)
        found = self.findings()
        needs_root = {"write usr", "write etc"} if os.geteuid() else set()
        failed = {what for what, result in found.items() if what != "processes" and not result[0]}
        self.assertEqual(failed, needs_root, found)
        self.assertTrue(self.called())

    def test_none_succeeds_in_it(self):
        ended = self.bake(self.make("escape"), "held", "--allow-scripts", "--keep-temporary", "--sandbox")
        self.assertEqual(ended.returncode, OK, ended.stderr)
        found = self.findings()
        succeeded = {what for what, result in found.items() if what != "processes" and result[0]}
        self.assertEqual(succeeded, HARMLESS, found)
        self.assertLessEqual(found["processes"], 4, "it sees processes that are not its own")
        self.assertFalse(self.called())
        for file in ("beside", "outside"):
            self.assertFalse(os.path.exists(self.places[file]))
        self.assertFalse(self.outlived(), "something has outlived the run")

    def test_a_link_among_the_results_is_refused(self):
        ended = self.bake(self.make("link"), "linked", "--allow-scripts", "--sandbox")
        self.assertEqual(ended.returncode, INVALID_INPUT, ended.stderr)
        self.assertIn("a-picture.bin", ended.stderr)


class Results(Sandboxed):
    def test_do_not_come_into_the_cache(self):
        """A scene that runs scripts can say that it is another one."""
        cache = self.top / "home" / ".cache" / "rnmbake"
        command = [binary(), "bake", str(self.make("")), "--resolution", "16", "--samples", "4", "-o"]
        env = environment(HOME=str(self.top / "home"), TMPDIR=str(self.top / "tmp"), XDG_CACHE_HOME=str(cache.parent))
        del env["RNMBAKE_CACHE"]
        for flags, kept in (([str(self.top / "strange"), "--sandbox"], False), ([str(self.top / "own")], True)):
            done = subprocess.run([*command, *flags], env=env, stdin=subprocess.DEVNULL, capture_output=True,
                                  encoding="utf-8", timeout=LIMIT_SECONDS)
            self.assertEqual(done.returncode, OK, done.stderr)
            self.assertEqual(cache.exists() and any(cache.rglob("*")), kept)

    def test_are_the_same_to_the_byte(self):
        scene = self.make("")
        for out, flags in (("plain", ()), ("sandboxed", ("--sandbox",))):
            ended = self.bake(scene, out, "--save-scene", "always", *flags)
            self.assertEqual(ended.returncode, OK, ended.stderr)
            self.assertNotIn("missing", ended.stderr)
        plain, sandboxed = self.top / "plain", self.top / "sandboxed"
        self.assertEqual(sorted(file.name for file in plain.iterdir()), sorted(file.name for file in sandboxed.iterdir()))
        pictures = list(plain.glob("**/*.exr"))
        self.assertTrue(pictures)
        for picture in pictures:
            self.assertEqual(picture.read_bytes(), (sandboxed / picture.relative_to(plain)).read_bytes())
        for folder in (plain, sandboxed):
            self.assertGreater((folder / "plain.lightmap-uvs.blend").stat().st_size, 1000)

    def test_saved_scene_beside_the_scene(self):
        """The folder that is read is the one that is written to: it holds the copy, and what the sandbox could not touch."""
        scene = self.make("")
        before = scene.read_bytes()
        ended = self.bake(scene, "scene", "--save-scene", "always", "--sandbox")
        self.assertEqual(ended.returncode, OK, ended.stderr)
        self.assertNotIn("missing", ended.stderr)
        self.assertEqual(scene.read_bytes(), before)
        self.assertGreater((self.top / "scene" / "plain.lightmap-uvs.blend").stat().st_size, 1000)

    def test_pictures_elsewhere_are_named_and_can_be_shown(self):
        scene, elsewhere = self.make(""), self.top / "outside" / "wall.png"
        shutil.move(self.top / "scene" / "wall.png", elsewhere)
        (self.top / "scene" / "wall.png").symlink_to(elsewhere)
        hidden = self.bake(scene, "hidden", "--sandbox")
        self.assertIn("picture missing: " + str(self.top / "scene" / "wall.png"), hidden.stderr)
        shown = self.bake(scene, "shown", "--sandbox", "--sandbox-read", str(elsewhere.parent))
        self.assertEqual(shown.returncode, OK, shown.stderr)
        self.assertNotIn("wall.png", shown.stderr)


class Limits(Sandboxed):
    def test_memory(self):
        scene = self.make("memory")
        for flags in ((), ("--sandbox",)):
            with self.subTest(flags=flags):
                ended = self.bake(scene, "hoard", "--allow-scripts", "--memory-max", "700", "--retries", "0", *flags)
                self.assertEqual(ended.returncode, TASKS_FAILED, ended.stderr)
                self.assertIn("used more than 700 MiB", ended.stderr)
                self.assertIn("--memory-max", ended.stderr)

    def test_time(self):
        ended = self.bake(self.make("memory"), "slow", "--allow-scripts", "--sandbox", "--launch-timeout", "1")
        self.assertEqual(ended.returncode, TASKS_FAILED, ended.stderr)
        self.assertIn("longer than the limit of 1 s", ended.stderr)


class Refusals(Sandboxed):
    def test_a_scene_in_the_home_folder(self):
        scene = self.make("")
        shutil.copy(scene, self.top / "home" / "scene.blend")
        ended = self.bake(self.top / "home" / "scene.blend", "out", "--sandbox")
        self.assertEqual(ended.returncode, USAGE, ended.stderr)
        self.assertIn("home folder", ended.stderr)

    def test_no_bubblewrap(self):
        tools = self.top / "tools"
        tools.mkdir()
        (tools / "blender").symlink_to(shutil.which("blender") or "/usr/bin/blender")
        ended = self.bake(self.make(""), "out", "--sandbox", PATH=str(tools))
        self.assertEqual(ended.returncode, ENVIRONMENT, ended.stderr)
        self.assertIn("apt install bubblewrap", ended.stderr)
        self.assertIn("apt install bubblewrap", doctor(PATH=str(tools))["why_not"])

    def test_no_namespaces(self):
        """As where the kernel forbids them: in a sandbox that lets nobody make another."""
        jail = ["bwrap", "--unshare-user", "--uid", "1000", "--disable-userns", "--cap-drop", "ALL", "--dev-bind", "/", "/"]
        done = subprocess.run([*jail, binary(), "doctor"], env=environment(TMPDIR=str(self.top / "tmp")),
                              capture_output=True, encoding="utf-8", timeout=LIMIT_SECONDS)
        self.assertIn("sandbox       no", done.stdout)
        self.assertIn("user namespaces", done.stdout)


if __name__ == "__main__":
    unittest.main()
