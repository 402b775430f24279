"""Lightmaps through `rnmbake deliver` to engines: pages decoded by each engine's formula along its own axes against the bakes,
files read as the engine reads them, and Godot itself where its build for the web can be had.

    RNMBAKE_BINARY=build/release/rnmbake python3 tests/with_blender/deliver/engines_check.py

RNMBAKE_NODE_MODULES names a node_modules folder that holds Godot's build (godot_run.PACKAGE); without it npm fetches it.
"""
import json
from pathlib import Path
import re
import unittest

from engine_case import Engine, baked, delivered, top
import godot_run
from harness import OK, rnmbake
from page_light import covered_texels
from pictures import read_picture, unlike_blocks
import source_case
import unreal_case

HERE = Path(__file__).resolve().parent

PATHS = ["../Scene/floor", "../Scene/box_001", "../Scene/ball", "../Scene/group_ right/panel"]


def import_file(path):
    """Sections of Godot's ConfigFile: values are Godot's, of which these are numbers, words and truths."""
    sections, section = {}, None
    for line in path.read_text().splitlines():
        if line.startswith("["):
            section = sections.setdefault(line.strip("[]"), {})
        elif line:
            name, _, value = line.partition("=")
            section[name] = json.loads(value)
    return sections


class Godot(Engine):
    @staticmethod
    def to_godot(normal):
        return [normal[0], normal[2], -normal[1]]

    def test_pages_decode_to_the_bakes(self):
        """Godot's shader: L0 + 4 L0 (2 t - 1) . n, slices L0, t of y, z and x."""
        out = delivered("godot")
        record = json.loads((out / "lightmaps.json").read_text())
        pages = [read_picture(out / page["layers"]["l0"]) for page in record["pages"]]

        def decode(texel, normal):
            height = pages[texel.page][1] // 4
            l0, ty, tz, tx = (pages[texel.page][2][slice_ * height + texel.y][texel.x] for slice_ in range(4))
            return [l0[c] * (1 + 4 * sum(n * (2 * t[c] - 1) for n, t in zip(normal, (tx, ty, tz)))) for c in "RGB"]

        self.assertEqual(pages[0][1], 4 * record["pages"][0]["height"])
        self.assert_bakes(decode, out, .005, self.to_godot, lambda texel: texel.fits(4), .5)

    def test_pages_have_one_size(self):
        record = json.loads((delivered("godot", "--pages", "64") / "lightmaps.json").read_text())
        self.assertGreater(len(record["pages"]), 1)
        self.assertEqual(len({(page["width"], page["height"]) for page in record["pages"]}), 1)

    def test_godot_is_told_how_to_import(self):
        out = delivered("godot")
        page = import_file(out / "page0.exr.import")
        self.assertEqual(page["remap"], {"importer": "2d_array_texture", "type": "CompressedTexture2DArray"})
        self.assertEqual({name: page["params"][name] for name in ("mipmaps/generate", "slices/horizontal", "slices/vertical")},
                         {"mipmaps/generate": False, "slices/horizontal": 1, "slices/vertical": 4})
        self.assertEqual(import_file(out / "scene.glb.import")["params"]["meshes/light_baking"], 1)

    def test_flat_light_is_one_slice(self):
        out = delivered("godot", "--encoding", "flat")
        record = json.loads((out / "lightmaps.json").read_text())
        self.assertEqual(read_picture(out / "page0.exr")[1], record["pages"][0]["height"])
        self.assertEqual(import_file(out / "page0.exr.import")["params"]["slices/vertical"], 1)
        self.assertIn("uses_spherical_harmonics = false", (out / "lightmaps.tres").read_text())

    def test_paths_are_godots(self):
        users = re.findall(r'NodePath\("([^"]*)"\)', (delivered("godot") / "lightmaps.tres").read_text())
        self.assertEqual(users, PATHS)

    def test_refusals(self):
        self.refused("godot", "--frames")
        self.refused("godot", "'box.a'", "'box_a'", flags=("--encoding", "flat"))


class Unity(Engine):
    @staticmethod
    def to_unity(normal):
        return [-normal[0], normal[2], -normal[1]]

    @staticmethod
    def packed(light):
        return [sum(light) / 3]

    def test_pages_decode_to_the_bakes(self):
        """MonoSH: L0 (1 + 2 (2 t - 1) . n), one t for all colours, in 8 bits. The flat bake has its own colours."""
        out = delivered("unity")
        record = json.loads((out / "lightmaps.json").read_text())
        pages = [[read_picture(out / page["layers"][layer])[2] for layer in ("l0", "dir")] for page in record["pages"]]

        def decode(texel, normal):
            l0, t = (layer[texel.y][texel.x] for layer in pages[texel.page])
            return [l0[c] * (1 + 2 * sum(n * (2 * t[axis] - 1) for n, axis in zip(normal, "RGB"))) for c in "RGB"]

        for texel in covered_texels(out, baked()[1]):
            normal, light = texel.baked["flat"]
            for got, expected in zip(decode(texel, self.to_unity(normal)), light):
                self.assertLessEqual(abs(got - expected), .01 * max(light) + 1e-3)
        self.assert_bakes(decode, out, .02, self.to_unity, lambda texel: texel.fits(2, mean=True), .2)

    def test_pictures_have_their_meta(self):
        out, again = delivered("unity"), delivered("unity", "--encoding", "zh3")
        for name, kind in (("page0.l0.exr", 6), ("page0.dir.png", 0)):
            text = (out / (name + ".meta")).read_text()
            self.assertRegex(text, r"(?m)^guid: [0-9a-f]{32}$")
            for setting in ("sRGBTexture: 0", "enableMipMap: 0", "wrapU: 1", f"textureType: {kind}", "textureCompression: 2"):
                self.assertRegex(text, rf"(?m)^ +{setting}$")
            self.assertEqual(text, (again / (name + ".meta")).read_text())

    def test_the_component_and_a_decoder_come_along(self):
        out = delivered("unity")
        for name in ("RnmbakeLightmaps.cs", "RnmbakeLightmapsMenu.cs"):
            self.assertEqual((out / name).read_text(), (HERE.parents[2] / "engines" / "unity" / name).read_text())
        self.assertIn("rnmbake_unity_monosh(", (out / "rnmbake_sh2.cginc").read_text())

    def test_a_bake_without_frames(self):
        self.refused("unity", "--frames")


class Unreal(unreal_case.UnrealCase):
    """The script in a fake of Unreal's editor."""


class Source(source_case.SourceCase):
    """By readers of its formats."""


class RunningGodot(godot_run.Godot):
    """Godot 4.6 in Chromium. Its importer is in its editor alone: godot_check.gd stands in for it."""

    def test_it_shows_what_render_shows(self):
        scene, maps = baked()
        shown = self.show(delivered("godot"))
        self.assertEqual(shown.users, [[path, "MeshInstance3D"] for path in PATHS])
        encoded, picture = top() / "encoded", top() / "view.exr"
        for words in (("convert", maps, "--to", "sh2", "--range", "4", "-o", encoded, "-q"),
                      ("render", scene, "--lightmaps", encoded, "--decode", "encoded", "-o", picture, "--resolution",
                       f"{shown.width}x{shown.height}", "--samples", "64", "-q")):
            done = rnmbake(*words)
            self.assertEqual(done.returncode, OK, done.stderr)
        compared, off = unlike_blocks(read_picture(picture), shown.light)
        self.assertGreater(compared, 100)
        self.assertLessEqual(len(off), .3 * compared, f"{len(off)} of {compared}")  # at edges of shadows and objects


if __name__ == "__main__":
    unittest.main()
