"""A scene of three objects baked alone, and as tasks of a plan: what the checks of this folder begin with."""
import hashlib
import json
from pathlib import Path
import subprocess
import sys
import tempfile
import unittest

sys.path.append(str(Path(__file__).resolve().parents[1] / "with_blender"))
from harness import LIMIT_SECONDS, OK, SCENES, binary, blender, environment, run_blender, run_program  # noqa: E402

# The model gives a texel-sample 3 us and a pass 10 s: four passes, one for each task.
MANY = ("--resolution", "64", "--samples", "512", "--bounces", "0", "--save-scene", "never")
TASKS = ("--task-minutes", "0.2")
# The box is the only object whose receivers reach above .6 and lie within .5 of the origin in x and y.
CRASHES_ON_BOX = """#!/bin/bash
for word in "$@"; do case $word in */request.json) request=$word;; esac; done
if [[ "$*" == *bake_entry.py* ]] && python3 - "$request" <<'PYTHON'
import array, json, os, sys
request = json.load(open(sys.argv[1]))
for atlas in request.get("atlases", []):
    with open(os.path.join(request["folder"], atlas["arrays"]), "rb") as stream:
        for group in atlas["groups"]:
            corners = array.array("f", stream.read(32 * group["corners"]))
            for i in range(0, 3 * group["corners"], 3):
                if .6 < corners[i + 2] < .8 and abs(corners[i + 1]) < .5:
                    sys.exit(0)
sys.exit(1)
PYTHON
then kill -SEGV $$; fi
exec "{blender}" "$@"
"""


def blenders_of(folder):
    """Processes of Blender whose files lie in the folder."""
    found = []
    for process in Path("/proc").glob("[0-9]*"):
        try:
            words = (process / "cmdline").read_bytes()
        except OSError:
            continue
        if b"bake_entry.py" in words and str(folder).encode() in words:
            found.append(process.name)
    return found


class Farm(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory(prefix="rnmbake-farm-")
        cls.addClassCleanup(folder.cleanup)
        cls.shared = Path(folder.name)
        cls.scene = cls.shared / "room.blend"
        run_blender(SCENES / "reuse_scene.py", cls.scene)
        cls.run_it("bake", cls.scene, "-o", cls.shared / "alone", "--cache", cls.shared / "alone-cache", *MANY)
        cls.expected = cls.pictures("alone")

    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="rnmbake-farm-")
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.plan = self.folder / "out" / ".rnmbake-plan"
        self.tmp = self.folder / "tmp"
        self.tmp.mkdir()

    @classmethod
    def run_it(cls, *words, code=OK, **more):
        return run_program(binary(), *words, code=code, **more)

    @classmethod
    def pictures(cls, folder):
        return {file.name: hashlib.sha256(file.read_bytes()).hexdigest()
                for file in sorted((cls.shared / folder).glob("*.exr"))}

    def submit(self, *flags, code=OK):
        return self.run_it("submit", self.scene, "-o", self.folder / "out", "--cache", self.folder / "cache", *MANY, *TASKS,
                           *flags, code=code)

    def tasks(self):
        return len(json.loads((self.plan / "plan.json").read_text(encoding="utf-8"))["tasks"])

    def merge_command(self, submitted):
        line = submitted.stdout.splitlines()[-1]
        self.assertTrue(line.startswith("rnmbake bake "), submitted.stdout)
        return line.replace("rnmbake", binary(), 1)

    def merge(self, submitted, code=OK):
        """With a Blender that can bake nothing."""
        blind = self.folder / "blind"
        blind.write_text(f'#!/bin/bash\n[[ "$*" == *bake_entry.py* ]] && exit 1\nexec "{blender()}" "$@"\n', encoding="utf-8")
        blind.chmod(0o755)
        done = subprocess.run(["bash", "-c", self.merge_command(submitted)], stdin=subprocess.DEVNULL, capture_output=True,
                              env={**environment(), "RNMBAKE_BLENDER": str(blind)}, encoding="utf-8",
                              timeout=LIMIT_SECONDS)
        self.assertEqual(done.returncode, code, done.stderr)
        return done

    def start_task(self, index):
        return subprocess.Popen([binary(), "task", "run", "--plan", str(self.plan), "--index", str(index)],
                                env=environment(TMPDIR=str(self.tmp)), stdin=subprocess.DEVNULL,
                                stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, encoding="utf-8")

    def result(self, index):
        file = self.plan / "tasks" / f"{index}.json"
        return json.loads(file.read_text(encoding="utf-8")) if file.exists() else None
