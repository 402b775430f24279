"""What Unreal would make of a delivery: its script run in a fake of the editor (fake_unreal.py), and the light that its
materials' graphs lead to."""
import json
import math
import re
import runpy
import shutil
import sys

from engine_case import Engine, HERE, baked, delivered, top

sys.path.append(str(HERE.parents[1] / "shaders"))
from compile_check import compile_text  # noqa: E402
from fake_unreal import Editor  # noqa: E402
from page_light import BASES, covered_texels  # noqa: E402
from pictures import read_picture  # noqa: E402

ACTORS = [("floor", ["grey"]), ("box.001", ["red"]), ("Ball", ["Material"]), ("panel", ["blue"]), ("something else", ["grey"])]
FLIP = {True: "float3(1.0, -1.0, 1.0)", False: "float3(1.0, 1.0, 1.0)"}


def run_script(delivery, editor):
    sys.modules["unreal"] = editor.module
    try:
        editor.ran = runpy.run_path(str(delivery / "rnmbake_unreal.py"))
    finally:
        del sys.modules["unreal"]
    return editor


def decode_squared(layers, normal):
    """What the custom node computes, by the definition in docs/encodings.md."""
    weights = [max(sum(a * b for a, b in zip(normal, BASES[layer])), 0) ** 2 for layer in ("rnm0", "rnm1", "rnm2")]
    return [sum(w * light[c] for w, light in zip(weights, layers)) / sum(weights) for c in range(3)]


class Surface:
    """A material instance at a place of its page: `normal` is what its normal map holds there, in Unreal's way."""

    def __init__(self, instance, sample, normal):
        self.instance, self.sample, self.normal = instance, sample, normal

    def light(self):
        leaves = [node for node in self.instance.parent.nodes if getattr(node, "property", "") == "MP_EMISSIVE_COLOR"]
        return self.value(leaves[0])

    def value(self, node, inputs=None):
        kind = type(node).__name__.removeprefix("MaterialExpression")
        values, links = node.values, {name: self.value(source, inputs) for name, source in node.links.items()}
        if kind == "Multiply":
            return [a * b for a, b in zip(links["A"], links["B"])]
        if kind == "Add":
            return [a + b for a, b in zip(links["A"], links["B"])]
        if kind == "ScalarParameter":
            return [values["default_value"]] * 3
        if kind == "VectorParameter":
            return list(self.instance.colours[values["parameter_name"]])
        if kind == "Constant3Vector":
            return list(values["constant"])
        if kind == "TextureCoordinate":
            return values["coordinate_index"]
        if kind == "TextureSampleParameter2D":
            name = values["parameter_name"]
            return self.normal if name == "NormalMap" else self.sample(self.instance.textures[name].file.name, links["UVs"])
        if kind == "MaterialFunctionCall":
            end = next(one for one in values["material_function"].nodes if type(one).__name__.endswith("FunctionOutput"))
            return self.value(end.links[""], links)
        if kind == "FunctionInput":
            return inputs[values["input_name"]]
        assert kind == "Custom", kind
        return self.custom(values["code"], links)

    @staticmethod
    def custom(code, links):
        flip, function, arguments = re.search(
            r"float3 n = normalize\(N\) \* (float3\([^)]*\));\nreturn max\(rnmbake\.(\w+)\(([^)]*), n\), 0\.0\);$", code).groups()
        assert function == "rnm_decode_squared", function
        length = math.sqrt(sum(part * part for part in links["N"][:3]))
        n = [part / length * float(sign) for part, sign in zip(links["N"], re.findall(r"-?\d\.\d", flip))]
        return decode_squared([links[name] for name in arguments.split(", ")], n)


class UnrealCase(Engine):
    def lit(self, *flags, actors=ACTORS):
        out = delivered("unreal", *flags)
        editor = run_script(out, Editor(actors))
        return out, editor, {actor.get_actor_label().lower(): actor.component for actor in editor.actors}

    def shown(self, normals, *flags):
        """(texel, name of the normal, light that the materials show for it, what was baked) of every texel."""
        out, _, components = self.lit(*flags)
        record = json.loads((out / "lightmaps.json").read_text())
        pages = {name: read_picture(out / name)[2] for page in record["pages"] for name in page["layers"].values()}
        materials = [components[one["name"].lower()].materials[0] for one in record["objects"]]
        for material in materials:
            material.colours["BaseColor"] = (1, 1, 1, 1)
        for texel in covered_texels(out, baked()[1]):
            def sample(file, uv):
                self.assertEqual(uv, 1)
                return [pages[file][texel.y][texel.x][c] for c in "RGB"]

            for name, normal in normals.items():
                material = materials[3] if name != "flat" else materials[0]
                surface = Surface(material, sample, [normal[0], -normal[1], normal[2]])
                yield texel, name, surface.light(), texel.baked[name][1]

    def test_materials_show_the_flat_bake_for_flat_normals(self):
        count = 0
        for texel, _, light, bake in self.shown({"flat": (0, 0, 1)}):
            count += 1
            for got, expected in zip(light, bake):
                self.assertLessEqual(abs(got - expected), .002 * max(bake) + 1e-4, (texel.x, texel.y))
        self.assertGreater(count, 3000)

    def test_materials_show_each_bake_for_its_normal(self):
        """Normal maps of Unreal have green down, and the bakes have it up."""
        count = 0
        for texel, name, light, bake in self.shown(BASES, "--encoding", "rnm"):
            count += 1
            for got, expected in zip(light, bake):
                self.assertLessEqual(abs(got - expected), .001 * max(bake) + 1e-4, (name, texel.x, texel.y))
        self.assertGreater(count, 9000)

    def test_materials_are_those_of_the_scene(self):
        _, editor, components = self.lit()
        self.assertEqual(components["something else"].materials, {})
        self.assertEqual(editor.warned, [])
        colours = {"floor": (.6, .6, .6), "box.001": (.8, .4, .3), "ball": (.8, .8, .8), "panel": (.4, .5, .8)}
        for name, colour in colours.items():
            self.assertEqual(list(components[name].materials), [0])
            made = components[name].materials[0]
            for got, expected in zip(made.colours["BaseColor"], colour):
                self.assertAlmostEqual(got, expected, places=5)
            self.assertEqual("NormalMap" in made.textures, name == "panel")
            self.assertEqual(components[name].values["static_mesh"].built,
                             {0: {"generate_lightmap_u_vs": False, "use_full_precision_u_vs": True}})
        self.assertEqual(editor.saved, ["/Game/Lightmaps/unreal"])

    def test_textures_are_told_how_to_be(self):
        out, editor, components = self.lit()
        textures = components["panel"].materials[0].textures
        self.assertEqual({name: texture.file for name, texture in textures.items() if name != "NormalMap"},
                         {f"Rnm{i}": out / f"page0_rnm{i}.exr" for i in range(3)})
        clamp = {"address_x": "TA_CLAMP", "address_y": "TA_CLAMP", "mip_gen_settings": "TMGS_NO_MIPMAPS", "srgb": False}
        self.assertEqual(textures["Rnm0"].values, {**clamp, "compression_settings": "TC_HDR_COMPRESSED"})
        self.assertEqual(textures["NormalMap"].values,
                         {"srgb": False, "flip_green_channel": True, "compression_settings": "TC_NORMALMAP"})
        self.assertEqual(textures["NormalMap"].bytes[:4], b"\x89PNG")
        signed = self.lit("--encoding", "zh3")[2]["floor"].materials[0].textures
        self.assertEqual({texture.values["compression_settings"] for texture in signed.values()}, {"TC_HDR"})
        self.assertEqual(list(signed), ["L0", "L1x", "L1y", "L1z"])

    def custom_code(self, editor):
        function = editor.assets[next(path for path in editor.assets if path.endswith("/MF_Light"))]
        return next(node.values["code"] for node in function.nodes if "code" in node.values)

    def test_the_code_is_hlsl(self):
        if not shutil.which("glslangValidator"):
            self.skipTest("SKIPPED: no glslangValidator")
        for flags, layers in (((), "Rnm0 Rnm1 Rnm2"), (("--encoding", "zh3"), "L0 L1x L1y L1z"),
                              (("--encoding", "flat"), "Flat")):
            inputs = ", ".join("float3 " + name for name in ["N", *layers.split()])
            node = f"float3 CustomExpression0({inputs})\n{{\n{self.custom_code(self.lit(*flags)[1])}\n}}\n"
            self.assertEqual(compile_text(node, "HLSL"), "")

    def test_normals_are_turned_only_for_pages_with_green_up(self):
        out = delivered("unreal")
        self.assertIn(FLIP[True], self.custom_code(run_script(out, Editor(ACTORS))))
        down = top() / "unreal-down"
        shutil.copytree(out, down)
        record = json.loads((down / "lightmaps.json").read_text())
        self.assertEqual(record["green"], "y-up")
        (down / "lightmaps.json").write_text(json.dumps({**record, "green": "y-down"}))
        self.assertIn(FLIP[False], self.custom_code(run_script(down, Editor(ACTORS))))

    def test_a_second_run_makes_nothing_twice(self):
        out, editor, _ = self.lit()
        assets, nodes = dict(editor.assets), {path: len(made.nodes) for path, made in editor.assets.items()}
        run_script(out, editor)
        self.assertEqual(editor.assets, assets)
        self.assertEqual({path: len(made.nodes) for path, made in editor.assets.items()}, nodes)

    def test_objects_that_are_not_in_the_level_are_named(self):
        _, editor, components = self.lit(actors=ACTORS[1:])
        self.assertEqual(len(editor.warned), 1)
        self.assertIn("'floor'", editor.warned[0])
        self.assertEqual(list(components["panel"].materials), [0])

    def test_the_script_is_the_projects(self):
        self.assertEqual((delivered("unreal") / "rnmbake_unreal.py").read_text(),
                         (HERE.parents[2] / "engines" / "unreal" / "rnmbake_unreal.py").read_text())

    def test_names(self):
        """tests/pipeline/deliver/engine_names_test.cpp has the same of the program."""
        name = self.lit()[1].ran["unreal_name"]
        self.assertEqual(name("Wall-1+\u00e9"), "Wall-1+\u00e9")
        self.assertEqual(name("\"' ,/.:|&!~\n\r\t@#(){}[]=;^%$`\\*?<>"), "_" * 33)

    def test_names_that_become_one(self):
        self.refused("unreal", "'box.a'", "'box_a'")
