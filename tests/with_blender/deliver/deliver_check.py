"""Scenes through `rnmbake deliver`: the .glb by the Khronos validator and by Blender, its light by three.js in headless
Chromium against `rnmbake render`.

    RNMBAKE_BINARY=build/release/rnmbake python3 tests/with_blender/deliver/deliver_check.py

RNMBAKE_NODE_MODULES names a node_modules folder that holds three and gltf-validator; without it npm fetches them. What needs
them is left out, with a word, where there is no Chromium, npm or network.
"""
import functools
import json
import math
import os
import re
import shutil
import subprocess
import sys
import unittest

from engine_view import HERE, QUICK, Delivered, EngineView, deliver, delivered_once, embedded, json_of
from harness import OK, UNSUPPORTED, USAGE, rnmbake, run_blender
import browser
import page_reading
from pictures import read_picture
import served

PACKAGES = (served.THREE, "gltf-validator@2.0.0-dev.3.10", "ktx-parse@2.0.0")
ZSTD_TOO = "ktx2-b10g11r11"  # as which pages are compressed, too
# UNSUPPORTED_EXTENSION: the lightmap's; the others are hints on what is not used by every reader.
KNOWN_NOTICES = {"UNSUPPORTED_EXTENSION", "UNUSED_OBJECT", "IMAGE_NPOT_DIMENSIONS"}


@functools.cache
def delivered_as(format_):
    """The first delivery's maps with pages of another format."""
    top, _ = delivered_once("threejs")
    out = top / ("as " + format_)
    done = deliver("threejs", top / "site" / ".lightmaps", out, "--encoding", "rnm-vrad",
                   "--page-format", format_, *(["--page-zstd"] if format_ == ZSTD_TOO else []))
    assert done.returncode == OK, done.stderr
    return out


class Glb(Delivered):
    def test_validator_has_nothing_to_say(self):
        modules = served.node_modules(self.top, *PACKAGES)
        script = ("const v=require('gltf-validator'),fs=require('fs');v.validateBytes(new Uint8Array(fs.readFileSync("
                  "process.argv[1])),{maxIssues:0}).then(r=>console.log(JSON.stringify(r.issues)))")
        done = subprocess.run(["node", "-e", script, str(self.out / "scene.glb")], capture_output=True, text=True, check=True,
                              env={**os.environ, "NODE_PATH": str(modules)})
        issues = json.loads(done.stdout)
        self.assertEqual(issues["numErrors"], 0, issues)
        self.assertEqual({one["code"] for one in issues["messages"]} - KNOWN_NOTICES, set(), issues)

    def test_each_object_has_its_record(self):
        gltf = json_of(self.out / "scene.glb")
        manifest = json.loads((self.maps / "manifest.json").read_text())
        keys = {one["key"] for one in manifest["objects"]}
        self.assertEqual({one["key"] for one in self.record["objects"]}, keys)
        for placed in self.record["objects"]:
            node = gltf["nodes"][placed["node"]]
            self.assertEqual(node["name"], placed["name"])
            self.assertEqual(node["extras"]["rnmbake"]["key"], placed["key"])
            for primitive in gltf["meshes"][node["mesh"]]["primitives"]:
                self.assertIn("TEXCOORD_1", primitive["attributes"])
                lightmap = gltf["materials"][primitive["material"]]["extensions"]["MOZ_lightmap"]
                self.assertEqual(lightmap["texCoord"], 1)
        self.assertEqual(gltf["extras"]["rnmbake"]["pages"], self.record["pages"])

    def test_uvs_lead_to_the_texels_that_were_baked(self):
        """Blender imports the .glb; each object's second UV set lies in its box of the page."""
        listing = self.top / "uvs.json"
        run_blender(HERE / "read_glb.py", self.out / "scene.glb", listing)
        found = json.loads(listing.read_text())
        maps = {one["key"]: one for one in json.loads((self.maps / "manifest.json").read_text())["objects"]}
        for placed in self.record["objects"]:
            uv = found[placed["name"]]
            for axis, size in ((0, "width"), (1, "height")):
                low, high = placed["offset"][axis], placed["offset"][axis] + placed["scale"][axis]
                self.assertGreaterEqual(uv["low"][axis], low - 1e-5, placed["key"])
                self.assertLessEqual(uv["high"][axis], high + 1e-5, placed["key"])
                texels = placed["scale"][axis] * self.record["pages"][placed["page"]][size]
                self.assertAlmostEqual(texels, maps[placed["key"]][size], delta=1e-6)


class Nodes(unittest.TestCase):
    @staticmethod
    def picture(glb, gltf, material):
        texture = gltf["textures"][material["pbrMetallicRoughness"]["baseColorTexture"]["index"]]
        file = glb.parent / "picture.png"
        file.write_bytes(embedded(glb, gltf["images"][texture["source"]]["bufferView"]))
        return read_picture(file)

    def test_what_gltf_has_words_for_is_said(self):
        top, _ = delivered_once("threejs")
        scene, out = top / "nodes.blend", top / "nodes"
        run_blender(HERE / "nodes_scene.py", scene)
        done = deliver("gltf", scene, out, "--resolution", "8")
        self.assertEqual(done.returncode, OK, done.stderr)
        gltf = json_of(out / "scene.glb")
        materials = {one["name"]: one for one in gltf["materials"]}
        self.assertEqual(materials["outside"]["emissiveFactor"], [1, .5, .25])
        self.assertEqual(materials["outside"]["extensions"]["KHR_materials_emissive_strength"], {"emissiveStrength": 7})
        self.assertEqual((materials["leaf"]["alphaMode"], materials["lace"]["alphaMode"]), ("MASK", "BLEND"))
        self.assertIn("baseColorTexture", materials["leaf"]["pbrMetallicRoughness"])
        _, _, ((texel, *_), *_) = self.picture(out / "scene.glb", gltf, materials["lace"])
        self.assertAlmostEqual(texel["A"], .214, delta=1 / 255)  # the luminance of the linear colour
        self.assertAlmostEqual(texel["R"] / texel["A"], .5, delta=.02)  # oiiotool multiplies by alpha
        self.assertNotIn("alphaMode", materials["faded"])
        _, _, ((texel, *_), *_) = self.picture(out / "scene.glb", gltf, materials["faded"])
        for channel, value in zip("RGB", (.375, .25, .125)):  # times the alpha that nothing asks for, as Cycles shows it
            self.assertAlmostEqual(texel[channel], value, delta=1 / 255)
        for name in "lace", "faded":
            of_each = [materials[one]["pbrMetallicRoughness"]["baseColorTexture"]["index"] for one in (name, name + ".001")]
            self.assertEqual(len({gltf["textures"][index]["source"] for index in of_each}), 1, name)
        for name, opacity in (("film", .25), ("veil", .5)):
            self.assertEqual(materials[name]["alphaMode"], "BLEND")
            self.assertAlmostEqual(materials[name]["pbrMetallicRoughness"]["baseColorFactor"][3], opacity)
        (note,) = json.loads((out / "lightmaps.json").read_text())["notes"]
        self.assertIn("material 'pattern': its light's strength comes out of the node 'Noise Texture'", note)

    def test_materials_share_what_is_made_of_a_picture(self):
        top, _ = delivered_once("threejs")
        scene, listing = top / "shared.blend", top / "shared.json"
        run_blender(HERE / "nodes_scene.py", scene)
        run_blender(HERE / "made_pictures.py", listing, scene=scene)
        self.assertEqual(json.loads(listing.read_text()), ["faded times alpha", "lace as opacity"])


class Again(Delivered):
    def test_only_what_changed_is_written(self):
        times = {path.name: path.stat().st_mtime_ns for path in self.out.iterdir() if path.is_file()}
        done = deliver("threejs", self.scene, self.out)
        self.assertEqual(done.returncode, OK, done.stderr)
        self.assertEqual({path.name: path.stat().st_mtime_ns for path in self.out.iterdir() if path.is_file()}, times)

    def test_another_encoding_takes_the_place_of_the_first(self):
        out = self.top / "other"
        self.assertEqual(deliver("threejs", self.maps, out).returncode, OK)
        done = deliver("threejs", self.maps, out, "--encoding", "zh3")
        self.assertEqual(done.returncode, OK, done.stderr)
        names = {path.name for path in out.iterdir()}
        self.assertIn("page0.l1x.exr", names)
        self.assertNotIn("page0.rnm0.exr", names)
        self.assertEqual(set(json.loads((out / "lightmaps.json").read_text())["files"]), names)


class Pages(Delivered):
    """Pages as readers that know nothing of ours see them, against those of the first delivery, which are EXR."""

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.modules = served.node_modules(cls.top, *PACKAGES)
        cls.exr = page_reading.picture(cls.out / cls.record["pages"][0]["layers"]["rnm0"])

    def delivered_as(self, format_):
        out = delivered_as(format_)
        page = json.loads((out / "lightmaps.json").read_text())["pages"][0]
        self.assertEqual(page["format"], format_)
        return page, out / page["layers"]["rnm0"]

    def assert_near(self, seen, page, most, rmse):
        """Each texel of the maps within `most` of its brightest channel, and all within what the record says is lost."""
        self.assertEqual(len(seen), len(self.exr))
        square = brightness = 0
        for texel, true in zip(seen, self.exr):
            if not any(true):
                continue
            off = [a - b for a, b in zip(texel, true)]
            square += sum(one * one for one in off)
            brightness += sum(one * one for one in true)
            self.assertLessEqual(max(map(abs, off)), 1.01 * most * max(true) + 1e-6, (texel, true))
        self.assertLess((square / brightness) ** .5, rmse)
        loss = page["loss"]["rnm0"]
        self.assertLess(loss["relative_rmse"], 2 * rmse)
        self.assertLess(abs(loss["relative_bias"]), rmse / 2 + 1e-9)
        self.assertLessEqual(loss["max"], most * max(map(max, self.exr)) + 1e-6)


class PageFormats(Pages):
    def test_ktx2(self):
        for format_, vk, samples, most, rmse in (("ktx2-rgba16f", page_reading.RGBA16F, 4, 0, 1e-9),
                                                 ("ktx2-b10g11r11", page_reading.B10G11R11, 3, 1 / 64, .008),
                                                 ("ktx2-bc6h", page_reading.BC6H_UF, 1, math.inf, .05)):
            with self.subTest(format_):
                page, file = self.delivered_as(format_)
                parsed = page_reading.parse_ktx2(self.modules, file)
                self.assertEqual((parsed["vkFormat"], parsed["pixelWidth"], parsed["pixelHeight"], parsed["pixelDepth"]),
                                 (vk, page["width"], page["height"], 0))
                self.assertEqual((len(parsed["levels"]), page["mips"]), (3, 2))  # the padding is 4
                (descriptor,) = parsed["dataFormatDescriptor"]
                self.assertEqual(len(descriptor["samples"]), samples)
                for level, data in enumerate(parsed["levels"]):
                    width, height = (max(1, page[side] >> level) for side in ("width", "height"))
                    texels = (width + 3) // 4 * 16 * ((height + 3) // 4) if samples == 1 else width * height
                    self.assertEqual(len(data), texels * page_reading.TEXEL_BYTES[vk])
                if format_ == ZSTD_TOO:
                    self.assertLess(sum(parsed["stored"]), .95 * sum(map(len, parsed["levels"])))
                self.assert_near(page_reading.level_texels(parsed, 0, self.top), page, most, rmse)

    def test_radiance(self):
        page, file = self.delivered_as("hdr")
        self.assert_near(page_reading.picture(file), page, 1 / 256, .004)


class Ktx2Loader(Pages, served.Served):
    """three.js's own loader, which our module does not use."""

    @classmethod
    def setUpClass(cls):
        browser.require()
        super().setUpClass()
        folder = cls.top / "loader"
        folder.mkdir()
        (folder / "node_modules").symlink_to(cls.modules)
        shutil.copy(HERE / "views" / "ktx2.html", folder)
        cls.serve(cls.top, 64, 64)

    def levels(self, file):
        self.open("loader/ktx2.html")
        levels = self.browser.run(f"levelsOf({json.dumps('../' + str(file.relative_to(self.top)))})")
        self.assertEqual(self.problems(), [])
        return levels

    def test_texels_are_those_of_the_exr(self):
        for format_, most, rmse in (("ktx2-rgba16f", 0, 1e-9), ("ktx2-b10g11r11", 1 / 64, .008), ("ktx2-e5b9g9r9", 1 / 256, .002)):
            with self.subTest(format_):
                page, file = self.delivered_as(format_)
                levels = [[tuple(level[k:k + 3]) for k in range(0, len(level), 3)] for level in self.levels(file)]
                self.assert_near(levels[0], page, most, rmse)
                parsed = page_reading.parse_ktx2(self.modules, file)
                self.assertEqual(len(levels), len(parsed["levels"]))
                for number, seen in enumerate(levels):
                    self.assertEqual(seen, page_reading.level_texels(parsed, number, self.top))

    def test_blocks_are_refused(self):
        """So docs/engines/threejs.md says; where this fails, the loader has learned them."""
        _, file = self.delivered_as("ktx2-bc6h")
        self.assertEqual(self.levels(file), "THREE.KTX2Loader: Unsupported vkFormat: 143")


class Bevy(Delivered):
    """Of its structure alone: the module's words are Bevy's, its tables the record's."""

    def test_module_names_every_node_and_page(self):
        out = self.top / "bevy"
        done = deliver("bevy", self.maps, out, "--page-format", "ktx2-b10g11r11")
        self.assertEqual(done.returncode, OK, done.stderr)
        record, code = json.loads((out / "lightmaps.json").read_text()), (out / "rnmbake_lightmaps.rs").read_text()
        self.assertEqual(record["encoding"], "flat")
        nodes = {gltf["name"] for gltf in json_of(out / "scene.glb")["nodes"]}
        listed = re.findall(r'^ {4}\("(.*)", (\d+)\),$', code, re.MULTILINE)
        self.assertEqual([(name, int(page)) for name, page in listed], [(one["name"], one["page"]) for one in record["objects"]])
        self.assertLessEqual({name for name, _ in listed}, nodes)
        self.assertEqual(re.findall(r'^ {4}"(.*)",$', code, re.MULTILINE), [page["layers"]["flat"] for page in record["pages"]])
        for page in record["pages"]:
            self.assertTrue((out / page["layers"]["flat"]).is_file())
        self.assertIn("use bevy::pbr::Lightmap;", code)
        if shutil.which("rustfmt"):
            said = subprocess.run(["rustfmt", "--edition", "2024", "--check", str(out / "rnmbake_lightmaps.rs")], capture_output=True,
                                  text=True)
            self.assertNotIn("error", said.stderr)


class Refusals(Delivered):
    def refused(self, done, code, *words):
        self.assertEqual(done.returncode, code, done.stderr)
        for word in words:
            self.assertIn(word, done.stderr)

    def test_a_page_that_is_too_small(self):
        out = self.top / "small"
        self.refused(deliver("threejs", self.maps, out, "--pages", "32"), UNSUPPORTED, "--pages")
        self.assertFalse((out / "lightmaps.json").exists())

    def test_an_encoding_without_decoder(self):
        self.refused(deliver("threejs", self.maps, self.top / "none", "--encoding", "flat"), UNSUPPORTED, "flat")

    def test_formats_that_do_not_hold_it(self):
        out = self.top / "format"
        self.refused(deliver("threejs", self.maps, out, "--page-format", "png-rgbm"), UNSUPPORTED, "threejs", "ktx2-bc6h")
        self.refused(deliver("gltf", self.maps, out, "--encoding", "zh3", "--page-format", "hdr"), UNSUPPORTED, "l1", "below 0")
        self.refused(deliver("gltf", self.maps, out, "--page-format", "hdr", "--page-mips", "1"), USAGE, "mipmaps")
        self.refused(deliver("gltf", self.maps, out, "--page-format", "ktx2-bc6h", "--page-mips", "4"), USAGE, "--page-padding 16")
        self.assertFalse((out / "lightmaps.json").exists())

    def test_a_bake_without_a_saved_scene(self):
        bare = self.top / "bare"
        done = rnmbake("bake", self.scene, "-o", bare, *QUICK[2:], "--engine", "embree", "--objects", "floor", "--save-scene",
                       "never")
        self.assertEqual(done.returncode, OK, done.stderr)
        self.refused(deliver("gltf", bare, self.top / "of bare"), UNSUPPORTED, "--save-scene always")

    def test_no_output(self):
        self.refused(rnmbake("deliver", self.scene, "--engine", "gltf"), USAGE, "-o DIR")


class Gltf(EngineView):
    """MOZ_lightmap alone, by the lightMap that three.js has of its own."""

    ENGINE = "gltf"

    def test_flat_light_is_that_of_render(self):
        self.assert_same_view("single", flat=True)


class ThreeJs(EngineView):
    def test_directional_light_is_that_of_render(self):
        self.assert_same_view("vrad")

    def test_flat_light_is_that_of_render(self):
        self.assert_same_view("single", flat=True)

    def test_pages_of_other_formats_are_the_same_light(self):
        """As a whole, and each pixel in the mean."""
        self.open("site/threejs.html")
        width, height = 60, 38
        true = self.browser.run(f"seen({width}, {height}, false)")
        blocks = self.browser.run("has('EXT_texture_compression_bptc')")
        for format_, most in (("hdr", .01), ("ktx2-rgba16f", .005), ("ktx2-b10g11r11", .01),
                              *([("ktx2-bc6h", .02)] if blocks else [])):
            with self.subTest(format_):
                link = self.out / format_
                if not link.exists():
                    link.symlink_to(delivered_as(format_))
                self.open(f"site/threejs.html?{format_}/lightmaps.json")
                seen = self.browser.run(f"seen({width}, {height}, false)")
                self.assertAlmostEqual(sum(seen) / sum(true), 1, delta=most)
                off = sum(abs(a - b) for a, b in zip(seen, true)) / sum(true)
                self.assertLess(off, 2 * most)
                self.assertEqual(self.problems(), [])
        if not blocks:
            print("no BC6H in this browser: its pages are read by ktx-parse and OpenImageIO alone", file=sys.stderr)

    def test_the_page_shows_the_scene(self):
        self.assert_page_shows_the_scene()


if __name__ == "__main__":
    unittest.main()
