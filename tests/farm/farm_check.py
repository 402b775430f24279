"""A bake as tasks: planned, run in any order by several processes, killed and run again, merged; and on a real Slurm.

    RNMBAKE_BINARY=build/release/rnmbake python3 tests/farm/farm_check.py -v
"""
import hashlib
import json
import os
from pathlib import Path
import signal
import subprocess
import sys
import tempfile
import time
import unittest

sys.path.append(str(Path(__file__).resolve().parents[1] / "with_blender"))
from harness import LIMIT_SECONDS, OK, SCENES, TASKS_FAILED, USAGE, binary, blender, environment, run_blender  # noqa: E402
from slurm_cluster import Cluster, missing_programs  # noqa: E402

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
        done = subprocess.run([binary(), *map(str, words)], env=environment(**more), stdin=subprocess.DEVNULL,
                              capture_output=True, encoding="utf-8", timeout=LIMIT_SECONDS)
        if done.returncode != code:
            raise AssertionError(f"{words[0]} ended with {done.returncode}: {done.stderr}")
        return done

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


class Tasks(Farm):
    def test_any_order_and_one_killed(self):
        submitted = self.submit()
        count = self.tasks()
        self.assertGreaterEqual(count, 3)
        victim = self.start_task(count - 1)
        limit = time.time() + LIMIT_SECONDS
        while not blenders_of(self.tmp) and victim.poll() is None and time.time() < limit:
            time.sleep(0.05)
        victim.send_signal(signal.SIGKILL)
        victim.wait()
        victim.stderr.close()
        self.assertIsNone(self.result(count - 1))
        self.assertIn("1 begun", self.run_it("status", self.folder / "out").stdout)
        running = []
        for index in reversed(range(count)):
            running.append(self.start_task(index))
            if len(running) == 2:
                self.finish(running)
        self.finish(running)
        self.assertIn(f"{count} tasks: {count} done", self.run_it("status", self.plan).stdout)
        again = self.run_it("task", "run", "--plan", self.plan, "--index", 0)
        self.assertIn("in the cache already", again.stderr)
        self.merge(submitted)
        self.assertEqual(self.pictures(self.folder / "out"), self.expected)
        self.assertIn("merged, with exit code 0", self.run_it("status", self.plan).stdout)

    def finish(self, running):
        for process in running:
            _, said = process.communicate(timeout=LIMIT_SECONDS)
            self.assertEqual(process.returncode, OK, said)
        running.clear()

    def test_one_object_that_crashes(self):
        wrapper = self.folder / "blender"
        wrapper.write_text(CRASHES_ON_BOX.replace("{blender}", blender()), encoding="utf-8")
        wrapper.chmod(0o755)
        submitted = self.submit("--retries", "0")
        count = self.tasks()
        for index in range(count):
            broken = index == 1
            more = ("--blender", wrapper) if broken else ()
            self.run_it("task", "run", "--plan", self.plan, "--index", index, *more, code=TASKS_FAILED if broken else OK)
        self.assertEqual([one["object"] for one in self.result(1)["failed"]], ["box"])
        merged = self.merge(submitted, code=TASKS_FAILED)
        self.assertIn("SIGSEGV", merged.stderr)
        self.assertEqual(sorted(self.pictures(self.folder / "out")), ["floor.exr", "wall.exr"])
        status = self.run_it("status", self.plan).stdout
        self.assertIn(f"{count - 1} done, 1 failed", status)
        self.assertIn("box: ", status)
        # The task is run again where Blender is well, and all is as if nothing had happened.
        self.run_it("task", "run", "--plan", self.plan, "--index", 1)
        self.merge(submitted)
        self.assertEqual(self.pictures(self.folder / "out"), self.expected)

    def test_merge_before_the_tasks_bakes_nothing(self):
        submitted = self.submit()
        said = self.merge(submitted, code=TASKS_FAILED).stderr
        self.assertIn("has left no result; run it", said)
        for index in range(self.tasks()):
            self.run_it("task", "run", "--plan", self.plan, "--index", index)
        self.merge(submitted)
        self.assertEqual(self.pictures(self.folder / "out"), self.expected)

    def test_refusals(self):
        for flags, word in ((("--noise", "1"), "--samples"), (("--time", "1m"), "--samples"),
                            (("--cache", "none"), "--cache DIR"), (("--recipe", "flat-normal-map"), "--recipe receiver")):
            self.assertIn(word, self.submit(*flags, code=USAGE).stderr)
        self.assertFalse((self.folder / "out").exists())

    def test_another_cache_is_noticed(self):
        self.submit()
        (self.folder / "cache").rename(self.folder / "elsewhere")
        ended = self.run_it("task", "run", "--plan", self.plan, "--index", 0, code=4)
        self.assertIn("is that folder shared?", ended.stderr)
        self.assertEqual(self.result(0)["outcome"], "failed")


class Slurm(Farm):
    """The commands of docs/farm.md, on a cluster of two nodes."""
    @classmethod
    def setUpClass(cls):
        missing = missing_programs()
        if missing:
            raise unittest.SkipTest(f"SKIPPED: no Slurm to test with, {', '.join(missing)} are missing "
                                    "(Debian: slurmctld slurmd slurm-client munge), or this is not root")
        super().setUpClass()
        cls.cluster = Cluster()
        cls.addClassCleanup(cls.cluster.stop)
        cls.cluster.start()

    def sbatch(self, *flags):
        done = subprocess.run(["sbatch", "--parsable", "--output", f"{self.folder}/log-%j", *flags], stdin=subprocess.DEVNULL,
                              env=self.cluster.environment(environment()), capture_output=True, encoding="utf-8", timeout=60)
        self.assertEqual(done.returncode, OK, done.stderr)
        return done.stdout.strip()

    def states(self, job):
        done = subprocess.run(["squeue", "-h", "-r", "-t", "all", "-j", job, "-o", "%T"], encoding="utf-8", timeout=60,
                              env=self.cluster.environment(environment()), capture_output=True)
        return done.stdout.split()

    def nodes(self, job):
        done = subprocess.run(["squeue", "-h", "-r", "-t", "all", "-j", job, "-o", "%N"], encoding="utf-8", timeout=60,
                              env=self.cluster.environment(environment()), capture_output=True)
        return set(done.stdout.split())

    def array(self):
        run = f"exec {binary()} task run --plan {self.plan} --index $SLURM_ARRAY_TASK_ID"
        return self.sbatch(f"--array=0-{self.tasks() - 1}", "--requeue", "--open-mode=append", "--wrap", run)

    def wait_for(self, what):
        limit = time.time() + LIMIT_SECONDS
        while not what():
            self.assertLess(time.time(), limit, "it takes too long")
            time.sleep(0.5)

    def test_array_and_merge(self):
        submitted = self.submit()
        job = self.array()
        merge = self.sbatch(f"--dependency=afterany:{job}", "--wrap", f"cd {os.getcwd()} && {self.merge_command(submitted)}")
        self.wait_for(lambda: (self.plan / "merged.json").exists())
        self.wait_for(lambda: self.states(merge) == ["COMPLETED"])
        self.assertEqual(self.pictures(self.folder / "out"), self.expected)
        self.assertEqual(self.nodes(job), {"n1", "n2"})

    def test_scancel_leaves_no_blender(self):
        self.submit()
        job = self.array()
        self.wait_for(lambda: blenders_of("request.json"))
        subprocess.run(["scancel", job], env=self.cluster.environment(environment()), check=True, timeout=60)
        self.wait_for(lambda: set(self.states(job)) == {"CANCELLED"})
        self.wait_for(lambda: not blenders_of("request.json"))


if __name__ == "__main__":
    unittest.main()
