"""A scene with a lamp of each kind, and what Cycles makes of each: arguments are a .blend and a .json to write.

The .json lists, for each lamp and each of a few tiny quads, the mean of its texels (E/pi) and the standard
error of that mean.
"""
import json
import math
import sys

import bpy
from mathutils import Matrix, Vector

SIDE = 4  # texels along a quad
SIZE = 1e-3
SAMPLES = 1024

# Place and normal. Lamps hang at (0, 0, 2) and shine down.
QUADS = [
    ((0.0, 0.0, 0.0), (0.0, 0.0, 1.0)),
    ((1.2, 0.3, 0.0), (0.0, 0.0, 1.0)),
    ((0.5, -0.8, 1.2), (0.3, -0.2, 1.0)),
    ((-0.4, 0.2, 1.7), (0.0, 0.0, 1.0)),
    ((2.0, 1.0, 1.0), (-0.6, -0.2, 0.8)),
    ((0.3, 0.1, 2.6), (0.0, 0.0, -1.0)),
    ((0.05, 0.02, 1.9), (0.0, 0.1, 1.0)),
    ((-3.0, 4.0, -9.0), (0.2, 0.1, 0.9)),
]


def lamps():
    """Name, type, settings and scale; the name may ask for a turn."""
    yield "point", "POINT", {"shadow_soft_size": 0.0}
    yield "point soft", "POINT", {"shadow_soft_size": 0.25}
    yield "point soft scaled", "POINT", {"shadow_soft_size": 0.25, "scale": (2.0, 1.0, 0.5)}
    yield "point hard", "POINT", {"shadow_soft_size": 0.25, "use_soft_falloff": False}
    spot = {"shadow_soft_size": 0.0, "spot_size": 1.8, "spot_blend": 0.15}
    yield "spot", "SPOT", spot
    yield "spot sharp", "SPOT", {**spot, "spot_blend": 0.0}
    yield "spot smooth", "SPOT", {**spot, "spot_blend": 1.0}
    yield "spot wide", "SPOT", {**spot, "spot_size": 3.1, "spot_blend": 0.6}
    yield "spot soft", "SPOT", {**spot, "shadow_soft_size": 0.2, "spot_blend": 0.5}
    yield "spot soft inside", "SPOT", {**spot, "shadow_soft_size": 0.6, "spot_blend": 0.5}
    # No quad within its bulb: there Cycles' two ways to find it disagree.
    yield "spot hard", "SPOT", {**spot, "shadow_soft_size": 0.1, "spot_blend": 0.5, "use_soft_falloff": False}
    yield "spot scaled", "SPOT", {**spot, "spot_blend": 0.5, "scale": (2.0, 1.0, 1.0)}
    yield "spot scaled z", "SPOT", {**spot, "spot_blend": 0.5, "scale": (1.0, 1.0, 2.0)}
    yield "spot scaled soft", "SPOT", {**spot, "shadow_soft_size": 0.2, "scale": (2.0, 1.5, 0.5), "turn": 0.4}
    yield "sun", "SUN", {"angle": 0.0, "turn": 0.5}
    yield "sun soft", "SUN", {"angle": math.radians(10), "turn": 0.5}
    yield "sun wide", "SUN", {"angle": math.radians(120), "turn": 0.3}
    yield "sun scaled", "SUN", {"angle": math.radians(10), "turn": 0.5, "scale": (3.0, 2.0, 0.5)}
    for shape in ("SQUARE", "RECTANGLE", "DISK", "ELLIPSE"):
        area = {"shape": shape, "size": 1.5, "size_y": 0.7, "turn": 0.3}
        yield f"area {shape}", "AREA", area
        yield f"area {shape} spread 100", "AREA", {**area, "spread": math.radians(100)}
        yield f"area {shape} spread 30", "AREA", {**area, "spread": math.radians(30)}
        yield f"area {shape} scaled", "AREA", {**area, "scale": (2.0, 0.7, 3.0)}
    yield "area mirrored", "AREA", {"shape": "RECTANGLE", "size": 1.5, "size_y": 0.7, "scale": (1.0, 1.0, -1.0)}
    yield "point coloured", "POINT", {"shadow_soft_size": 0.0, "color": (1.0, 0.5, 0.25)}
    yield "point nodes", "POINT", {"shadow_soft_size": 0.0, "emission": ((0.5, 1.0, 0.2), 3.0)}
    for kind in ("POINT", "SPOT", "SUN", "AREA"):  # where this Blender has it
        size = {"shadow_soft_size": 0.3, "angle": 0.3, "size": 0.7, "spot_size": 1.8}
        yield f"{kind} not normalized", kind, {**size, "normalize": False}
        yield f"{kind} not normalized, no size", kind, {"shadow_soft_size": 0.0, "angle": 0.0, "normalize": False}
        yield f"{kind} not normalized, scaled", kind, {**size, "normalize": False, "shape": "DISK",
                                                       "scale": (2.0, 1.5, 3.0)}
        yield f"{kind} exposed", kind, {**size, "exposure": 1.0}
        yield f"{kind} warm", kind, {**size, "use_temperature": True, "temperature": 3500.0}


def add_lamp(name, kind, settings):
    light = bpy.data.lights.new(name, kind)
    light.energy = 3.0 if kind == "SUN" else 40.0
    ob = bpy.data.objects.new(name, light)
    matrix = Matrix.Translation((0, 0, 2))
    for key, value in settings.items():
        if key == "scale":
            matrix = matrix @ Matrix.Diagonal((*value, 1))
        elif key == "turn":
            matrix = matrix @ Matrix.Rotation(value, 4, Vector((0.6, 0.8, 0.3)))
        elif key == "emission":
            light.use_nodes = True
            node = next(node for node in light.node_tree.nodes if node.type == "EMISSION")
            node.inputs["Color"].default_value = (*value[0], 1.0)
            node.inputs["Strength"].default_value = value[1]
        elif hasattr(light, key):
            setattr(light, key, value)
    ob.matrix_world = matrix
    bpy.context.scene.collection.objects.link(ob)
    ob.hide_render = True
    return ob


def add_quads():
    corners, faces, uvs = [], [], []
    for index, (place, normal) in enumerate(QUADS):
        z = Vector(normal).normalized()
        x = z.orthogonal().normalized()
        y = z.cross(x)
        for u, v in ((0, 0), (1, 0), (1, 1), (0, 1)):
            corners.append(Vector(place) + (x * (u - 0.5) + y * (v - 0.5)) * SIZE)
            uvs.append(((index + u) / len(QUADS), v))
        faces.append(range(4 * index, 4 * index + 4))
    mesh = bpy.data.meshes.new("quads")
    mesh.from_pydata(corners, [], faces)
    layer = mesh.uv_layers.new(name="UV")
    for loop, uv in zip(layer.data, uvs):
        loop.uv = uv
    ob = bpy.data.objects.new("quads", mesh)
    bpy.context.scene.collection.objects.link(ob)
    material = bpy.data.materials.new("white")
    material.use_nodes = True
    tree = material.node_tree
    tree.nodes.clear()
    diffuse = tree.nodes.new("ShaderNodeBsdfDiffuse")
    diffuse.inputs["Color"].default_value = (1, 1, 1, 1)
    diffuse.inputs["Roughness"].default_value = 0
    output = tree.nodes.new("ShaderNodeOutputMaterial")
    tree.links.new(diffuse.outputs["BSDF"], output.inputs["Surface"])
    image = bpy.data.images.new("texels", SIDE * len(QUADS), SIDE, float_buffer=True)
    image.colorspace_settings.name = "Non-Color"
    node = tree.nodes.new("ShaderNodeTexImage")
    node.image = image
    tree.nodes.active = node
    mesh.materials.append(material)
    return ob, image


def prepare(scene):
    scene.render.engine = "CYCLES"
    cycles = scene.cycles
    cycles.device = "CPU"
    cycles.samples = SAMPLES
    cycles.use_adaptive_sampling = False
    cycles.use_denoising = False
    cycles.light_sampling_threshold = 0
    cycles.sample_clamp_direct = cycles.sample_clamp_indirect = 0
    cycles.max_bounces = 0
    cycles.use_fast_gi = False
    if bpy.app.version < (3, 5):
        cycles.sampling_pattern = "SOBOL"  # the default's samples repeat from texel to texel
    scene.world = None


def measure(image):
    pixels = list(image.pixels)
    width = SIDE * len(QUADS)
    found = []
    for index in range(len(QUADS)):
        texels = [pixels[4 * (y * width + index * SIDE + x):][:3] for y in range(SIDE) for x in range(SIDE)]
        means = [sum(texel[c] for texel in texels) / len(texels) for c in range(3)]
        grey = [sum(texel) / 3 for texel in texels]
        mean = sum(grey) / len(grey)
        variance = sum((value - mean) ** 2 for value in grey) / (len(grey) - 1)
        found.append({"mean": means, "error": math.sqrt(variance / len(grey))})
    return found


def main(blend, measured):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    prepare(scene)
    quads, image = add_quads()
    lights = [add_lamp(*lamp) for lamp in lamps()]
    bpy.context.view_layer.update()
    for ob in bpy.context.view_layer.objects:
        ob.select_set(ob == quads)
    bpy.context.view_layer.objects.active = quads
    result = []
    for light in lights:
        light.hide_render = False
        bpy.ops.object.bake(type="DIFFUSE", pass_filter={"DIRECT"}, margin=0, use_clear=True)
        light.hide_render = True
        result.append({"name": light.name, "quads": measure(image)})
    for light in lights:
        light.hide_render = False
    bpy.ops.wm.save_as_mainfile(filepath=blend)
    with open(measured, "w", encoding="utf-8") as stream:
        json.dump({"quads": QUADS, "lamps": result}, stream)


main(*sys.argv[sys.argv.index("--") + 1:])
