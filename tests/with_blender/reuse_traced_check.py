"""What is traced again after which change (engine embree, reference, validate), and whether a run that was killed goes on where
it was, to the last digit.

    RNMBAKE_BINARY=build/release/rnmbake python3 tests/with_blender/reuse_traced_check.py
"""
import os
import random
import shutil
import subprocess
import unittest

from harness import LIMIT_SECONDS, OK, binary, environment
from reuse_case import EMBREE, FEW, ROUNDS, Reuse


class Traced(Reuse):
    """Engine embree."""

    def test_nothing_starts_no_blender(self):
        self.assertIn("lambert_entry.py", self.bake(*EMBREE)[0])
        before = self.pictures()
        launches, said = self.bake(*EMBREE)
        self.assertEqual(launches, [])
        self.assertIn("up to date", said)
        self.assertEqual(self.bake(*EMBREE, "--force")[1].count("up to date"), 0)
        self.assertEqual(self.pictures(), before)

    def test_the_other_engine_and_light_are_named(self):
        self.bake(*FEW)
        before = self.pictures()
        self.assertIn('because setting engine = "embree"', self.bake(*EMBREE)[1])
        traced = self.pictures()
        self.assertFalse(set(before.items()) & set(traced.items()))
        self.change("lamp")
        self.assertIn("light 'Area'", self.bake(*EMBREE, "--why")[1])
        self.assertFalse(set(traced.items()) & set(self.pictures().items()))

    def test_another_scene_or_command_in_the_folder_is_no_reason_to_rest(self):
        where = {**self.environment(), "XDG_CACHE_HOME": str(self.folder / "own")}
        where.pop("RNMBAKE_CACHE")

        def said(*flags):
            done = subprocess.run(self.command(*EMBREE, *flags), env=where, stdin=subprocess.DEVNULL,
                                  capture_output=True, encoding="utf-8", timeout=LIMIT_SECONDS)
            self.assertEqual(done.returncode, OK, done.stderr)
            return done.stderr

        first = said("--seed", "1")
        self.assertNotIn("up to date", first)
        self.assertIn("up to date", said("--seed", "1"))
        self.assertNotIn("up to date", said("--seed", "2"))
        self.assertIn('because setting seed = 1', said("--seed", "1"))  # the folder holds the other seed's
        copy = self.scene.with_name("copy.blend")
        shutil.copy(self.scene, copy)
        self.scene = copy
        self.assertIn("copy.blend", said("--seed", "1"))

    def test_what_left_the_scene_is_pruned_when_asked_for(self):
        self.bake(*EMBREE)
        self.change("no box")
        self.bake(*EMBREE)
        self.assertIn("box.exr", self.pictures())
        launches, said = self.bake(*EMBREE, "--prune")
        self.assertEqual((launches, sorted(self.pictures())), ([], ["floor.exr", "wall.exr"]))
        self.assertIn("1 file deleted (box.exr)", said)
        self.assertNotIn("deleted", self.bake(*EMBREE, "--prune")[1])

    def test_an_exported_scene_needs_no_blender(self):
        exported = self.folder / "room.rnmscene"
        done = subprocess.run([binary(), "export", str(self.scene), "-o", str(exported), *FEW[:2]], env=environment(),
                              stdin=subprocess.DEVNULL, capture_output=True, encoding="utf-8", timeout=LIMIT_SECONDS)
        self.assertEqual(done.returncode, OK, done.stderr)
        self.bake(*EMBREE)
        before = self.pictures()
        self.scene, self.wrapper = exported, self.folder / "nowhere"
        self.bake(*EMBREE, out="alone")
        self.assertEqual(self.pictures("alone"), before)
        self.assertIn("up to date", self.bake(*EMBREE, out="alone")[1])

    def test_dry_run_writes_nothing(self):
        done = subprocess.run(self.command(*EMBREE, "--dry-run"), env=self.environment(), stdin=subprocess.DEVNULL,
                              capture_output=True, encoding="utf-8", timeout=LIMIT_SECONDS)
        self.assertEqual((done.returncode, done.stdout.splitlines()),
                         (OK, [f"{name}: 8 samples to bake" for name in ("floor", "wall", "box")]))
        self.assertFalse((self.folder / "out").exists())


class Reference(Reuse):
    COMMAND = "reference"
    # Several parts for each object: a part has a million paths.
    LONG = ("--resolution", "64", "--samples", "1024", "--bounces", "0", "--save-scene", "never")

    def test_nothing_starts_no_blender(self):
        self.assertIn("lambert_entry.py", self.bake(*FEW)[0])
        before = self.pictures()
        os.utime(self.scene)
        launches, said = self.bake(*FEW)
        self.assertEqual(launches, [])
        self.assertIn("up to date", said)
        launches, said = self.bake(*FEW, "--force")
        self.assertIn("lambert_entry.py", launches)
        self.assertNotIn("traced before", said)
        self.assertEqual(self.pictures(), before)

    def test_one_object_alone(self):
        scene = self.scene
        self.set_box("resolution = 16")
        self.bake(*FEW[2:])
        before = self.pictures()
        self.scene = scene
        self.set_box("resolution = 32")
        launches, said = self.bake(*FEW[2:])
        self.assertEqual(launches, [])
        self.assertIn("2 of 3 targets traced before", said)
        after = self.pictures()
        self.assertEqual({name for name in before if before[name] != after[name]}, {"box.exr"})

    def test_objects_do_not_depend_on_those_beside_them(self):
        self.bake(*FEW, "--objects", "box")
        alone = self.pictures()
        launches, said = self.bake(*FEW, out="all")
        self.assertEqual(launches, [])
        self.assertIn("1 of 3 targets traced before", said)
        self.assertEqual(self.pictures("all")["box.exr"], alone["box.exr"])

    def test_other_samples_and_light_are_traced_anew(self):
        self.bake(*FEW)
        before = self.pictures()
        launches, said = self.bake(*FEW[:2], "--samples", "16", *FEW[4:])
        self.assertEqual(launches, [])
        self.assertIn("because setting samples = 16", said)
        self.assertNotIn("traced before", said)
        more = self.pictures()
        self.assertFalse(set(before.items()) & set(more.items()))
        self.assertIn("3 of 3 targets traced before", self.bake(*FEW)[1])
        self.assertEqual(self.pictures(), before)
        for what, named in (("lamp", "light 'Area'"), ("picture", "picture 'wall.png'")):
            self.change(what)
            launches, said = self.bake(*FEW, "--why")
            self.assertIn("export_entry.py", launches)
            self.assertIn(named, said)
            self.assertNotIn("traced before", said)

    def test_without_a_cache_nothing_is_kept(self):
        self.bake(*FEW, cache="none")
        launches, said = self.bake(*FEW, "--samples", "8", "--depth", "float", cache="none")
        self.assertIn("lambert_entry.py", launches)
        self.assertNotIn("traced before", said)

    def test_goes_on_to_the_same_bytes(self):
        self.bake(*self.LONG, out="whole", cache="none")
        whole = self.pictures("whole")
        random.seed(7)
        for round_ in range(ROUNDS):
            with self.subTest(round=round_):
                shutil.rmtree(self.folder / "cache", ignore_errors=True)
                shutil.rmtree(self.folder / "out", ignore_errors=True)
                parts = random.randint(1, 6)
                self.kill_when(lambda: len(self.kept("traced")) >= parts, *self.LONG)
                self.assertEqual(self.bake(*self.LONG)[0], [])
                self.assertEqual(self.pictures(), whole)
                self.assertEqual(len(self.kept("traced")), 3)  # parts that were of use are gone


class Validated(Reuse):
    COMMAND = "validate"
    BRIEF = (*FEW[:6], "--view", "0", "--decompose")

    def finding(self, *flags, **where):
        self.launches.write_text("", encoding="utf-8")
        done = subprocess.run(self.command(*flags, **where), env=self.environment(), stdin=subprocess.DEVNULL,
                              capture_output=True, encoding="utf-8", timeout=LIMIT_SECONDS)
        self.assertEqual(done.returncode, OK, done.stderr)
        return self.launches.read_text(encoding="utf-8").split(), done.stdout, done.stderr

    def test_nothing_starts_no_blender_and_says_its_finding_again(self):
        launches, finding, _ = self.finding(*self.BRIEF, "none")
        self.assertIn("bake_entry.py", launches)
        launches, again, said = self.finding(*self.BRIEF, "none")
        self.assertEqual(launches, [])
        self.assertEqual(again, finding)
        self.assertIn("up to date", said)
        (self.folder / "out" / "receiver" / "1" / "box.exr").unlink()
        launches, again, said = self.finding(*self.BRIEF, "none")
        self.assertEqual(launches, [])  # all of it is in the cache
        self.assertEqual(again, finding)
        self.assertIn("because output box.exr is gone", said)

    def test_more_objects_bake_what_is_missing(self):
        self.finding(*self.BRIEF, "none")
        receiver = {name: digest for name, digest in self.pictures().items()
                    if name.startswith(("receiver", "reference"))}
        launches, finding, said = self.finding(*self.BRIEF, "box")
        self.assertEqual(set(launches), {"bake_entry.py"})
        self.assertIn("3 of 3 targets baked before", said)
        self.assertIn("3 of 3 targets traced before", said)
        after = self.pictures()
        self.assertEqual({name: after[name] for name in receiver}, receiver)
        self.assertTrue(any(name.startswith("flat-normal-map") for name in after))
        self.assertEqual(self.finding(*self.BRIEF, "box")[:2], ([], finding))

    def test_goes_on_to_the_same_bytes(self):
        self.finding(*self.BRIEF, "none", out="whole", cache="other")
        whole = self.pictures("whole")
        self.kill_when(lambda: (self.folder / "out" / "receiver" / "2").is_dir(), *self.BRIEF, "none")
        launches, _, said = self.finding(*self.BRIEF, "none")
        self.assertNotIn("lambert_entry.py", launches)
        self.assertIn("3 of 3 targets baked before", said)
        self.assertEqual(self.pictures(), whole)


if __name__ == "__main__":
    unittest.main()
