"""A plan as a job of other queues: Open Job Description, run by its own program, and Flamenco, whose job type node runs.

    RNMBAKE_BINARY=build/release/rnmbake RNMBAKE_BUILD=build/release python3 tests/farm/export_check.py -v
"""
import json
import os
from pathlib import Path
import shutil
import subprocess
import sys
import tempfile
import unittest

sys.path.append(str(Path(__file__).resolve().parents[1] / "with_blender"))
from harness import LIMIT_SECONDS, OK, SCENES, USAGE, binary, run_blender, run_program  # noqa: E402

OPENJD = "openjd-cli==0.8.0"
SHIM = Path(__file__).resolve().parent / "flamenco_shim.js"
# By the model two passes, one for each half, and a task for each.
FLAGS = ("--resolution", "32", "--samples", "64", "--bounces", "0", "--save-scene", "never")
# What shells, format strings and JSON might read in a name.
FOLDER = "it's a \"farm\" of {{Param.Index}} $HOME; {blender} {{{ }}}"


class Export(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory(prefix="rnmbake-export-")
        cls.addClassCleanup(folder.cleanup)
        cls.folder = Path(folder.name) / FOLDER
        cls.folder.mkdir()
        run_blender(SCENES / "reuse_scene.py", cls.folder / "room.blend")
        cls.run_it("bake", "room.blend", "-o", "alone", "--cache", "alone cache", *FLAGS)
        cls.expected = cls.pictures("alone")

    @classmethod
    def run_it(cls, *words, code=OK):
        """In the folder, so that paths are relative to it."""
        return cls.run_program(binary(), *words, code=code)

    @classmethod
    def run_program(cls, program, *words, code=OK, cwd=None):
        return run_program(program, *words, code=code, cwd=cwd or cls.folder)

    @classmethod
    def pictures(cls, name):
        return {file.name: file.read_bytes() for file in sorted((cls.folder / name).glob("*.exr"))}

    def submit(self, queue, cache=None):
        return self.run_it("submit", "room.blend", "-o", queue, "--cache", cache or f"{queue} cache", *FLAGS,
                           "--task-minutes", "0.01", "--export", queue)

    def plan(self, queue):
        return self.folder / queue / ".rnmbake-plan"

    def check_result(self, queue):
        self.assertEqual(len(self.expected), 3)
        self.assertEqual(self.pictures(queue), self.expected)
        self.assertIn("2 tasks: 2 done", self.run_it("status", queue).stdout)
        self.assertIn("merged, with exit code 0", self.run_it("status", queue).stdout)


class OpenJobDescription(Export):
    @classmethod
    def setUpClass(cls):
        cls.openjd = cls.find_openjd()
        super().setUpClass()

    @classmethod
    def find_openjd(cls):
        """Of an environment in the build folder, made at the first run."""
        place = Path(os.environ.get("RNMBAKE_BUILD", "build/release")).resolve() / "openjd"
        program = place / "bin/openjd"
        for command in ([] if program.exists() else [[sys.executable, "-m", "venv", str(place)],
                                                     [str(place / "bin/pip"), "install", "--quiet", OPENJD]]):
            done = subprocess.run(command, capture_output=True, encoding="utf-8", timeout=LIMIT_SECONDS)
            if done.returncode != OK:
                last = (done.stdout + done.stderr).strip().splitlines()[-1:]
                raise unittest.SkipTest(f"SKIPPED: no {OPENJD} to test with, {' '.join(command)} fails: {last}")
        return str(program)

    def run_template(self, template):
        """Somewhere else, with the parameter that names the program."""
        with tempfile.TemporaryDirectory() as elsewhere:
            return self.run_program(self.openjd, "run", template, "-p", f"Rnmbake={binary()}", cwd=elsewhere)

    def test_steps(self):
        said = self.submit("openjd").stdout
        template = self.plan("openjd") / "openjd.json"
        self.assertIn("openjd.json", said)
        self.run_program(self.openjd, "check", template)
        self.assertIn("'bake' (2 total Tasks)", " ".join(self.run_program(self.openjd, "summary", template).stdout.split()))
        self.run_template(template)
        self.check_result("openjd")
        # Where all was baked before there is nothing left but the merge.
        self.submit("openjd", cache="alone cache")
        self.assertEqual([step["name"] for step in json.loads(template.read_text(encoding="utf-8"))["steps"]], ["merge"])
        self.run_program(self.openjd, "check", template)
        self.run_template(template)
        self.assertEqual(self.pictures("openjd"), self.expected)


class Flamenco(Export):
    @classmethod
    def setUpClass(cls):
        cls.node = shutil.which("node")
        if not cls.node:
            raise unittest.SkipTest("SKIPPED: no node to run a job type of Flamenco (Debian: nodejs)")
        super().setUpClass()

    def test_tasks(self):
        said = self.submit("flamenco").stdout
        self.assertIn("flamenco.json", said)
        job = self.plan("flamenco") / "flamenco.json"
        text = json.loads(job.read_text(encoding="utf-8"))
        self.assertEqual(text["type"], "rnmbake.flamenco")
        text["settings"]["rnmbake"] = binary()
        job.write_text(json.dumps(text), encoding="utf-8")
        tasks = json.loads(self.run_program(self.node, SHIM, self.plan("flamenco") / "rnmbake.flamenco.js", job).stdout)
        self.assertEqual([task["name"] for task in tasks], ["bake-0", "bake-1", "merge"])
        self.assertEqual([task["dependencies"] for task in tasks], [[], [], ["bake-0", "bake-1"]])
        with tempfile.TemporaryDirectory() as elsewhere:
            for task in tasks:
                (command,) = task["commands"]
                self.assertEqual(command["name"], "exec")
                self.run_program(command["parameters"]["exe"], *command["parameters"]["args"], cwd=elsewhere)
        self.check_result("flamenco")

    def test_names_that_no_job_can_hold(self):
        self.assertIn("rename it", self.run_it("submit", "room.blend", "-o", "a\nb", "--cache", "c", *FLAGS, "--export",
                                               "flamenco", code=USAGE).stderr)
        self.assertFalse((self.folder / "a\nb").exists())


if __name__ == "__main__":
    unittest.main()
