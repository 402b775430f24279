"""Scenes that open, but in which something stands in the way."""
import shutil
import subprocess
import unittest

from bad_input import BadInput, files_in
from harness import INVALID_INPUT, OK, USAGE, blender


RECORDS = ["manifest.json", "timings.json", ".rnmbake-run.json", ".rnmbake-scene.json"]


class Content(BadInput):
    def test_no_meshes(self):
        self.assert_refused(self.bake("no_meshes.blend"), INVALID_INPUT, "no_meshes.blend")

    def test_only_an_object_without_faces(self):
        self.assert_refused(self.bake("no_faces.blend"), INVALID_INPUT, "no_faces.blend", "faces")

    def test_object_without_faces_beside_others(self):
        ended = self.bake("some_faces.blend")
        self.assertEqual(ended.code, OK, ended.err)
        manifest = self.manifest()
        self.assertEqual([entry["object"] for entry in manifest["objects"]], ["floor"])
        self.assertEqual(manifest["skipped"], [{"key": "wire", "reason": "no faces"}])

    def test_uvs_all_zero(self):
        ended = self.bake("zero_uvs.blend", "--unwrap", "never")
        self.assert_refused(ended, INVALID_INPUT, "'flat_uvs'", "'Lightmap'", "--unwrap")

    def test_uvs_all_zero_are_unwrapped(self):
        ended = self.bake("zero_uvs.blend", "--save-scene", "never")
        self.assertEqual(ended.code, OK, ended.err)
        entry = self.manifest()["objects"][0]
        self.assertTrue(entry["unwrapped"])
        self.assertGreater(entry["coverage"], 0.3)

    def test_meshes_without_area(self):
        ended = self.bake("no_area.blend", "--save-scene", "never")
        self.assertEqual(ended.code, OK, ended.err)
        manifest = self.manifest()
        self.assertEqual(manifest["skipped"], [{"key": "lines", "reason": "no area"}])
        self.assertIn("lines: 1 object whose faces have no area", ended.err)
        entry, = manifest["objects"]
        self.assertEqual((entry["object"], entry["unwrapped"]), ("partly", True))
        self.assertEqual(entry["uv"]["degenerate_triangles"], 1)
        self.assertGreater(entry["coverage"], 0.5)

    def test_faces_on_others(self):
        ended = self.bake("doubled.blend", "--save-scene", "never")
        self.assertEqual(ended.code, OK, ended.err)
        self.assertIn("kit: 2 triangles lie on others; engines flicker between the two", ended.err)
        self.assertEqual({entry["object"]: entry["uv"]["doubled_triangles"] for entry in self.manifest()["objects"]},
                         {"kit": 2, "leaf": 0})

    def test_nothing_gives_light(self):
        self.assert_refused(self.bake("dark.blend"), INVALID_INPUT, "dark.blend", "--allow-dark")
        ended = self.bake("dark.blend", "--allow-dark")
        self.assertEqual(ended.code, OK, ended.err)
        texels = self.manifest()["objects"][0]["texels"]
        self.assertEqual(texels["black"], texels["covered"])

    def test_picture_that_is_a_device(self):
        self.assert_refused(self.bake("device.blend"), INVALID_INPUT, "/dev/zero")

    def test_nan_vertex(self):
        self.assert_refused(self.bake("nan_vertex.blend"), INVALID_INPUT, "'broken'", "vertex 3")

    def test_pattern_that_matches_nothing(self):
        for flags in (("--objects", "flor*"), ("--exclude", "flor*")):
            with self.subTest(flags=flags):
                self.assert_refused(self.bake("good.blend", *flags), USAGE, "'flor*'", flags[0], "rnmbake inspect")

    def test_everything_excluded(self):
        self.assert_refused(self.bake("good.blend", "--exclude", "*"), INVALID_INPUT, "good.blend")

    def test_unknown_uv_layer(self):
        ended = self.bake("good.blend", "--uv", "Lightmapp", "--objects", "floor")
        self.assert_refused(ended, INVALID_INPUT, "'floor'", "'Lightmapp'", "'Lightmap'", "--uv")


class Names(BadInput):
    def test_become_distinct_files_inside_the_folder(self):
        ended = self.bake("names.blend", "--save-scene", "never")
        self.assertEqual(ended.code, OK, ended.err)
        self.assertEqual(files_in(self.folder / "tmp"), [])
        objects = self.manifest()["objects"]
        self.assertEqual(len(objects), 9)
        self.assertTrue({"../../x", "a/b", "Säule 柱", "case", "CASE"} <= {entry["object"] for entry in objects})
        files = [name for entry in objects for name in entry["files"]]
        self.assertEqual(sorted(files), self.lightmaps())
        self.assertEqual(len({name.casefold() for name in files}), 9)
        for name in files:
            self.assertNotIn("/", name)
            self.assertNotIn(name[0], ".-")
            self.assertLessEqual(len(name.encode()), 200)
        self.assertEqual(sorted(files_in(self.folder)),
                         sorted(f"out/{name}" for name in files + RECORDS))


class Scripts(BadInput):
    def test_auto_run_script_does_not_run(self):
        self.assert_refused(self.bake("autorun.blend"), INVALID_INPUT, "auto.py", "--allow-scripts")
        self.assertFalse((self.scenes / "script_was_here").exists())

    def test_auto_run_script_runs_when_trusted(self):
        marker = self.scenes / "script_was_here"
        self.addCleanup(marker.unlink, missing_ok=True)
        ended = self.bake("autorun.blend", "--allow-scripts")
        self.assertEqual(ended.code, OK, ended.err)
        self.assertTrue(marker.exists())

    def test_simulations_write_nothing(self):
        for scene, name in (("simulations.blend", "'cloth'"), ("paint.blend", "'canvas'")):
            with self.subTest(scene=scene):
                self.assert_refused(self.bake(scene), INVALID_INPUT, name, "--allow-scripts")
                self.assertEqual(self.simulated(), [])

    def test_simulations_run_when_trusted(self):
        self.bake_trusted("paint.blend", "blendcache_paint")

    def test_fluids_run_when_trusted(self):
        plain = subprocess.run([blender(), "-b", "--factory-startup", str(self.scenes / "simulations.blend")],
                               capture_output=True, timeout=60)
        self.remove_simulated()
        if plain.returncode < 0:
            self.skipTest("SKIPPED: this Blender dies of any fluid by itself (PyImport_AppendInittab)")
        self.bake_trusted("simulations.blend", "simulation_was_here")

    def bake_trusted(self, scene, cache):
        self.addCleanup(self.remove_simulated)
        ended = self.bake(scene, "--allow-scripts", "--objects", "floor")
        self.assertEqual(ended.code, OK, ended.err)
        self.assertIn(cache, [path.name for path in self.simulated()])

    def simulated(self):
        names = ("blendcache_simulations", "simulation_was_here", "blendcache_paint")
        return [path for path in (self.scenes / name for name in names) if path.exists()]

    def remove_simulated(self):
        for path in self.simulated():
            shutil.rmtree(path)

    def test_scripted_driver(self):
        self.assert_refused(self.bake("driver.blend"), INVALID_INPUT, "'driven'", "--allow-scripts")

    def test_scripted_driver_runs_when_trusted(self):
        ended = self.bake("driver.blend", "--allow-scripts")
        self.assertEqual(ended.code, OK, ended.err)
        self.assertEqual(len(self.lightmaps()), 1)


if __name__ == "__main__":
    unittest.main(verbosity=2)
