"""python3 gltf_cases.py FOLDER: glTF files whose lightmaps have closed forms, in cells that lie far apart.

sunlit.glb: small floors below one sun; a floor's name says what lies in between. lit.glb: a lamp of its own above each
floor, or a glowing box around it. glossy.glb: a material that is not plain diffuse. gltf_test.cpp knows the values.
"""
import math
import os
import sys

from gltf_writer import BYTE, SHORT, UNSIGNED_BYTE, Writer

APART = 200.0
CLEAR, SOLID = 77, 204  # 8-bit alpha of 0.3 and 0.8
DOWN = [-math.sqrt(0.5), 0, 0, math.sqrt(0.5)]  # lamps shine along -Z; so do they along -Y
HALF = 0.01  # of a floor


class Cells:
    def __init__(self):
        self.w = Writer()
        self.count = 0

    def cell(self, name, *inside, lamp=None, height=1, **place):
        """A floor of its own and what `inside` adds; `lamp` hangs above."""
        w = self.w
        children = [w.node(root=False, name=name, mesh=w.quad(name, HALF), **place)]
        children += [made for part in inside for made in (part() or [])]
        if lamp:
            children.append(w.node(root=False, name=f"lamp of {name}", translation=[0, height, 0], rotation=DOWN,
                                   extensions=w.lamp(**lamp)))
        w.node(name=f"cell of {name}", translation=[APART * self.count, 0, 0], children=children)
        self.count += 1

    def panel(self, material, half=0.2, **attributes):
        """Above the floor."""
        return lambda: [self.w.node(root=False, name="panel", translation=[0, 0.5, 0],
                                    mesh=self.w.quad("panel", half, self.material(**material), **attributes))]

    def material(self, **entry):
        for name in entry.get("extensions", {}):
            self.w.extension(name)
        return self.w.add("materials", **entry)

    def glowing_box(self, material, **attributes):
        return lambda: [self.w.node(root=False, name="box",
                                    mesh=self.w.box("box", 0.5, self.material(**material), **attributes))]


def tinted(alpha):
    return {"baseColorFactor": [0.5, 0.5, 0.5, alpha]}


def lamps(cells):
    bulb = {"type": "point", "intensity": 100.0}
    cells.cell("point", lamp={**bulb, "name": "bulb"}, height=0.2)
    cells.cell("no intensity", lamp={"type": "point"}, height=0.2)
    cells.cell("coloured", lamp={**bulb, "color": [1.0, 0.5, 0.25], "range": 3.0, "name": "short"})
    cone = {"innerConeAngle": 0.3, "outerConeAngle": 0.5}
    for name, angle in (("in the cone", 0.25), ("on its edge", 0.36), ("beside the cone", 0.55)):
        cells.cell(name, lamp={**bulb, "type": "spot", "spot": dict(cone)}, translation=[math.tan(angle), 0, 0])
    cells.cell("inner cone alone", lamp={**bulb, "type": "spot", "spot": {"innerConeAngle": 0.7}})
    cells.cell("no such lamp", lamp={"type": "ambient", "name": "ambient"})


def sun(cells):
    cells.w.node(name="noon", rotation=DOWN, extensions=cells.w.lamp(type="directional", intensity=1000.0))
    cells.cell("sun")


def alphas(cells):
    cells.cell("mask below", cells.panel({"alphaMode": "MASK", "pbrMetallicRoughness": tinted(0.3)}))
    cells.cell("mask above", cells.panel({"alphaMode": "MASK", "pbrMetallicRoughness": tinted(0.8)}))
    cells.cell("mask at its cutoff", cells.panel({"alphaMode": "MASK", "alphaCutoff": 0.25,
                                                  "pbrMetallicRoughness": tinted(0.25)}))
    for name, alpha in (("mask picture below", CLEAR), ("mask picture above", SOLID)):
        picture = cells.w.picture([(255, 255, 255, alpha)], 1)
        cells.cell(name, cells.panel({"alphaMode": "MASK",
                                      "pbrMetallicRoughness": {"baseColorTexture": {"index": picture}}}))
    for name, alpha in (("mask corners below", 0.3), ("mask corners above", 0.8)):
        cells.cell(name, cells.panel({"alphaMode": "MASK", "pbrMetallicRoughness": {}}, COLOR_0=4 * [(1, 1, 1, alpha)]))
    picture = cells.w.picture([(255, 255, 255, SOLID)], 1)
    cells.cell("mask with a factor", cells.panel(  # 0.8 times 0.5 is below the cutoff
        {"alphaMode": "MASK", "pbrMetallicRoughness": {"baseColorTexture": {"index": picture},
                                                       "baseColorFactor": [1, 1, 1, 0.5]}}))
    cells.cell("blend", cells.panel({"alphaMode": "BLEND", "pbrMetallicRoughness": tinted(0.25)}))
    clear = cells.w.picture([(255, 255, 255, 0)], 1)
    cells.cell("opaque", cells.panel({"pbrMetallicRoughness": {"baseColorTexture": {"index": clear}}},
                                     COLOR_0=4 * [(1, 1, 1, 0)]))
    cells.cell("single-sided", cells.panel({"doubleSided": False, "pbrMetallicRoughness": tinted(1)}))
    glass = {"KHR_materials_transmission": {"transmissionFactor": 0.5}}
    cells.cell("glass", cells.panel({"extensions": glass,
                                     "pbrMetallicRoughness": {"baseColorFactor": [1, 0.5, 0.25, 1]}}))
    cells.cell("unlit", cells.panel({"extensions": {"KHR_materials_unlit": {}}, "name": "unlit"}))


def glows(cells):
    w = cells.w
    strong = {"KHR_materials_emissive_strength": {"emissiveStrength": 4.0}}
    black = {"baseColorFactor": [0, 0, 0, 1]}
    cells.cell("glow", cells.glowing_box({"emissiveFactor": [1, 0.5, 0.25], "pbrMetallicRoughness": black}))
    cells.cell("strong glow", cells.glowing_box({"emissiveFactor": [1, 0.5, 0.25], "extensions": strong,
                                                 "pbrMetallicRoughness": black}))
    red = w.picture([(255, 0, 0, 255), (255, 255, 255, 0)], 2)  # the right half is clear, and white all the same
    transform = {"KHR_texture_transform": {"offset": [0.5, 0], "scale": [0.5, 1]}}
    for name, extensions, more in (("glowing picture", {}, {}), ("placed picture", transform, {}),
                                   ("second UVs", {"KHR_texture_transform": {"texCoord": 1}},
                                    {"TEXCOORD_1": 24 * [(0.75, 0.5)]})):
        w.extension("KHR_texture_transform")
        info = {"index": red, "extensions": extensions} if extensions else {"index": red}
        material = {"emissiveFactor": [1, 0.5, 0.25], "emissiveTexture": info, "extensions": strong,
                    "pbrMetallicRoughness": black}
        if not more:
            more = {"TEXCOORD_0": 24 * [(0.25, 0.5)]}
        cells.cell(name, cells.glowing_box(material, **more))


def instances(cells):
    """Long strips along X: as they are, turned by 90 degrees, three times as long."""
    w = cells.w
    w.extension("EXT_mesh_gpu_instancing", required=True)
    quarter = 23170  # sqrt(0.5) as a normalized 16-bit integer
    places = {"TRANSLATION": w.accessor([(0, 0.5, 0), (2, 0.5, 0), (4, 0.5, 0)]),
              "ROTATION": w.accessor([(0, 0, 0, 32767), (0, quarter, 0, quarter), (0, 0, 0, 32767)], SHORT,
                                     normalized=True),
              "SCALE": w.accessor([(1, 1, 1), (1, 1, 1), (3, 1, 1)]),
              "_ID": w.accessor([(0,), (1,), (2,)])}
    strip = w.mesh("strip", [(-0.3, 0, 0.03), (0.3, 0, 0.03), (0.3, 0, -0.03), (-0.3, 0, -0.03)], (0, 1, 2, 0, 2, 3),
                   cells.material(pbrMetallicRoughness=tinted(1)), TEXCOORD_0=[(0, 1), (1, 1), (1, 0), (0, 0)])
    floors = {"under 0": (0.25, 0), "beside 0": (0, 0.25), "under 1": (2, 0.25), "beside 1": (2.25, 0),
              "under 2": (4.8, 0), "beside 2": (5, 0)}
    cells.cell("no strip", lambda: [
        w.node(root=False, name="strip", translation=[10, 0, 0], mesh=strip,
               extensions={"EXT_mesh_gpu_instancing": {"attributes": places}}),
        *(w.node(root=False, name=name, translation=[10 + x, 0, z], mesh=w.quad(name, HALF))
          for name, (x, z) in floors.items())])


def nodes(cells):
    w = cells.w
    blocker = cells.material(name="blocker", pbrMetallicRoughness=tinted(1))
    w.extension("KHR_node_visibility")
    cells.cell("under a hidden node", lambda: [w.node(
        root=False, name="hidden", extensions={"KHR_node_visibility": {"visible": False}},
        children=[w.node(root=False, name="hidden panel", translation=[0, 0.5, 0],
                         mesh=w.quad("panel", 0.2, blocker))])])
    elsewhere = w.node(root=False, name="of another scene", translation=[APART * cells.count, 0.5, 0],
                       mesh=w.quad("panel", 0.2, blocker))
    w.add("scenes", name="other", nodes=[elsewhere])
    cells.cell("of this scene")
    moved = []

    def moving():
        moved.append(w.node(root=False, name="moving panel", translation=[5, 0.5, 0],
                            mesh=w.quad("panel", 0.2, blocker)))
        return moved
    cells.cell("at rest", moving)
    times, places = w.accessor([(0.0,), (1.0,)], min=[0.0], max=[1.0]), w.accessor([(0, 0.5, 0), (0, 0.5, 0)])
    w.add("animations", samplers=[{"input": times, "output": places}],
          channels=[{"sampler": 0, "target": {"node": moved[0], "path": "translation"}}])
    whole = w.accessor([(-100, 0, 100), (100, 0, 100), (100, 0, -100), (-100, 0, -100)], BYTE)
    square = w.accessor([(0, 255), (255, 255), (255, 0), (0, 0)], UNSIGNED_BYTE, normalized=True)
    w.extension("KHR_mesh_quantization", required=True)
    mesh = w.mesh("quantized", [(0, 0, 0)] * 4, (0, 1, 2, 0, 2, 3), TEXCOORD_0=square)
    w.json["meshes"][mesh]["primitives"][0]["attributes"]["POSITION"] = whole
    cells.cell("under quantized", lambda: [w.node(root=False, name="quantized", translation=[0, 0.5, 0],
                                                  scale=[1e-3, 1e-3, 1e-3], mesh=mesh)])


def write(folder, name, parts, *unknown):
    cells = Cells()
    for part in parts:
        part(cells)
    for extension in unknown:
        cells.w.extension(extension)
    cells.w.write(os.path.join(folder, name))


def glossy(cells):
    """What a lambert material only stands in for."""
    material = cells.material(name="glossy", pbrMetallicRoughness={"metallicFactor": 0.5, "roughnessFactor": 0.2})
    cells.w.node(name="tray", mesh=cells.w.quad("tray", 0.5, material))
    cells.cell("glossy", lamp={"type": "point", "intensity": 100.0, "range": 3.0, "name": "short"}, height=0.5,
               translation=[0, 0.1, 0])


SUNLIT, LIT = (sun, alphas, instances, nodes), (lamps, glows)

if __name__ == "__main__":
    write(sys.argv[1], "sunlit.glb", SUNLIT, "KHR_nobody_knows")
    write(sys.argv[1], "lit.glb", LIT)
    write(sys.argv[1], "glossy.glb", [glossy])
