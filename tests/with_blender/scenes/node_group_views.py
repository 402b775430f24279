"""Renders groups of nodes as a picture has them: a square that glows with what the group returns, seen from above, a pixel for a texel.

    blender -b --python node_group_views.py -- NODES.blend VIEWS.json

VIEWS: [{"group", "pictures": {input: file}, "flip_green": 0 or 1, "size": texels a side, "render": file}].
"""
import json
import sys

import bpy


def main(library, views):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    with bpy.data.libraries.load(library) as (there, wanted):
        wanted.node_groups = list(there.node_groups)
    with open(views, encoding="utf-8") as stream:
        views = json.load(stream)
    scene = bpy.context.scene
    square = place_square(scene)
    settle(scene)
    for view in views:
        square.data.materials.clear()
        square.data.materials.append(glowing(view))
        scene.render.resolution_x = scene.render.resolution_y = view["size"]
        scene.render.filepath = view["render"]
        bpy.ops.render.render(write_still=True)


def place_square(scene):
    mesh = bpy.data.meshes.new("square")
    corners = [(0, 0), (1, 0), (1, 1), (0, 1)]
    mesh.from_pydata([(x, y, 0) for x, y in corners], [], [(0, 1, 2, 3)])
    uvs = mesh.uv_layers.new(name="UVMap")
    for loop, uv in zip(uvs.data, corners):
        loop.uv = uv
    square = bpy.data.objects.new("square", mesh)
    scene.collection.objects.link(square)
    camera = bpy.data.cameras.new("above")
    camera.type, camera.ortho_scale = "ORTHO", 1
    above = bpy.data.objects.new("above", camera)
    above.location = (0.5, 0.5, 1)
    scene.collection.objects.link(above)
    scene.camera = above
    return square


def settle(scene):
    """One sample anywhere in the pixel's own square, which closest interpolation makes the texel; linear values."""
    scene.render.engine = "CYCLES"
    cycles = scene.cycles
    cycles.device, cycles.samples, cycles.use_adaptive_sampling, cycles.use_denoising = "CPU", 1, False, False
    cycles.pixel_filter_type, cycles.sample_clamp_direct = "BOX", 0
    render = scene.render
    render.resolution_percentage = 100
    render.use_file_extension = False
    if hasattr(render.image_settings, "media_type"):
        render.image_settings.media_type = "IMAGE"
    render.image_settings.file_format, render.image_settings.color_mode = "OPEN_EXR", "RGB"
    render.image_settings.color_depth = "32"
    scene.view_settings.view_transform = "Standard"


def glowing(view):
    material = bpy.data.materials.new(view["group"])
    if not material.use_nodes:
        material.use_nodes = True
    tree = material.node_tree
    tree.nodes.clear()
    group = tree.nodes.new("ShaderNodeGroup")
    group.node_tree = bpy.data.node_groups[view["group"]]
    group.inputs["Flip Green"].default_value = view["flip_green"]
    for name, file in view["pictures"].items():
        texture = tree.nodes.new("ShaderNodeTexImage")
        texture.interpolation = "Closest"
        texture.image = bpy.data.images.load(file, check_existing=True)
        texture.image.colorspace_settings.name = "Non-Color"
        tree.links.new(texture.outputs["Color"], group.inputs[name])
    emission, output = tree.nodes.new("ShaderNodeEmission"), tree.nodes.new("ShaderNodeOutputMaterial")
    tree.links.new(group.outputs["E/pi"], emission.inputs["Color"])
    tree.links.new(emission.outputs["Emission"], output.inputs["Surface"])
    return material


main(*sys.argv[sys.argv.index("--") + 1:])
