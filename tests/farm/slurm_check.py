"""Plans in the hands of a real Slurm of two nodes: handed in, waited for, failing, losing a node, cancelled.

    RNMBAKE_BINARY=build/release/rnmbake python3 tests/farm/slurm_check.py -v
"""
import json
from pathlib import Path
import subprocess
import time
import unittest

from farm_case import CRASHES_ON_BOX, MANY, TASKS, Farm, blenders_of
from harness import ENVIRONMENT, IO, LIMIT_SECONDS, OK, TASKS_FAILED, USAGE, binary, blender, environment
from slurm_cluster import Cluster, missing_programs

LOCK_HELD = 8


def variable(process, name):
    """Of a process's environment; "" where it has ended or has none."""
    try:
        words = Path(f"/proc/{process}/environ").read_bytes().decode(errors="replace").split("\0")
    except OSError:
        return ""
    return next((word.partition("=")[2] for word in words if word.startswith(name + "=")), "")


class Slurm(Farm):
    @classmethod
    def setUpClass(cls):
        missing = missing_programs()
        if missing:
            raise unittest.SkipTest(f"SKIPPED: no Slurm to test with, {', '.join(missing)} missing "
                                    "(Debian: slurmctld slurmd slurm-client munge; as root)")
        super().setUpClass()
        cls.cluster = Cluster()
        cls.addClassCleanup(cls.cluster.stop)
        cls.cluster.start()

    def setUp(self):
        super().setUp()
        self.addCleanup(lambda: self.plan.exists() and self.slurm("cancel", self.plan, code=None))

    def call(self, *words, code=OK):
        """How a command ended that sees the cluster."""
        done = subprocess.run([*map(str, words)], env=self.cluster.environment(environment(TMPDIR=str(self.tmp))),
                              stdin=subprocess.DEVNULL, capture_output=True, encoding="utf-8", timeout=LIMIT_SECONDS)
        if code is not None:
            self.assertEqual(done.returncode, code, f"{words}: {done.stdout}{done.stderr}")
        return done

    def slurm(self, *words, code=OK):
        return self.call(binary(), *words, code=code)

    def hand_in(self, *flags, code=OK):
        return self.slurm("submit", self.scene, "-o", self.folder / "out", "--cache", self.folder / "cache", *MANY, *TASKS,
                          "--executor", "slurm", *flags, code=code)

    def wrapper(self, text):
        file = self.folder / "blender"
        file.write_text(text.replace("{blender}", blender()), encoding="utf-8")
        file.chmod(0o755)
        return file

    def jobs(self):
        return json.loads((self.plan / "slurm" / "jobs.json").read_text(encoding="utf-8"))

    def queue(self, columns, *more):
        name = self.jobs()["name"]
        return self.call("squeue", "-h", "-r", "--name", name, "-o", columns, *more).stdout.split()

    def until(self, what):
        limit = time.time() + LIMIT_SECONDS
        while not what():
            self.assertLess(time.time(), limit, "it takes too long")
            time.sleep(0.05)

    def blender_on(self, node):
        return [one for one in blenders_of(self.tmp) if variable(one, "SLURMD_NODENAME") == node]

    def hosts(self):
        return {self.result(index)["host"] for index in range(self.tasks())}

    def test_two_nodes_make_the_same_lightmaps(self):
        said = self.hand_in().stdout
        self.assertIn(f"rnmbake wait {self.plan}", said)
        count = self.tasks()
        arrays = self.jobs()["arrays"]
        self.assertEqual([(one["first"], one["count"]) for one in arrays],
                         [(first, min(3, count - first)) for first in range(0, count, 3)], "MaxArraySize is 3")
        self.assertGreater(len(arrays), 1)
        self.assertRegex(self.slurm("status", self.plan).stdout, r"Slurm: \d running.*waiting")
        self.slurm("wait", self.folder / "out")
        self.assertEqual(self.pictures(self.folder / "out"), self.expected)
        self.assertEqual(self.hosts(), {"n1", "n2"})
        self.assertIn("merged, with exit code 0", self.slurm("status", self.plan).stdout)
        self.assertEqual(list((self.folder / "out").glob(".rnmbake-farm-*")), [])

    def test_a_lost_node_is_made_up_for(self):
        self.hand_in()
        self.until(lambda: self.blender_on("n2"))
        self.cluster.kill_node("n2")
        lost = [index for index in range(self.tasks()) if self.result(index) is None]
        self.addCleanup(self.cluster.wait, lambda: self.cluster.idle() == ["n1", "n2"])
        self.addCleanup(self.cluster.start_node, "n2")
        self.slurm("wait", self.plan)
        self.assertEqual(self.pictures(self.folder / "out"), self.expected)
        self.assertEqual({self.result(index)["host"] for index in lost}, {"n1"})

    def test_a_restarted_controller_loses_nothing(self):
        self.hand_in()
        self.until(lambda: blenders_of(self.tmp))
        time.sleep(4)  # Slurm writes down what it was given every few seconds
        waiting = subprocess.Popen([binary(), "wait", str(self.plan)], stdin=subprocess.DEVNULL, stderr=subprocess.PIPE,
                                   env=self.cluster.environment(environment(TMPDIR=str(self.tmp))), encoding="utf-8")
        self.cluster.kill_controller()
        time.sleep(2)
        self.cluster.start_controller()
        _, said = waiting.communicate(timeout=LIMIT_SECONDS)
        self.assertEqual(waiting.returncode, OK, said)
        self.assertEqual(self.pictures(self.folder / "out"), self.expected)

    def test_a_failing_object_stops_its_own_merge_alone(self):
        self.hand_in("--retries", "0", "--blender", self.wrapper(CRASHES_ON_BOX))
        said = self.slurm("wait", self.plan, code=TASKS_FAILED).stderr
        self.assertRegex(said, r"box: .*SIGSEGV.*\(task \d on n[12]\)")
        self.assertEqual(sorted(self.pictures(self.folder / "out")), ["floor.exr", "wall.exr"])
        self.assertIn("box: ", self.slurm("status", self.plan).stdout)

    def test_cancel_leaves_no_blender(self):
        self.hand_in()
        self.until(lambda: blenders_of(self.tmp))
        self.assertIn("rnmbake cancel", self.hand_in(code=LOCK_HELD).stderr)
        self.assertIn("ended", self.slurm("cancel", self.plan).stderr)
        self.assertEqual(blenders_of(self.tmp), [])
        self.assertEqual(self.queue("%i"), [])
        self.assertIn("nothing of it runs", self.slurm("cancel", self.folder / "out").stderr)
        self.assertIn("was cancelled, and nothing was merged", self.slurm("wait", self.plan, code=IO).stderr)
        self.assertIn("cancelled", self.slurm("status", self.plan).stdout)

    def test_jobs_that_somebody_else_ended(self):
        self.hand_in("--slurm-arg=--hold")
        self.assertIn("held", self.slurm("status", self.plan).stdout)
        self.call("scancel", "--name", self.jobs()["name"])
        said = self.slurm("wait", self.plan, code=IO).stderr
        self.assertIn("has no job in Slurm any more", said)

    def unseen(self, folder, *flags):
        """What a wait says where n2, which has all jobs, sees an empty folder in that place; and how it ends."""
        self.hand_in("--slurm-arg=--nodelist=n2", "--slurm-arg=--hold", *flags)
        self.cluster.hide("n2", folder)
        try:
            self.call("scontrol", "release", *[one["id"] for one in self.jobs()["arrays"]], self.jobs()["merge"])
            return self.slurm("wait", self.plan, code=None)
        finally:
            self.cluster.show("n2", folder)

    def test_a_node_that_does_not_see_the_cache(self):
        ended = self.unseen(self.folder / "cache")
        self.assertEqual(ended.returncode, ENVIRONMENT, ended.stderr)
        self.assertIn("cache on n2 is not the one that the plan was made with: is that folder shared?", ended.stderr)
        self.assertIn("(task 0 on n2)", ended.stderr)

    def test_a_node_that_does_not_see_the_output(self):
        self.plan = self.folder / "plan"
        ended = self.unseen(self.folder / "out", "--plan", self.plan)
        self.assertEqual(ended.returncode, ENVIRONMENT, ended.stderr)
        self.assertIn("out on n2 is not the one that the plan was made for: is it shared?", ended.stderr)

    def test_a_node_that_does_not_see_the_plan(self):
        ended = self.unseen(self.plan)
        self.assertEqual(ended.returncode, IO, ended.stderr)
        self.assertRegex(ended.stderr, "task 0: FAILED on n2")
        self.plan.rename(self.folder / "moved")
        job = self.call(binary(), "task", "run", "--plan", self.plan, "--id", "0", "--index", "0", code=ENVIRONMENT)
        self.assertIn("does not see the plan", job.stderr)
        (self.folder / "moved").rename(self.plan)
        job = self.call(binary(), "task", "run", "--plan", self.plan, "--id", "0", "--index", "0", code=ENVIRONMENT)
        self.assertIn("is not the plan that this job is for", job.stderr)

    def test_refusals(self):
        said = self.hand_in("--slurm-arg", "--partition=nope", code=ENVIRONMENT).stderr
        self.assertIn("sbatch refuses: ", said)
        self.assertIn("Invalid partition name", said)
        self.assertEqual(self.queue("%i"), [])
        self.assertIn("--executor slurm", self.submit("--slurm-arg=-c2", code=USAGE).stderr)


class NoSlurm(Farm):
    def test_no_commands_of_slurm(self):
        done = subprocess.run([binary(), "submit", str(self.scene), "-o", str(self.folder / "out"), "--cache",
                               str(self.folder / "cache"), "--executor", "slurm"], stdin=subprocess.DEVNULL,
                              env=environment(PATH="/nowhere"), capture_output=True, encoding="utf-8", timeout=LIMIT_SECONDS)
        self.assertEqual(done.returncode, ENVIRONMENT, done.stderr)
        self.assertIn("there is no scontrol on PATH", done.stderr)
        self.assertFalse((self.folder / "out").exists())

    def test_a_plan_that_no_queue_has(self):
        self.submit()
        for command in ("wait", "cancel"):
            self.assertIn("was not handed to a queue", self.run_it(command, self.plan, code=USAGE).stderr)


if __name__ == "__main__":
    unittest.main()
