"""blender -b --factory-startup --python lambert_check.py -- ORIGINAL LAMBERT: each object's constant albedo and
emission are what a bake of that object alone, with its own material, gives; and see-through ones let through what
their nodes say."""
import sys

import bpy

TRANSMITTANCE = {"half_transparent": (0.5, 0.5, 0.5), "alpha": (0.75, 0.75, 0.75), "tinted": (0.75, 0.375, 0),
                 "too_much": (0.2, 0.5, 0.5)}


def bake(ob, kind, options):
    for other in bpy.context.view_layer.objects:
        other.select_set(other == ob)
        other.hide_render = other != ob
    bpy.context.view_layer.objects.active = ob
    image = bpy.data.images.new("bake", 8, 8, alpha=True, float_buffer=True)
    image.colorspace_settings.name = "Non-Color"
    nodes = ob.material_slots[0].material.node_tree.nodes
    texture = nodes.new("ShaderNodeTexImage")
    texture.image = image
    nodes.active = texture
    assert bpy.ops.object.bake(type=kind, margin=0, **options) == {"FINISHED"}
    return tuple(image.pixels[4 * 36:4 * 36 + 3])


def measured(path):
    bpy.ops.wm.open_mainfile(filepath=path)
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.cycles.samples, scene.cycles.use_denoising, scene.cycles.transparent_max_bounces = 4, False, 0
    return {ob.name: (bake(ob, "DIFFUSE", {"pass_filter": {"COLOR"}}), bake(ob, "EMIT", {}))
            for ob in bpy.data.objects if ob.type == "MESH"}


def stated(path):
    bpy.ops.wm.open_mainfile(filepath=path)
    found = {}
    for ob in bpy.context.scene.objects:
        if ob.type != "MESH":
            continue
        nodes = ob.material_slots[0].material.node_tree.nodes
        diffuse = next(node for node in nodes if node.type == "BSDF_DIFFUSE")
        assert diffuse.inputs["Roughness"].default_value == 0
        glow = [node.inputs["Color"].default_value[:3] for node in nodes if node.type == "EMISSION"]
        through = [tuple(node.inputs["Color"].default_value[:3]) for node in nodes if node.type == "BSDF_TRANSPARENT"]
        found[ob.name] = (tuple(diffuse.inputs["Color"].default_value[:3]), tuple(glow[0]) if glow else (0, 0, 0),
                          through[0] if through else (0, 0, 0))
    return found


original, lambert = sys.argv[sys.argv.index("--") + 1:]
expected, got = measured(original), stated(lambert)
assert expected.keys() == got.keys(), (expected.keys(), got.keys())
for name, colors in expected.items():
    colors += (TRANSMITTANCE.get(name, (0, 0, 0)),)
    for one, other in zip(colors, got[name]):
        assert all(abs(a - b) <= 1e-5 * max(1, a) for a, b in zip(one, other)), (name, colors, got[name])
assert expected["metallic"][0] != expected["principled"][0] != expected["transmission"][0]
