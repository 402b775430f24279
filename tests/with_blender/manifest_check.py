"""Holds the manifests of real bakes and references against docs/manifest.schema.json, and two runs of one bake against each other.

    RNMBAKE_BINARY=build/release/rnmbake python3 tests/with_blender/manifest_check.py
"""
import copy
import json
from pathlib import Path
import tempfile
import unittest

import jsonschema

from harness import SCENES, TASKS_FAILED, rnmbake, run_blender

DOCS = Path(__file__).resolve().parents[2] / "docs"
SCHEMA = json.loads((DOCS / "manifest.schema.json").read_text(encoding="utf-8"))


def is_valid(manifest):
    return jsonschema.Draft202012Validator(SCHEMA).is_valid(manifest)


class Manifest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        jsonschema.Draft202012Validator.check_schema(SCHEMA)
        folder = tempfile.TemporaryDirectory(prefix="rnmbake-manifest-")
        cls.addClassCleanup(folder.cleanup)
        cls.folder = Path(folder.name)
        cls.scene = cls.folder / "things.blend"
        run_blender(SCENES / "manifest_cases.py", cls.scene)
        cls.manifest = cls.bake("first", "--threads", "1")

    @classmethod
    def bake(cls, name, *flags):
        """Returns the manifest of a bake in which one object fails."""
        return cls.lightmaps("bake", name, "--retries", "0", *flags)

    @classmethod
    def lightmaps(cls, command, name, *flags):
        done = rnmbake(command, cls.scene, "-o", cls.folder / name, "--exclude", "left out", "--resolution", "16",
                       "--samples", "2", *flags)
        if done.returncode != TASKS_FAILED:
            raise AssertionError(f"exit code {done.returncode}: {done.stderr}")
        return json.loads((cls.folder / name / "manifest.json").read_text(encoding="utf-8"))

    def assert_valid(self, manifest):
        errors = [f"{error.json_path}: {error.message}"
                  for error in jsonschema.Draft202012Validator(SCHEMA).iter_errors(manifest)]
        self.assertEqual(errors, [])

    def test_fits_the_schema(self):
        self.assert_valid(self.manifest)

    def test_timings_fit_theirs(self):
        self.lightmaps("reference", "timed")
        schema = json.loads((DOCS / "timings.schema.json").read_text(encoding="utf-8"))
        for name in ("first", "timed"):
            timings = json.loads((self.folder / name / "timings.json").read_text(encoding="utf-8"))
            jsonschema.Draft202012Validator(schema).validate(timings)

    def test_touches_no_file_that_stays_the_same(self):
        self.bake("twice")
        before = self.times("twice")
        manifest = self.bake("twice")
        self.assertEqual(before, self.times("twice"))
        other = self.bake("twice", "--seed", "7")
        self.assertNotEqual(before["manifest.json"], self.times("twice")["manifest.json"])
        for old, new in zip(manifest["objects"], other["objects"]):
            if new["status"] == "baked":
                self.assertNotEqual(old["hashes"], new["hashes"], new["key"])

    def times(self, name):
        """Of lightmaps and manifest, in nanoseconds. The saved scene is Blender's, and no two are alike."""
        return {path.name: path.stat().st_mtime_ns for path in (self.folder / name).iterdir()
                if path.suffix == ".exr" or path.name == "manifest.json"}

    def test_says_what_happened(self):
        objects = {entry["key"]: entry for entry in self.manifest["objects"]}
        self.assertEqual(sorted(objects), ["dust", "floor", "smooth"])
        self.assertEqual(objects["dust"]["status"], "failed")
        self.assertIn("no texel", objects["dust"]["error"])
        self.assertEqual(objects["floor"]["coverage"], 1)
        self.assertFalse(objects["floor"]["unwrapped"])
        self.assertEqual(objects["floor"]["horizon"]["corners_below"], 0)
        self.assertTrue(objects["smooth"]["unwrapped"])
        self.assertGreater(objects["smooth"]["horizon"]["corners_below"], 0)
        self.assertEqual([entry["key"] for entry in self.manifest["skipped"]], ["left out"])
        self.assertEqual(self.manifest["dispatch"], "scene")

    def test_lists_the_files_that_are_there(self):
        listed = [name for entry in self.manifest["objects"] for name in entry["files"]]
        listed += ["manifest.json", "timings.json", self.manifest["scene_with_uvs"]]
        self.assertEqual(sorted(listed), sorted(path.name for path in (self.folder / "first").iterdir()))

    def test_repeats_bit_by_bit(self):
        again = self.bake("again", "--threads", "2")
        self.assertEqual(self.manifest, again)
        for entry in self.manifest["objects"]:
            for name in entry["files"]:
                self.assertEqual((self.folder / "first" / name).read_bytes(), (self.folder / "again" / name).read_bytes(),
                                 name)

    def test_of_other_settings_fits_too(self):
        manifest = self.bake("other", "--layout", "files", "--recipe", "flat-normal-map", "--dispatch", "object",
                             "--bases", "rnm2,flat", "--flip-green", "--split", "loose", "--save-scene", "never")
        self.assert_valid(manifest)
        floor = next(entry for entry in manifest["objects"] if entry["object"] == "floor")
        self.assertEqual(len(floor["files"]), 3)  # rnm2, flat, coverage
        self.assertEqual(floor["green"], "y-down")
        self.assertEqual(manifest["scene_with_uvs"], "")

    def test_of_a_reference_fits_and_repeats(self):
        manifest = self.lightmaps("reference", "traced", "--threads", "1")
        self.assert_valid(manifest)
        again = self.lightmaps("reference", "traced again", "--threads", "2")
        self.assertEqual(manifest, again)
        for entry in manifest["objects"]:
            for name in entry["files"]:
                self.assertEqual((self.folder / "traced" / name).read_bytes(),
                                 (self.folder / "traced again" / name).read_bytes(), name)
        self.assertEqual([entry["key"] for entry in manifest["objects"]],
                         [entry["key"] for entry in self.manifest["objects"]])
        self.assertEqual([entry["files"] for entry in manifest["objects"]],
                         [entry["files"] for entry in self.manifest["objects"]])
        self.assert_strict(manifest, ((), ("objects", 0)))

    def test_of_a_bake_by_embree_fits_and_repeats(self):
        manifest = self.lightmaps("bake", "embree", "--engine", "embree", "--threads", "1")
        self.assert_valid(manifest)
        self.assertEqual((manifest["kind"], manifest["engine"], manifest["recipe"], manifest["bounces"]),
                         ("bake", "embree", "traced", 32))
        again = self.lightmaps("bake", "embree again", "--engine", "embree", "--threads", "2")
        self.assertEqual(manifest, again)
        for entry in manifest["objects"]:
            for name in entry["files"]:
                self.assertEqual((self.folder / "embree" / name).read_bytes(),
                                 (self.folder / "embree again" / name).read_bytes(), name)
        for what in ("key", "files", "uv_hash", "uv_layer"):
            self.assertEqual([entry[what] for entry in manifest["objects"]],
                             [entry[what] for entry in self.manifest["objects"]], what)
        self.assert_strict(manifest, ((), ("objects", 0)))

    def test_engines_share_a_folder(self):
        name = "both engines"
        self.bake(name, "--save-scene", "never")
        flags = ("--objects", "floor,dust", "--engine", "embree", "--save-scene", "never")
        manifest = self.lightmaps("bake", name, *flags)
        self.assert_valid(manifest)
        objects = {entry["key"]: entry for entry in manifest["objects"]}
        self.assertNotIn("earlier", objects["floor"])
        self.assertEqual(objects["smooth"]["earlier"]["engine"], "cycles")

    def test_schema_is_strict(self):
        self.assert_strict(self.manifest, ((), ("conventions",), ("objects", 0), ("objects", 0, "horizon"), ("bases", 0)),
                           optional=("standard_error",))  # none where there are no halves, or all is black

    def assert_strict(self, manifest, paths, optional=()):
        """Nothing may be missing or added there, but for what is optional."""
        for path in paths:
            spoilt = copy.deepcopy(manifest)
            place = spoilt
            for step in path:
                place = place[step]
            for key in list(place):
                value = place.pop(key)
                if key not in optional:
                    self.assertFalse(is_valid(spoilt), f"{path} without {key}")
                place[key] = value
            place["surprise"] = 1
            self.assertFalse(is_valid(spoilt), f"{path} with more")


if __name__ == "__main__":
    unittest.main()
