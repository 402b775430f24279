"""What is baked again after which change, and whether a run that was killed goes on where it was, to the last digit.

    RNMBAKE_BINARY=build/release/rnmbake python3 tests/with_blender/reuse_check.py
"""
import hashlib
import json
import os
from pathlib import Path
import random
import shutil
import signal
import subprocess
import tempfile
import time
import unittest

from harness import INVALID_INPUT, LIMIT_SECONDS, OK, SCENES, binary, blender, environment, run_blender

WRAPPER = """#!/bin/bash
for word in "$@"; do case $word in *_entry.py) basename "$word" >> "$LAUNCHES";; esac; done
exec "{blender}" "$@"
"""
ROUNDS = int(os.environ.get("ROUNDS", "1"))  # of each victim
FEW = ("--resolution", "16", "--samples", "8", "--bounces", "2", "--save-scene", "never")
# Enough for several passes: the model gives a texel-sample 3 us, and a pass 10 s.
MANY = ("--resolution", "64", "--samples", "512", "--bounces", "0", "--save-scene", "never")


class Reuse(unittest.TestCase):
    COMMAND = "bake"

    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory(prefix="rnmbake-reuse-")
        cls.addClassCleanup(folder.cleanup)
        cls.origin = Path(folder.name) / "origin"
        cls.origin.mkdir()
        run_blender(SCENES / "reuse_scene.py", cls.origin / "room.blend")

    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="rnmbake-reuse-")
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        shutil.copytree(self.origin, self.folder / "scene")
        self.scene = self.folder / "scene" / "room.blend"
        self.launches = self.folder / "launches"
        self.wrapper = self.folder / "blender"
        self.wrapper.write_text(WRAPPER.format(blender=blender()), encoding="utf-8")
        self.wrapper.chmod(0o755)

    def command(self, *flags, out="out", cache="cache"):
        return [binary(), self.COMMAND, str(self.scene), "-o", str(self.folder / out), "--blender", str(self.wrapper),
                "--cache", str(self.folder / cache) if cache != "none" else cache, *flags]

    def bake(self, *flags, **where):
        """Scripts that Blender ran, and what was said."""
        self.launches.write_text("", encoding="utf-8")
        done = subprocess.run(self.command(*flags, **where), env=self.environment(), stdin=subprocess.DEVNULL,
                              capture_output=True, encoding="utf-8", timeout=LIMIT_SECONDS)
        self.assertEqual(done.returncode, OK, done.stderr)
        return self.launches.read_text(encoding="utf-8").split(), done.stderr

    def environment(self):
        return {**environment(), "LAUNCHES": str(self.launches)}

    def change(self, what):
        run_blender(SCENES / "reuse_scene.py", self.scene, what, scene=self.scene)

    def pictures(self, out="out"):
        return {str(file.relative_to(self.folder / out)): hashlib.sha256(file.read_bytes()).hexdigest()
                for file in sorted((self.folder / out).rglob("*.exr"))}

    def kept(self, kind):
        return {file.name for file in (self.folder / "cache" / kind).glob("*/*")}

    def set_box(self, settings):
        """The scene from now on; `settings` are those of the box."""
        project = self.scene.with_name("room.toml")
        project.write_text('[scene]\nfile = "room.blend"\n[bake]\nresolution = 16\n'
                           f'[[override]]\nobjects = "box"\n{settings}\n', encoding="utf-8")
        self.scene = project

    def kill_when(self, is_time, *flags):
        self.launches.write_text("", encoding="utf-8")
        process = subprocess.Popen(self.command(*flags), env=self.environment(), stdin=subprocess.DEVNULL,
                                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        while not is_time():
            self.assertIsNone(process.poll(), "it was over before it could be killed")
            time.sleep(0.05)
        process.send_signal(signal.SIGKILL)
        process.wait(LIMIT_SECONDS)

    def samples(self, out="out"):
        manifest = json.loads((self.folder / out / "manifest.json").read_text(encoding="utf-8"))
        return {entry["key"]: entry["samples"] for entry in manifest["objects"]}


class Changes(Reuse):
    def test_nothing_starts_no_blender(self):
        self.bake(*FEW)
        before = self.pictures()
        launches, said = self.bake(*FEW)
        self.assertEqual(launches, [])
        self.assertIn("up to date", said)
        os.utime(self.scene)
        self.assertEqual(self.bake(*FEW)[0], [])
        self.assertEqual(self.pictures(), before)

    def test_a_file_saved_again_is_looked_at_once(self):
        self.bake(*FEW)
        self.change("selection")
        launches, said = self.bake(*FEW)
        self.assertEqual(launches, ["survey_entry.py"])
        self.assertIn("scene room.blend changed", said)
        self.assertEqual(self.bake(*FEW)[0], [])

    def test_light_and_pictures_bake_all_and_are_named(self):
        self.bake(*FEW)
        before = self.pictures()
        for what, named in (("lamp", "light 'Area'"), ("picture", "picture 'wall.png'")):
            self.change(what)
            launches, said = self.bake(*FEW, "--why")
            self.assertIn("bake_entry.py", launches)
            self.assertIn(named, said)
            after = self.pictures()
            self.assertFalse(set(before.items()) & set(after.items()), what)
            before = after

    def test_settings_of_the_files_bake_nothing(self):
        self.bake(*FEW)
        self.assertNotIn("bake_entry.py", self.bake(*FEW, "--depth", "float", "--dilate", "1", "--layout", "files")[0])

    def test_one_object_alone(self):
        settings = ("--bounces", "2", "--save-scene", "never")
        scene = self.scene
        self.set_box("samples = 16")
        self.bake(*settings)
        before = self.pictures()
        self.scene = scene
        self.set_box("samples = 32")
        launches, said = self.bake(*settings)
        after = self.pictures()
        self.assertEqual(launches.count("bake_entry.py"), 1)
        self.assertIn("baking 3 lightmaps", said)
        self.assertEqual({name for name in before if before[name] != after[name]}, {"box.exr"})

    def test_more_samples_go_on_from_those_that_are_there(self):
        some = (*FEW[:2], "--samples", "32", *FEW[4:])
        more = (*FEW[:2], "--samples", "128", *FEW[4:], "--depth", "float")
        self.bake(*some)
        launches, said = self.bake(*more)
        self.assertEqual(launches.count("bake_entry.py"), 1)
        self.bake(*more, out="whole", cache="none")
        if "of Blender 3.4" in said:  # later ones have other samples: docs/passes.md
            for name in self.pictures():  # the same samples, summed in other steps: 16 roundings of floats below 1
                done = subprocess.run(["oiiotool", "--fail", "1e-6", self.folder / "out" / name, self.folder / "whole" / name,
                                       "--diff"], capture_output=True, encoding="utf-8")
                self.assertEqual(done.returncode, OK, done.stdout)

    def test_a_shared_cache_serves_another_checkout(self):
        self.bake(*FEW)
        before = self.pictures()
        shutil.move(self.folder / "scene", self.folder / "elsewhere")
        self.scene = self.folder / "elsewhere" / "room.blend"
        self.assertEqual(self.bake(*FEW, out="other")[0], ["survey_entry.py"])
        self.assertEqual(self.pictures("other"), before)

    def test_dry_run_writes_nothing(self):
        done = subprocess.run(self.command(*FEW, "--dry-run"), env=self.environment(), stdin=subprocess.DEVNULL,
                              capture_output=True, encoding="utf-8", timeout=LIMIT_SECONDS)
        self.assertEqual((done.returncode, done.stdout.splitlines()),
                         (OK, [f"{name}: 8 samples to bake" for name in ("floor", "wall", "box")]))
        self.assertFalse((self.folder / "out").exists())


class Traced(Reuse):
    """Engine embree."""
    EMBREE = (*FEW, "--engine", "embree")

    def test_nothing_starts_no_blender(self):
        self.assertIn("lambert_entry.py", self.bake(*self.EMBREE)[0])
        before = self.pictures()
        launches, said = self.bake(*self.EMBREE)
        self.assertEqual(launches, [])
        self.assertIn("up to date", said)
        self.assertEqual(self.bake(*self.EMBREE, "--force")[1].count("up to date"), 0)
        self.assertEqual(self.pictures(), before)

    def test_the_other_engine_and_light_are_named(self):
        self.bake(*FEW)
        before = self.pictures()
        self.assertIn('because setting engine = "embree"', self.bake(*self.EMBREE)[1])
        traced = self.pictures()
        self.assertFalse(set(before.items()) & set(traced.items()))
        self.change("lamp")
        self.assertIn("light 'Area'", self.bake(*self.EMBREE, "--why")[1])
        self.assertFalse(set(traced.items()) & set(self.pictures().items()))

    def test_another_scene_or_command_in_the_folder_is_no_reason_to_rest(self):
        where = {**self.environment(), "XDG_CACHE_HOME": str(self.folder / "own")}
        where.pop("RNMBAKE_CACHE")

        def said(*flags):
            done = subprocess.run(self.command(*self.EMBREE, *flags), env=where, stdin=subprocess.DEVNULL,
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
        self.bake(*self.EMBREE)
        self.change("no box")
        self.bake(*self.EMBREE)
        self.assertIn("box.exr", self.pictures())
        launches, said = self.bake(*self.EMBREE, "--prune")
        self.assertEqual((launches, sorted(self.pictures())), ([], ["floor.exr", "wall.exr"]))
        self.assertIn("1 file deleted (box.exr)", said)
        self.assertNotIn("deleted", self.bake(*self.EMBREE, "--prune")[1])

    def test_an_exported_scene_needs_no_blender(self):
        exported = self.folder / "room.rnmscene"
        done = subprocess.run([binary(), "export", str(self.scene), "-o", str(exported), *FEW[:2]], env=environment(),
                              stdin=subprocess.DEVNULL, capture_output=True, encoding="utf-8", timeout=LIMIT_SECONDS)
        self.assertEqual(done.returncode, OK, done.stderr)
        self.bake(*self.EMBREE)
        before = self.pictures()
        self.scene, self.wrapper = exported, self.folder / "nowhere"
        self.bake(*self.EMBREE, out="alone")
        self.assertEqual(self.pictures("alone"), before)
        self.assertIn("up to date", self.bake(*self.EMBREE, out="alone")[1])

    def test_dry_run_writes_nothing(self):
        done = subprocess.run(self.command(*self.EMBREE, "--dry-run"), env=self.environment(), stdin=subprocess.DEVNULL,
                              capture_output=True, encoding="utf-8", timeout=LIMIT_SECONDS)
        self.assertEqual((done.returncode, done.stdout.splitlines()),
                         (OK, [f"{name}: 8 samples to bake" for name in ("floor", "wall", "box")]))
        self.assertFalse((self.folder / "out").exists())


class Local(Reuse):
    """--assume-local: the wall's picture changes; the floor touches the wall, the box is 0.7 units away."""
    EMBREE = Traced.EMBREE

    def assumed(self):
        manifest = json.loads((self.folder / "out" / "manifest.json").read_text(encoding="utf-8"))
        return [entry["key"] for entry in manifest["objects"] if entry.get("assumed_local")]

    def changed(self, before):
        return sorted(name for name, digest in self.pictures().items() if before.get(name) != digest)

    def test_what_is_far_from_a_change_stays_until_it_is_asked_for(self):
        self.bake(*self.EMBREE)
        before = self.pictures()
        self.change("picture")
        said = self.bake(*self.EMBREE, "--assume-local", "0.5")[1]
        self.assertIn("1 of 3 lightmaps stay", said)
        self.assertIn("1 lightmap assumed to be as before", said)
        self.assertEqual((self.changed(before), self.assumed()), (["floor.exr", "wall.exr"], ["box"]))
        self.assertEqual(self.bake(*self.EMBREE, "--assume-local", "0.5")[0], [])
        after = self.pictures()
        said = self.bake(*self.EMBREE)[1]
        self.assertIn("because 1 lightmap assumed to be as before", said)
        self.assertEqual((self.changed(after), self.assumed()), (["box.exr"], []))
        right = self.pictures()
        self.bake(*self.EMBREE, out="afresh")
        self.assertEqual(self.pictures("afresh"), right)

    def test_nothing_near_any_object_bakes_nothing(self):
        self.bake(*self.EMBREE)
        before = self.pictures()
        self.change("selection")
        self.assertIn("3 of 3 lightmaps stay", self.bake(*self.EMBREE, "--assume-local", "0.5")[1])
        self.assertEqual((self.pictures(), self.assumed()), (before, []))
        self.assertEqual(self.bake(*self.EMBREE)[0], [])  # nothing was assumed

    def test_what_reaches_everything_bakes_all(self):
        self.bake(*self.EMBREE)
        before = self.pictures()
        self.change("lamp")
        self.bake(*self.EMBREE, "--assume-local", "0.5")
        self.assertEqual((self.changed(before), self.assumed()), (sorted(before), []))
        self.change("picture")
        said = self.bake(*self.EMBREE, "--seed", "3", "--assume-local", "0.5")[1]
        self.assertIn("everything is baked, since setting seed = 3", said)
        self.assertEqual(self.assumed(), [])

    def test_a_lightmap_that_is_not_there_is_baked(self):
        self.bake(*self.EMBREE)
        self.change("picture")
        (self.folder / "out" / "box.exr").write_text("painted over", encoding="utf-8")
        self.bake(*self.EMBREE, "--assume-local", "0.5")
        self.assertEqual((self.assumed(), len(self.pictures())), ([], 3))

    def test_cycles_bakes_what_was_assumed_alone(self):
        self.bake(*FEW)
        self.change("picture")
        self.assertIn("1 of 3 lightmaps stay", self.bake(*FEW, "--assume-local", "0.5")[1])
        self.assertIn("2 of 3 targets baked before", self.bake(*FEW)[1])
        self.assertEqual(self.assumed(), [])


class Scenes(Reuse):
    """A project that lists several."""

    def project(self, *names):
        project = self.folder / "scene" / "game.toml"
        project.write_text('[bake]\nresolution = 16\nsamples = 8\nbounces = 2\nengine = "embree"\n[output]\nsave_scene = "never"\n'
                           'dir = "maps"\n[[override]]\nobjects = "box"\nsamples = 16\n'
                           + "".join(f'[[scenes]]\nfile = "{name}.blend"\n' for name in names), encoding="utf-8")
        return project

    def run_project(self, project, *flags):
        self.launches.write_text("", encoding="utf-8")
        done = subprocess.run([binary(), "bake", str(project), "--blender", str(self.wrapper), *flags],
                              env=self.environment(), stdin=subprocess.DEVNULL, capture_output=True, encoding="utf-8", timeout=LIMIT_SECONDS)
        return done, self.launches.read_text(encoding="utf-8").split()

    def test_all_are_baked_and_one_that_fails_stops_none(self):
        run_blender(SCENES / "reuse_scene.py", self.scene.with_name("hut.blend"), "no box", scene=self.scene)
        self.scene.with_name("broken.blend").write_text("no scene", encoding="utf-8")
        done, _ = self.run_project(self.project("broken", "gone", "hut", "room"), "--json")
        answer = json.loads(done.stdout)
        self.assertEqual((done.returncode, answer["exit_code"], answer["lightmaps"]), (INVALID_INPUT, INVALID_INPUT, 5))
        self.assertEqual([one["key"] for one in answer["failed"]], ["broken/", "gone/"])
        self.assertIn("hut/floor.exr", answer["files"])
        self.assertIn("4 scenes in", done.stderr)
        self.assertIn("not baked: ", done.stderr)
        maps = self.scene.with_name("maps")
        self.assertEqual(sorted(file.name for file in (maps / "hut").glob("*.exr")), ["floor.exr", "wall.exr"])
        self.assertEqual(len(list((maps / "room").glob("*.exr"))), 3)

    def test_nothing_starts_no_blender(self):
        shutil.copy(self.scene, self.scene.with_name("hut.blend"))
        project = self.project("hut", "room")
        done, launches = self.run_project(project)
        self.assertEqual(done.returncode, OK, done.stderr)
        self.assertIn("lambert_entry.py", launches)
        done, launches = self.run_project(project)
        self.assertEqual((launches, done.stderr.count("up to date")), ([], 2))
        self.change("lamp")
        done, launches = self.run_project(project)
        self.assertEqual((done.stderr.count("up to date"), "lambert_entry.py" in launches), (1, True))
        self.assertEqual(self.run_project(project, "--file", "hut.blend")[0].stderr.count("up to date"), 1)
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


class Killed(Reuse):
    def test_goes_on_to_the_same_bytes(self):
        self.bake(*MANY, out="whole", cache="none")
        whole = self.pictures("whole")
        random.seed(7)
        for round_ in range(ROUNDS):
            for victim in ("rnmbake", "blender"):
                with self.subTest(round=round_, victim=victim):
                    shutil.rmtree(self.folder / "cache", ignore_errors=True)
                    shutil.rmtree(self.folder / "out", ignore_errors=True)
                    self.kill_one(victim, random.uniform(1, 25))
                    self.bake(*MANY)
                    self.assertEqual(self.pictures(), whole)

    def kill_one(self, victim, seconds):
        self.launches.write_text("", encoding="utf-8")
        process = subprocess.Popen(self.command(*MANY), env=self.environment(), stdin=subprocess.DEVNULL,
                                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        time.sleep(seconds)
        if victim == "rnmbake":
            process.send_signal(signal.SIGKILL)
        else:
            subprocess.run(["pkill", "-KILL", "-P", str(process.pid)], check=False)
        process.wait(LIMIT_SECONDS)


if __name__ == "__main__":
    unittest.main()
