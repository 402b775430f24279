"""Broken glTF files are told in one line each, without Blender: blender_scripts/core/gltf_*.py."""
import json
import os
from pathlib import Path
import random
import struct
import sys
import tempfile
import unittest

TESTS = Path(__file__).resolve().parents[1]
sys.path[:0] = [str(TESTS.parent / "blender_scripts"), str(TESTS / "with_blender" / "scenes")]

from core.gltf_accessors import read_elements  # noqa: E402
from core.gltf_file import BrokenGltf, UnsupportedGltf  # noqa: E402
from core.gltf_open import open_gltf  # noqa: E402
from gltf_cases import LIT, SUNLIT, Cells  # noqa: E402
from gltf_writer import BYTE, SHORT, UNSIGNED_BYTE, UNSIGNED_SHORT, Writer, container  # noqa: E402


def knows_nothing(_extension):
    return False


class Files(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.path = os.path.join(folder.name, "scene.glb")

    def opened(self, data):
        with open(self.path, "wb") as stream:
            stream.write(data)
        return open_gltf(self.path, knows_nothing)

    def assert_broken(self, data, *words, kind=BrokenGltf):
        with self.assertRaises(kind) as caught:
            self.opened(data)
        message = str(caught.exception)
        self.assertNotIn("\n", message)
        for word in words:
            self.assertIn(word, message)


def scene():
    """A quad with a texture, as a Writer that a test breaks."""
    w = Writer()
    material = w.add("materials", pbrMetallicRoughness={"baseColorTexture": {"index": w.picture([(1, 2, 3, 4)], 1)}})
    w.node(name="floor", mesh=w.quad("floor", 1, material))
    return w


class Broken(Files):
    def broken(self, change, *words, **kind):
        w = scene()
        change(w.json)
        self.assert_broken(w.glb(), *words, **kind)

    def test_whole(self):
        gltf, _ = self.opened(scene().glb())
        self.assertEqual([node["name"] for node in gltf.items("nodes")], ["floor"])

    def test_cut_off(self):
        whole = scene().glb()
        for length in (4, 11, 15, 100, len(whole) - 1):
            with self.subTest(length=length):
                self.assert_broken(whole[:length], "cut off")

    def test_something_else(self):
        self.assert_broken(b"Dear diary,\n", "no glTF")
        self.assert_broken(b"", "no glTF")
        self.assert_broken(b"[]", "no glTF")
        self.assert_broken(b'{"asset": {"version": NaN}}', "NaN")
        self.assert_broken(b'{"asset": {"version": "1.0"}}', "glTF 1.0", "convert")
        self.assert_broken(struct.pack("<4sII", b"glTF", 1, 12), "version 1")

    def test_nested_without_end(self):
        for text in (b"[" * 10 ** 6, b'{"a":' * 10 ** 6):
            self.assert_broken(container(text), "nested")

    def test_long_digits(self):
        self.broken(lambda g: g.update(scene=int("9" * 50)), "default scene")

    def test_buffers(self):
        self.broken(lambda g: g["bufferViews"][0].update(byteLength=10 ** 9), "buffer view 0")
        self.broken(lambda g: g["bufferViews"][0].update(byteOffset=-1), "buffer view 0")
        self.broken(lambda g: g["bufferViews"][0].update(buffer=7), "bufferViews", "7")
        self.broken(lambda g: g["accessors"][0].update(count=10 ** 12), "accessor 0")
        self.broken(lambda g: g["accessors"][0].update(componentType=1), "accessor 0")
        self.broken(lambda g: g["accessors"].append({"componentType": 5126, "type": "VEC3", "count": 10 ** 9}),
                    "no buffer holds")
        w = scene()
        w.json["buffers"] = [{"byteLength": len(w.binary), "uri": "there is none.bin"}]
        self.assert_broken(json.dumps(w.json).encode(), "there is none.bin", "missing")
        w.json["buffers"] = [{"byteLength": len(w.binary), "uri": "http://example.com/a.bin"}]
        self.assert_broken(json.dumps(w.json).encode(), "http://example.com/a.bin")
        w.json["buffers"] = [{"byteLength": len(w.binary), "uri": "data:application/octet-stream;base64,AAAA"}]
        self.assert_broken(json.dumps(w.json).encode(), "cut off: 3 bytes")
        w.json["buffers"] = [{"byteLength": len(w.binary)}]
        self.assert_broken(json.dumps(w.json).encode(), "no data")

    def test_references(self):
        self.broken(lambda g: g["nodes"][0].update(extensions={"KHR_lights_punctual": {}}), "KeyError('light')")
        self.broken(lambda g: g["nodes"][0].update(mesh=3), "meshes", "3")
        self.broken(lambda g: g["nodes"][0].update(mesh="floor"), "meshes", "floor")
        self.broken(lambda g: g["materials"][0].update(occlusionTexture={"index": 9}), "occlusionTexture", "texture 9")
        self.broken(lambda g: g["scenes"][0].update(nodes=[-1]), "scenes", "-1")
        self.broken(lambda g: g.update(meshes=5), "meshes")
        self.broken(lambda g: g["meshes"][0].update(primitives=[]), "mesh 'floor'", "primitives")

    def test_indices_beyond_the_vertices(self):
        w = Writer()
        w.node(mesh=w.mesh("bad", [(0, 0, 0), (1, 0, 0), (0, 1, 0)], (0, 1, 3)))
        self.assert_broken(w.glb(), "'bad'", "index of 3", "3 vertices")

    def test_nodes(self):
        self.broken(lambda g: g["nodes"].extend([{"children": [2]}, {"children": [1]}]), "circle")
        self.broken(lambda g: g["nodes"].append({"children": [1]}), "circle")
        self.broken(lambda g: g["nodes"].extend([{"children": [0]}, {"children": [0]}]), "below two")
        self.broken(lambda g: g["nodes"].extend({"children": [i + 2]} for i in range(2000)), "nodes", "2001")
        self.broken(lambda g: g["nodes"].extend([*({"children": [i + 2]} for i in range(2000)), {}]), "deeper")
        self.broken(lambda g: g["nodes"][0].update(translation=[0, 0]), "floor", "translation")
        self.broken(lambda g: g["nodes"][0].update(translation=[0, 0, 1e400]), "JSON")

    def test_required_extension(self):
        self.broken(lambda g: g.update(extensionsUsed=["EXT_x"], extensionsRequired=["EXT_x"]), "EXT_x",
                    kind=UnsupportedGltf)

    def test_whatever_is_changed(self):
        """Values of other kinds in all places: one line, never a traceback of ours."""
        cells = Cells()
        for part in SUNLIT + LIT:
            part(cells)
        whole = json.dumps(cells.w.json)
        chance, told = random.Random(1), 0
        for _ in range(100):
            cells.w.json = json.loads(whole)
            owner, key = chance.choice(places_in(cells.w.json))
            owner[key] = chance.choice([None, True, -1, 10 ** 9, 0.5, "text", [], {}, [[]], {"a": {}}, ["a"]])
            try:
                self.opened(cells.w.glb())
            except BrokenGltf as error:
                told += 1
                self.assertNotIn("\n", str(error))
        self.assertGreater(told, 25)


def places_in(value):
    """(container, key) of everything inside."""
    found = [(value, key) for key in (value if isinstance(value, dict) else range(len(value)))]
    for owner, key in list(found):
        if isinstance(owner[key], (dict, list)):
            found += places_in(owner[key])
    return found


class Accessors(Files):
    def test_values(self):
        w = Writer()
        w.accessor([(-127, 0, 127)], BYTE, normalized=True)
        w.accessor([(0, 255)], UNSIGNED_BYTE, normalized=True)
        w.accessor([(-32768, 32767)], SHORT, normalized=True)
        w.accessor([(1, 65535)], UNSIGNED_SHORT)
        w.accessor([(1.5,)])
        strided = w.view(struct.pack("<ff4xff4x", 1, 2, 3, 4), byteStride=12)
        w.add("accessors", bufferView=strided, componentType=5126, count=2, type="VEC2")
        indices, values = w.view(struct.pack("<H", 2)), w.view(struct.pack("<f", 7))
        w.add("accessors", componentType=5126, count=3, type="SCALAR",
              sparse={"count": 1, "indices": {"bufferView": indices, "componentType": UNSIGNED_SHORT},
                      "values": {"bufferView": values}})
        gltf, _ = self.opened(w.glb())
        read = [read_elements(gltf, number) for number in range(7)]
        self.assertEqual(read, [[(-1, 0, 1)], [(0, 1)], [(-1, 1)], [(1, 65535)], [(1.5,)], [(1, 2), (3, 4)],
                                [(0,), (0,), (7,)]])


class Prepared(Files):
    def test_instances_become_nodes(self):
        w = scene()
        places = {"TRANSLATION": w.accessor([(i, 0, 0) for i in range(1899)])}
        w.json["nodes"][0].update(extensions={"EXT_mesh_gpu_instancing": {"attributes": places}})
        gltf, notes = self.opened(w.glb())
        self.assertEqual(notes, [])
        placed = gltf.items("nodes")[1:]
        self.assertEqual(len(placed), 1899)
        self.assertEqual(placed[7], {"name": "floor#7", "mesh": 0, "translation": (7, 0, 0)})
        self.assertEqual(gltf.items("nodes")[0]["children"], list(range(1, 1900)))
        self.assertNotIn("mesh", gltf.items("nodes")[0])

    def test_uneven_instances(self):
        w = scene()
        places = {"TRANSLATION": w.accessor([(0, 0, 0)]), "SCALE": w.accessor([(1, 1, 1), (2, 2, 2)])}
        w.json["nodes"][0].update(extensions={"EXT_mesh_gpu_instancing": {"attributes": places}})
        self.assert_broken(w.glb(), "'floor'", "differ in number")

    def test_notes(self):
        w = scene()
        w.json["meshes"][0]["primitives"].append({"attributes": {}})
        w.json["textures"][0] = {"extensions": {"KHR_texture_basisu": {"source": 0}}, "name": "wall"}
        w.json["materials"][0].update(name="film", extensions={"KHR_materials_iridescence": {}})
        w.json["extensions"] = {"EXT_lights_image_based": {"lights": []}}
        w.json["animations"] = [{}]
        _, notes = self.opened(w.glb())
        for words in ("EXT_lights_image_based is not followed: its environment",
                      "KHR_materials_iridescence is not followed (material 'film')",
                      "animations are not followed (1)",
                      "picture unreadable: glTF texture 'wall' has none that Blender reads (KHR_texture_basisu)",
                      "without a material"):
            self.assertTrue(any(words in note for note in notes), (words, notes))
        self.assertEqual(len(notes), 5, notes)

    def test_pictures_of_other_kinds_stand_in(self):
        w = scene()
        source = w.json["textures"][0].pop("source")
        w.json["textures"][0]["extensions"] = {"EXT_texture_webp": {"source": source}}
        w.extension("EXT_texture_webp", required=True)
        gltf, notes = self.opened(w.glb())
        self.assertEqual((notes, gltf.items("textures")[0]["source"]), ([], source))


if __name__ == "__main__":
    unittest.main()
