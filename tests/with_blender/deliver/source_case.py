"""What Source would make of a delivery: its textures and materials by the formats that Valve's wiki documents."""
import json
import math
import re
import struct

from engine_case import Engine, HERE, baked, delivered
from page_light import BASES, covered_texels
from unreal_case import compile_text, decode_squared

HEADER = "<4s3I2H I 2H 4x 3f 4x f I B I 2B H"  # of version 7.2: "VTF (Valve Texture Format)"
RGBA16161616F, NO_FORMAT = 24, 0xFFFFFFFF
CLAMPED_ONE_LEVEL = 0x4 | 0x8 | 0x100 | 0x200


def read_vtf(path):
    """Width, height, and rows of (R, G, B, A)."""
    data = path.read_bytes()
    (signature, major, minor, size, width, height, flags, frames, first, *mean, bump, kind, levels, thumbnail, thumbnail_width,
     thumbnail_height, depth) = struct.unpack_from(HEADER, data)
    assert (signature, major, minor, size) == (b"VTF\0", 7, 2, 80), path
    assert (flags, frames, first, bump, kind, levels, depth) == (CLAMPED_ONE_LEVEL, 1, 0, 1, RGBA16161616F, 1, 1), path
    assert (thumbnail, thumbnail_width, thumbnail_height) == (NO_FORMAT, 0, 0), path
    assert len(data) == size + 8 * width * height and all(part >= 0 for part in mean), path
    texels = list(struct.iter_unpack("<4e", data[size:]))
    return width, height, [texels[row * width:(row + 1) * width] for row in range(height)]


def read_vmt(path):
    """Shader and parameters of a material."""
    words = re.findall(r'"([^"]*)"|([{}])', path.read_text())
    assert [brace for _, brace in words if brace] == ["{", "}"] and words[-1][1] == "}", path
    names = [word for word, brace in words if not brace]
    return names[0], dict(zip(names[1::2], names[2::2]))


def as_direct3d_11(shader):
    """glslang knows no samplers of Direct3D 9."""
    head = "SamplerState state;\n#define tex2D(name, uv) name.Sample(state, uv)\n"
    text = re.sub(r"sampler (\w+) : register\(s\d\);", r"Texture2D \1;", shader)
    text = re.sub(r" : register\(c\d+\)", "", text).replace(": COLOR", ": SV_Target").replace("float4 main(", "float4 light(")
    return head + text.replace(") : SV_Target", ")").replace("float2 uv : TEXCOORD0", "float2 uv").replace("const float4", "float4")


class SourceCase(Engine):
    def read(self, *flags):
        out = delivered("source", *flags)
        record = json.loads((out / "lightmaps.json").read_text())
        return out, record, [{layer: read_vtf(out / file) for layer, file in page["layers"].items()} for page in record["pages"]]

    def test_pages_are_vrads(self):
        """The flat page is the flat bake and the mean of the three, which are the bakes times one factor for each colour."""
        out, record, pages = self.read()
        self.assertEqual(list(pages[0]), ["flat", "rnm0", "rnm1", "rnm2"])
        texels = covered_texels(out, baked()[1])
        self.assertGreater(len(texels), 3000)
        for texel in texels:
            page = {layer: rows[texel.y][texel.x] for layer, (_, _, rows) in pages[texel.page].items()}
            bakes = {name: light for name, (_, light) in texel.baked.items()}
            near = .002 * max(max(light) for light in page.values()) + 1e-4
            straight = decode_squared([page[layer] for layer in BASES], (0, 0, 1))
            for c in range(3):
                self.assertLessEqual(abs(page["flat"][c] - bakes["flat"][c]), near)
                self.assertLessEqual(abs(straight[c] - bakes["flat"][c]), near)
                total = sum(bakes[layer][c] for layer in BASES)
                for layer in BASES:
                    scaled = 3 * bakes["flat"][c] * bakes[layer][c] / total if total else 0
                    self.assertLessEqual(abs(page[layer][c] - scaled), near)
            self.assertEqual({light[3] for light in page.values()}, {1})

    def test_sides_are_powers_of_two(self):
        _, record, pages = self.read()
        for said, layers in zip(record["pages"], pages):
            for width, height, _ in layers.values():
                self.assertEqual((width, height), (said["width"], said["height"]))
                self.assertTrue(all(2 ** round(math.log2(side)) == side for side in (width, height)))

    def test_materials_name_what_is_there(self):
        out, _, _ = self.read()
        shader, parameters = read_vmt(out / "page0.vmt")
        self.assertEqual((shader, parameters["$pixshader"]), ("screenspace_general", "rnmbake_light_ps20"))
        textures = [parameters[slot] for slot in ("$basetexture", "$texture1", "$texture2", "$texture3")]
        self.assertEqual(textures, ["source/" + name for name in ("page0_rnm0", "page0_rnm1", "page0_rnm2", "straight_up")])
        for slot in ("basetexture", "texture1", "texture2", "texture3"):
            self.assertEqual(parameters["$linearread_" + slot], "1")
        for texture in textures:
            self.assertTrue((out / (texture.removeprefix("source/") + ".vtf")).is_file())
        self.assertEqual(read_vmt(out / "page0_flat.vmt"), ("UnlitGeneric", {"$basetexture": "source/page0_flat"}))
        _, _, up = read_vtf(out / "straight_up.vtf")
        self.assertEqual({texel for row in up for texel in row}, {(.5, .5, 1, 1)})

    def test_flat_light_is_one_texture(self):
        out, _, pages = self.read("--encoding", "flat")
        self.assertEqual([list(page) for page in pages], [["flat"]])
        self.assertEqual(sorted(path.name for path in out.iterdir() if not path.name.startswith(".")),
                         ["lightmaps.json", "page0_flat.vmt", "page0_flat.vtf", "scene.glb"])

    def test_the_shader(self):
        """Its samplers are in the order of the material's slots; it is HLSL, and turns normals for pages with green up."""
        out, record, _ = self.read()
        text = (out / "rnmbake_light_ps2x.hlsl").read_text()
        self.assertTrue(text.endswith((HERE.parents[2] / "engines" / "source" / "rnmbake_light_ps2x.hlsl").read_text()))
        self.assertEqual(re.findall(r"sampler (\w+) : register\(s(\d)\)", text),
                         [("Rnm0", "0"), ("Rnm1", "1"), ("Rnm2", "2"), ("NormalMap", "3")])
        self.assertEqual(record["green"], "y-up")
        self.assertIn("page_green = -1.0;", text)
        self.assertEqual(compile_text(as_direct3d_11(text), "HLSL"), "")

    def test_an_encoding_without_a_decoder(self):
        self.refused("source", "'sh2'", "rnm-vrad, flat", flags=("--encoding", "sh2"))
