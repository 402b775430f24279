"""What is baked again after which change, and whether a run that was killed goes on where it was, to the last digit.

    RNMBAKE_BINARY=build/release/rnmbake python3 tests/with_blender/reuse_check.py
"""
import json
import os
import random
import shutil
import signal
import subprocess
import time
import unittest

from harness import INVALID_INPUT, LIMIT_SECONDS, OK, SCENES, binary, run_blender
from reuse_case import EMBREE, FEW, MANY, ROUNDS, Reuse


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


class Local(Reuse):
    """--assume-local: the wall's picture changes; the floor touches the wall, the box is 0.7 units away."""

    def assumed(self):
        manifest = json.loads((self.folder / "out" / "manifest.json").read_text(encoding="utf-8"))
        return [entry["key"] for entry in manifest["objects"] if entry.get("assumed_local")]

    def changed(self, before):
        return sorted(name for name, digest in self.pictures().items() if before.get(name) != digest)

    def test_what_is_far_from_a_change_stays_until_it_is_asked_for(self):
        self.bake(*EMBREE)
        before = self.pictures()
        self.change("picture")
        said = self.bake(*EMBREE, "--assume-local", "0.5")[1]
        self.assertIn("1 of 3 lightmaps stay", said)
        self.assertIn("1 lightmap assumed to be as before", said)
        self.assertEqual((self.changed(before), self.assumed()), (["floor.exr", "wall.exr"], ["box"]))
        self.assertEqual(self.bake(*EMBREE, "--assume-local", "0.5")[0], [])
        after = self.pictures()
        said = self.bake(*EMBREE)[1]
        self.assertIn("because 1 lightmap assumed to be as before", said)
        self.assertEqual((self.changed(after), self.assumed()), (["box.exr"], []))
        right = self.pictures()
        self.bake(*EMBREE, out="afresh")
        self.assertEqual(self.pictures("afresh"), right)

    def test_nothing_near_any_object_bakes_nothing(self):
        self.bake(*EMBREE)
        before = self.pictures()
        self.change("selection")
        self.assertIn("3 of 3 lightmaps stay", self.bake(*EMBREE, "--assume-local", "0.5")[1])
        self.assertEqual((self.pictures(), self.assumed()), (before, []))
        self.assertEqual(self.bake(*EMBREE)[0], [])  # nothing was assumed

    def test_what_reaches_everything_bakes_all(self):
        self.bake(*EMBREE)
        before = self.pictures()
        self.change("lamp")
        self.bake(*EMBREE, "--assume-local", "0.5")
        self.assertEqual((self.changed(before), self.assumed()), (sorted(before), []))
        self.change("picture")
        said = self.bake(*EMBREE, "--seed", "3", "--assume-local", "0.5")[1]
        self.assertIn("everything is baked, since setting seed = 3", said)
        self.assertEqual(self.assumed(), [])

    def test_a_lightmap_that_is_not_there_is_baked(self):
        self.bake(*EMBREE)
        self.change("picture")
        (self.folder / "out" / "box.exr").write_text("painted over", encoding="utf-8")
        self.bake(*EMBREE, "--assume-local", "0.5")
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
