"""What a bake saves beside its maps: a scene in which pictures, names, UV layers and what was baked before are found again.

    RNMBAKE_BINARY=build/release/rnmbake python3 tests/with_blender/saved_scene_check.py
"""
import json
from pathlib import Path
import tempfile
import unittest

import harness

PATH = "/usr/sbin:/usr/bin:/sbin:/bin"  # another Python in it would become Blender's, without numpy for the exporter
LONG = "Säule mit einem Namen, der länger ist als sechzig Zeichen ä"


def corners(uv):
    return list(zip(uv[::2], uv[1::2]))


class SavedScene(unittest.TestCase):
    """All objects are baked, then one of them again: what holds of the scene that is there then held before, too."""

    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory(prefix="rnmbake-saved-")
        cls.addClassCleanup(folder.cleanup)
        cls.folder = Path(folder.name)
        cls.script("saved_cases.py", cls.folder)
        cls.maps = cls.folder / "maps" / "here"
        cls.rnmbake("bake")
        cls.first = cls.manifest()
        cls.rnmbake("bake", "--objects", "crate", "--seed", "7")
        cls.second = cls.manifest()
        cls.script("saved_look.py", cls.folder / "look.json", cls.folder / "export.gltf",
                   scene=cls.maps / cls.second["scene_with_uvs"])
        cls.look = json.loads((cls.folder / "look.json").read_text(encoding="utf-8"))

    @classmethod
    def script(cls, name, *arguments, scene=None):
        harness.run_blender(harness.SCENES / name, *arguments, scene=scene, PATH=PATH)

    @classmethod
    def rnmbake(cls, command, *flags):
        output = ["-o", cls.maps, "--bases", "flat", "--resolution", "16"] if command == "bake" else []
        done = harness.rnmbake(command, cls.folder / "scene.blend", *output, "--samples", "1", *flags)
        if done.returncode:
            raise AssertionError(f"exit code {done.returncode}: {done.stderr}")
        return done.stderr

    @classmethod
    def manifest(cls):
        return json.loads((cls.maps / "manifest.json").read_text(encoding="utf-8"))

    def test_paths_lead_to_the_same_files_and_stay_relative(self):
        self.assertEqual(self.look["pictures"].keys() - {""}, {"//../../textures/brick.png", "//../../textures/tiles.<UDIM>.png",
                                                               "//textures/wood.png"})
        self.assertEqual(self.look["libraries"].keys(), {"//../../library.blend"})
        self.assertTrue(all(self.look["pictures"].values()) and all(self.look["libraries"].values()), self.look)
        self.assertEqual([path.name for path in self.maps.iterdir() if path.suffix not in (".exr", ".json")],
                         ["scene.lightmap-uvs.blend"])

    def test_settings_stay(self):
        self.assertEqual(self.look["render"], ["CYCLES", 123, None])

    def test_objects_keep_names_places_and_all_else(self):
        objects = self.look["objects"]
        self.assertEqual(len(objects), len(self.second["objects"]))
        self.assertEqual(self.look["others"], [])
        crate, lid = objects["crate"], objects["lid"]
        self.assertEqual((crate["corners"], crate["modifiers"], crate["pass_index"], crate["kept"]), (48, 0, 3, "yes"))
        self.assertEqual((lid["parent"], objects["flower"]["parent"]), ("crate", "vase"))
        self.assertEqual(objects[LONG]["corners"], 96)
        self.assertEqual(self.look["places"]["flower"], [0, 8, 3])
        self.assertEqual(self.look["places"]["vase"], [0, 8, 0])

    def test_manifest_names_each_object_and_its_key(self):
        for entry in self.second["objects"]:
            self.assertEqual(self.look["objects"][entry["object_in_scene"]]["key"], entry["key"])
        names = {entry["key"]: entry["object_in_scene"] for entry in self.second["objects"]}
        self.assertEqual(names[LONG], LONG)
        self.assertEqual(sum(key.startswith("row of twins") for key in names), 4)
        self.assertTrue(all(len(name.encode()) <= 63 for name in names.values()))

    def test_instances_keep_what_a_render_reads_of_them(self):
        rows = {name: ob for name, ob in self.look["objects"].items() if name.startswith("row of twins")}
        self.assertEqual(len(rows), 4)
        for name, ob in rows.items():
            first = name.startswith("row of twins/")
            self.assertEqual(ob["flags"], {"glossy": False, "shadow": first, "diffuse": True, "color": [0.1, 0.2, 0.3, 1],
                                           "terminator": 0.25, "wear": 0.5}, name)
            self.assertEqual(ob["pass_index"], 4)

    def test_lightmap_is_the_second_layer(self):
        for entry in self.second["objects"]:
            ob = self.look["objects"][entry["object_in_scene"]]
            self.assertEqual(ob["layers"].index(entry["uv_layer"]), 1, entry["key"])
            self.assertEqual(entry["uv_index"], 1)
        source = {entry["key"]: entry["uv_index_in_source"] for entry in self.second["objects"]}
        self.assertEqual([source[key] for key in ("third", "first", "only", "lid", "bare")], [2, 0, 0, 1, -1])
        objects = self.look["objects"]
        self.assertEqual([objects[name]["layers"] for name in ("third", "first", "lid")],
                         [["A", "Lightmap", "B"], ["Tiles", "Lightmap"], ["Tiles", "Stains"]])
        self.assertEqual([objects[name]["render"] for name in ("third", "first", "lid")], ["B", "Tiles", "Stains"])
        for name in ("bare", "only"):
            self.assertEqual(objects[name]["uvs"]["UVMap"], objects[name]["uvs"]["Lightmap"])
        # Each layer's content moved with its name: they lie 0.01 apart.
        for layer, other, apart in (("A", "B", 0.01), ("A", "Lightmap", 0.02)):
            uvs = objects["third"]["uvs"]
            self.assertTrue(all(abs(b - a - apart) < 1e-4 for a, b in zip(uvs[layer], uvs[other])))

    def test_objects_of_one_mesh_and_other_scales_have_their_own_uvs(self):
        objects = self.look["objects"]
        self.assertNotEqual(objects["large"]["uvs"]["Lightmap"], objects["small"]["uvs"]["Lightmap"])
        self.assertEqual(objects["large"]["uvs"]["UVMap"], objects["small"]["uvs"]["UVMap"])

    def test_exported_scene_has_the_lightmap_in_texcoord_1(self):
        exported = json.loads((self.folder / "export.gltf").read_text(encoding="utf-8"))
        data = (self.folder / exported["buffers"][0]["uri"]).read_bytes()
        nodes = {node["name"]: node for node in exported["nodes"] if "mesh" in node}
        self.assertEqual(nodes.keys(), self.look["objects"].keys())
        for name, node in nodes.items():
            uvs = self.look["objects"][name]["uvs"]
            wanted = {(round(u, 4), round(1 - v, 4)) for u, v in corners(uvs[self.look["objects"][name]["layers"][1]])}
            found = set()
            for primitive in exported["meshes"][node["mesh"]]["primitives"]:
                accessor = exported["accessors"][primitive["attributes"]["TEXCOORD_1"]]
                start = exported["bufferViews"][accessor["bufferView"]].get("byteOffset", 0) + accessor.get("byteOffset", 0)
                values = memoryview(data[start:start + 8 * accessor["count"]]).cast("f")
                found |= {(round(u, 4), round(v, 4)) for u, v in corners(list(values))}
            self.assertTrue(all(any(abs(u - a) + abs(v - b) < 1e-3 for a, b in found) for u, v in wanted), name)

    def test_second_bake_keeps_what_it_left_alone(self):
        first = {entry["key"]: entry for entry in self.first["objects"]}
        second = {entry["key"]: entry for entry in self.second["objects"]}
        self.assertEqual(list(first), list(second))
        again = {key for key, entry in second.items() if "earlier" not in entry}
        self.assertEqual({second[key]["object"] for key in again}, {"crate"})
        self.assertEqual({second[key]["seed"] for key in again}, {7})
        for key in second.keys() - again:
            earlier = second[key].pop("earlier")
            self.assertEqual(second[key], first[key])
            of_run = {name: self.first[name] for name in ("rnmbake", "blender", "engine", "recipe", "materials", "bounces")}
            self.assertEqual(earlier, of_run | {"footprint": self.first["conventions"]["footprint"]})
            self.assertTrue((self.maps / second[key]["files"][0]).is_file())
        self.assertEqual(self.second["skipped"], [])

    def test_render_finds_every_lightmap(self):
        said = self.rnmbake("render", "--lightmaps", str(self.maps), "--decode", "single", "--resolution", "16x9", "-o",
                            str(self.folder / "view.exr"))
        self.assertIn("camera 'camera': views look through it", said)
        for fault in ("so traced", "left out", "not in the scene", "picture missing"):
            self.assertNotIn(fault, said)


if __name__ == "__main__":
    unittest.main()
