"""Blenders that are missing, too old, hang, crash or are killed; and users who press Ctrl-C."""
import os
from pathlib import Path
import signal
import subprocess
import time
import unittest

from bad_input import BadInput, children_of, files_in, wait_for
from harness import ENVIRONMENT, INTERRUPTED, IO, OK, TASKS_FAILED

# The wall takes minutes: long enough to be stopped in the middle. Flags would win over its override.
SLOW = """
[scene]
file = "{scene}"
[bake]
resolution = 8
samples = 1
[[override]]
objects = "wall"
resolution = 256
samples = 1000000
"""

# Shell: true where this launch bakes the object that stands far away.
BAKES_OFFENDER = r"""
bakes_offender() {
  [[ "$*" == *bake_entry.py* ]] && python3 - "$REQUEST" <<'PYTHON'
import array, json, os, sys
request = json.load(open(sys.argv[1]))
for target in request.get("targets", []):
    if target["name"] == "offender":
        sys.exit(0)
for atlas in request.get("atlases", []):
    with open(os.path.join(request["folder"], atlas["arrays"]), "rb") as stream:
        for group in atlas["groups"]:
            corners = array.array("f", stream.read(32 * group["corners"]))
            if max(corners[:3 * group["corners"]]) > 1000:
                sys.exit(0)
sys.exit(1)
PYTHON
}
"""


def offended(fate):
    """A Blender that meets this fate when it bakes the offender."""
    return BAKES_OFFENDER + f'if bakes_offender "$@"; then {fate}; fi\nexec "$BLENDER" "$@"\n'


class Environment(BadInput):
    def test_named_one_is_missing(self):
        ended = self.bake("good.blend", "--blender", "/nowhere/blender")
        self.assert_refused(ended, ENVIRONMENT, "/nowhere/blender", "--blender")

    def test_none_anywhere(self):
        if any(os.access(place, os.X_OK) for place in ("/usr/bin/blender", "/usr/local/bin/blender")):
            self.skipTest("SKIPPED: a Blender stands in a usual place; tests/blender/find_test.cpp covers it")
        ended = self.bake("good.blend", RNMBAKE_BLENDER="", PATH="/nowhere")
        self.assert_refused(ended, ENVIRONMENT, "no Blender found", "--blender")

    def test_too_old(self):
        old = self.fake_blender("echo 'Blender 2.93.0'\n")
        self.assert_refused(self.bake("good.blend", "--blender", old), ENVIRONMENT, "2.93.0", "3.4", "--blender")

    def test_no_blender_at_all(self):
        other = self.fake_blender("echo 'hello'\n")
        self.assert_refused(self.bake("good.blend", "--blender", other), ENVIRONMENT, other, "--blender")


class Failing(BadInput):
    def assert_others_delivered(self, ended, *words):
        self.assertEqual(ended.code, TASKS_FAILED, ended.err)
        self.assert_one_error(ended, "offender", *words)
        status = {entry["object"]: entry["status"] for entry in self.manifest()["objects"]}
        self.assertEqual(status, {"floor": "baked", "offender": "failed", "wall": "baked"})
        self.assertEqual(files_in(self.out), ["floor.exr", "manifest.json", "timings.json", "wall.exr"])
        for name in ("floor.exr", "wall.exr"):
            self.assert_whole(name)
        self.assert_tidy()

    def bake_with(self, script, *flags):
        return self.bake("good.blend", "--blender", self.fake_blender(script), "--retries", "0", *flags)

    def test_crash(self):
        for recipe in ("receiver", "flat-normal-map"):
            with self.subTest(recipe=recipe):
                ended = self.bake_with(offended("kill -SEGV $$"), "--recipe", recipe, "--bases", "flat")
                self.assert_others_delivered(ended, "SIGSEGV", "--exclude")

    def test_crash_with_all_bases(self):
        self.assert_others_delivered(self.bake_with(offended("kill -SEGV $$")), "SIGSEGV")

    def test_killed(self):
        ended = self.bake_with(offended("kill -KILL $$"), "--bases", "flat")
        self.assert_others_delivered(ended, "memory")

    def test_hang(self):
        """Busily. The real Blender beside it may take its time to start: there is progress in that."""
        begins = """echo '{"phase": "bake", "what": "atlas 1 of 1"}' > "$(dirname "$REQUEST")/progress.jsonl" """
        ended = self.bake_with(offended(begins + "; while :; do :; done"), "--bases", "flat", "--timeout", "8")
        self.assert_others_delivered(ended, "8 s", "at bake atlas 1 of 1", "--timeout")

    def test_hang_before_the_bake(self):
        """Whatever is baked, the scene must be opened first: nothing is learnt from halves."""
        script = 'if [[ "$*" == *bake_entry.py* ]]; then echo x >> "$TMPDIR/../../../launches"; sleep 1000; fi\n'
        ended = self.bake_with(script + 'exec "$BLENDER" "$@"\n', "--bases", "flat", "--timeout", "8")
        self.assertEqual(ended.code, TASKS_FAILED, ended.err)
        self.assertEqual(len(ended.errors), 3, ended.err)
        self.assertIn("at start-up", ended.errors[0])
        self.assertEqual((self.temporary / "launches").read_text(), "x\n")

    def test_no_result(self):
        ended = self.bake_with(offended("exit 0"), "--bases", "flat")
        self.assert_others_delivered(ended, "without a result")

    def test_crash_of_the_survey(self):
        script = 'if [[ "$*" == *survey_entry.py* ]]; then kill -SEGV $$; fi\nexec "$BLENDER" "$@"\n'
        self.assert_refused(self.bake_with(script), TASKS_FAILED, "good.blend", "SIGSEGV")

    def test_hang_of_every_launch(self):
        script = 'if [[ "$*" == *_entry.py* ]]; then sleep 1000; fi\nexec "$BLENDER" "$@"\n'
        self.assert_refused(self.bake_with(script, "--timeout", "3"), TASKS_FAILED, "good.blend", "3 s", "--timeout")

    def test_retry_mends_a_crash_that_does_not_come_again(self):
        once = self.folder / "crashed-once"
        script = f'if [[ "$*" == *bake_entry.py* && ! -e "{once}" ]]; then touch "{once}"; kill -SEGV $$; fi\n'
        ended = self.bake("good.blend", "--blender", self.fake_blender(script + 'exec "$BLENDER" "$@"\n'),
                          "--objects", "floor", "--bases", "flat")
        self.assertEqual(ended.code, OK, ended.err)
        self.assertEqual(ended.errors, [])


class FullDisk(BadInput):
    """A small disk under TMPDIR: wherever the room ends, it is named, and nothing is tried again."""

    def small_disk(self, kibibytes):
        mount = ["mount", "-t", "tmpfs", "-o", f"size={kibibytes}k", "none", str(self.temporary)]
        if subprocess.run(mount, stderr=subprocess.DEVNULL).returncode:
            self.skipTest("SKIPPED: a small tmpfs needs root")
        self.addCleanup(subprocess.run, ["umount", str(self.temporary)], check=True)

    def bake_without_room_for(self, entry, *flags):
        script = f'[[ "$*" == *{entry}* ]] && cat /dev/zero > "$TMPDIR/fill" 2>/dev/null\nexec "$BLENDER" "$@"\n'
        return self.bake("good.blend", "--blender", self.fake_blender(script), *flags)

    def test_every_launch(self):
        self.small_disk(32768)
        for entry, flags in (("survey_entry.py", ()), ("lambert_entry.py", ("--materials", "lambert")),
                             ("bake_entry.py", ())):
            with self.subTest(entry=entry):
                ended = self.bake_without_room_for(entry, *flags)
                self.assert_refused(ended, IO, "disk", "full", str(self.temporary))


class Stopped(BadInput):
    """Ctrl-C and worse, in the middle of a bake in which one lightmap is done and the next takes long."""

    def start_baking(self):
        project = self.folder / "project.toml"
        project.write_text(SLOW.format(scene=self.scenes / "good.blend"), encoding="utf-8")
        running = self.start(project)
        self.addCleanup(end, running)
        self.assertTrue(wait_for(lambda: len(self.lightmaps()) == 2 and any_bakes(running.pid), 120),
                        files_in(self.out))
        time.sleep(1)
        return running

    def assert_rerun_works(self):
        ended = self.bake("good.blend")
        self.assertEqual(ended.code, OK, ended.err)
        self.assertEqual([name for name in files_in(self.out) if not name.startswith(".")],
                         ["floor.exr", "manifest.json", "offender.exr", "timings.json", "wall.exr"])

    def test_interrupt(self):
        running = self.start_baking()
        below = children_of(running.pid)
        os.kill(running.pid, signal.SIGINT)
        _, err = running.communicate(timeout=30)
        self.assertEqual(running.returncode, INTERRUPTED, err)
        self.assertEqual(len([line for line in err.splitlines() if "error: " in line]), 1, err)
        self.assertFalse([pid for pid in below if os.path.exists(f"/proc/{pid}")])
        self.assert_only_finished_ones()
        self.assert_tidy()
        self.assert_rerun_works()

    def test_kill(self):
        running = self.start_baking()
        below = children_of(running.pid)
        os.kill(running.pid, signal.SIGKILL)
        running.communicate(timeout=30)
        self.assertTrue(wait_for(lambda: not any(os.path.exists(f"/proc/{pid}") for pid in below), 10),
                        "Blender lives on")
        self.assert_only_finished_ones()
        self.assertTrue(files_in(self.temporary), "a killed run cannot tidy up")
        self.assert_rerun_works()
        self.assert_tidy()

    def assert_only_finished_ones(self):
        self.assertEqual([name for name in files_in(self.out) if not name.startswith(".")],
                         ["floor.exr", "offender.exr"])
        for name in ("floor.exr", "offender.exr"):
            self.assert_whole(name)


def any_bakes(pid):
    """Whether a Blender below `pid` runs bake_entry.py."""
    for child in children_of(pid):
        try:
            if b"bake_entry.py" in Path(f"/proc/{child}/cmdline").read_bytes():
                return True
        except OSError:
            pass
    return False


def end(running):
    if running.poll() is None:
        running.kill()
    running.stderr.close()


if __name__ == "__main__":
    unittest.main(verbosity=2)
