"""A bake as tasks: planned, run in any order by several processes, killed and run again, merged.

    RNMBAKE_BINARY=build/release/rnmbake python3 tests/farm/farm_check.py -v
"""
import signal
import time
import unittest

from farm_case import CRASHES_ON_BOX, Farm, blenders_of
from harness import LIMIT_SECONDS, OK, TASKS_FAILED, USAGE, blender


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


if __name__ == "__main__":
    unittest.main()
