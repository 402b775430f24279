"""blender -b --factory-startup --python export_cases.py -- FOLDER: scenes for tests/with_blender/export_test.cpp.

picture.blend and sky.blend: a white cube under a world; picture.json and sky.json: what Cycles bakes on its faces.
things.blend: one thing of every kind that an export has to carry, or has to say that it does not.
"""
import json
import math
import os
import statistics
import sys

import bpy

AXES = [(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)]
WORLD_CELLS = (8, 4)
FACE = 4  # texels


def world_color(column, row):
    """Of one cell of the world's picture; row 0 is the lowest."""
    return [((7 * column + 3 * row) % 5) / 2, ((3 * column + 5 * row) % 7) / 3, 0.25 + column * row / 8]


def new_image(name, width, height):
    image = bpy.data.images.new(name, width, height, float_buffer=True)
    image.colorspace_settings.name = "Non-Color"
    return image


def new_tree(block):
    if not block.use_nodes:
        block.use_nodes = True
    block.node_tree.nodes.clear()
    return block.node_tree


def picture_world():
    """Bounces see a picture, cameras see magenta."""
    image = new_image("world", *WORLD_CELLS)
    image.pixels = [value for row in range(WORLD_CELLS[1]) for column in range(WORLD_CELLS[0])
                    for value in (*world_color(column, row), 1)]
    image.pack()
    tree = new_world()
    texture = tree.nodes.new("ShaderNodeTexEnvironment")
    texture.image, texture.interpolation = image, "Closest"
    shown, other, mix = (tree.nodes.new("ShaderNode" + kind) for kind in ("Background", "Background", "MixShader"))
    shown.inputs["Strength"].default_value = 2
    other.inputs["Color"].default_value = (1, 0, 1, 1)
    tree.links.new(texture.outputs["Color"], shown.inputs["Color"])
    tree.links.new(tree.nodes.new("ShaderNodeLightPath").outputs["Is Camera Ray"], mix.inputs[0])
    tree.links.new(shown.outputs[0], mix.inputs[1])
    tree.links.new(other.outputs[0], mix.inputs[2])
    tree.links.new(mix.outputs[0], tree.nodes.new("ShaderNodeOutputWorld").inputs["Surface"])


def sky_world():
    tree = new_world()
    sky = tree.nodes.new("ShaderNodeTexSky")  # whatever this Blender takes for a sky, sun disc and all
    sky.sun_rotation, sky.sun_elevation = 0.7, 0.6
    background = tree.nodes.new("ShaderNodeBackground")
    background.inputs["Strength"].default_value = 0.1
    tree.links.new(sky.outputs["Color"], background.inputs["Color"])
    tree.links.new(background.outputs[0], tree.nodes.new("ShaderNodeOutputWorld").inputs["Surface"])


def new_world():
    bpy.context.scene.world = bpy.data.worlds.new("world")
    return new_tree(bpy.context.scene.world)


def white_cube():
    """One face for each of AXES, side by side in UV space."""
    corners, uv = [], []
    for number, normal in enumerate(AXES):
        across = tuple(normal[(axis + 1) % 3] for axis in range(3))
        along = [normal[1] * across[2] - normal[2] * across[1], normal[2] * across[0] - normal[0] * across[2],
                 normal[0] * across[1] - normal[1] * across[0]]
        for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
            corners.append([n + x * a + y * b for n, a, b in zip(normal, across, along)])
            uv += [(number + (x + 1) / 2) / 6, (y + 1) / 2]
    mesh = bpy.data.meshes.new("cube")
    mesh.from_pydata(corners, [], [range(4 * face, 4 * face + 4) for face in range(6)])
    mesh.uv_layers.new(name="UVMap").data.foreach_set("uv", uv)
    mesh.materials.append(bpy.data.materials.new("white"))
    tree = new_tree(mesh.materials[0])
    diffuse = tree.nodes.new("ShaderNodeBsdfDiffuse")
    diffuse.inputs["Color"].default_value = (1, 1, 1, 1)
    tree.links.new(diffuse.outputs[0], tree.nodes.new("ShaderNodeOutputMaterial").inputs["Surface"])
    ob = bpy.data.objects.new("cube", mesh)
    bpy.context.scene.collection.objects.link(ob)
    return ob


def bake_faces(ob):
    """E/pi of every face, as Cycles sees it, and its standard error: texels of a face differ by noise alone."""
    scene, image = bpy.context.scene, new_image("bake", 6 * FACE, FACE)
    scene.render.engine = "CYCLES"
    scene.cycles.samples, scene.cycles.use_denoising, scene.cycles.use_adaptive_sampling = 1024, False, False
    scene.cycles.sample_clamp_indirect = 0
    if bpy.app.version < (3, 5):
        scene.cycles.sampling_pattern = "SOBOL"
    nodes = ob.data.materials[0].node_tree.nodes
    texture = nodes.new("ShaderNodeTexImage")
    texture.image = image
    nodes.active = texture
    ob.select_set(True)
    bpy.context.view_layer.objects.active = ob
    bpy.ops.object.bake(type="DIFFUSE", pass_filter={"DIRECT", "INDIRECT"}, margin=0)
    pixels = list(image.pixels)
    nodes.remove(texture)
    faces = []
    for number, normal in enumerate(AXES):
        texels = [4 * (row * 6 * FACE + number * FACE + column) for row in range(FACE) for column in range(FACE)]
        values = [[pixels[texel + channel] for texel in texels] for channel in range(3)]
        faces.append({"normal": normal, "radiance": [statistics.fmean(channel) for channel in values],
                      "error": [statistics.stdev(channel) / math.sqrt(len(texels)) for channel in values]})
    return faces


def world_case(folder, name, make_world):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    make_world()
    faces = bake_faces(white_cube())
    bpy.ops.wm.save_as_mainfile(filepath=os.path.join(folder, name + ".blend"))
    with open(os.path.join(folder, name + ".json"), "w", encoding="utf-8") as stream:
        json.dump(faces, stream)


def quad(name, number):
    """One square in a row of them, with two UV layers."""
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata([(2 * number + x, y, 0) for x, y in ((0, 0), (1, 0), (1, 1), (0, 1))], [], [(0, 1, 2, 3)])
    for layer in ("first", "second"):
        mesh.uv_layers.new(name=layer).data.foreach_set("uv", (0, 0, 1, 0, 1, 1, 0, 1))
    mesh.materials.append(bpy.data.materials.new(name))
    ob = bpy.data.objects.new(name, mesh)
    bpy.context.scene.collection.objects.link(ob)
    return ob, new_tree(mesh.materials[0])


def surface(tree, kind, **inputs):
    node = tree.nodes.new("ShaderNode" + kind)
    for name, value in inputs.items():
        node.inputs[name].default_value = value
    tree.links.new(node.outputs[0], tree.nodes.new("ShaderNodeOutputMaterial").inputs["Surface"])
    return node


def normal_map(tree, shader, image, layer, strength):
    """Through the UV layer of that name, or the one that textures use by themselves."""
    node, texture = tree.nodes.new("ShaderNodeNormalMap"), tree.nodes.new("ShaderNodeTexImage")
    node.inputs["Strength"].default_value, texture.image = strength, image
    if layer:
        place = tree.nodes.new("ShaderNodeUVMap")
        place.uv_map = layer
        tree.links.new(place.outputs["UV"], texture.inputs["Vector"])
    tree.links.new(texture.outputs["Color"], node.inputs["Color"])
    tree.links.new(node.outputs["Normal"], shader.inputs["Normal"])


def things(folder):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    image = bpy.data.images.new("normals", 4, 2)
    image.colorspace_settings.name = "Non-Color"
    image.pixels = [value for texel in range(8) for value in (texel / 7, 0.2, 0.8, 1)]
    image.pack()
    _, tree = quad("mapped", 0)
    normal_map(tree, surface(tree, "BsdfDiffuse", Color=(0.5, 0.25, 0.125, 1)), image, "second", 0.5)
    _, tree = quad("mapped_default", 1)
    normal_map(tree, surface(tree, "BsdfDiffuse"), image, "", 1)
    _, tree = quad("bumped", 2)
    shader = surface(tree, "BsdfDiffuse")
    tree.links.new(tree.nodes.new("ShaderNodeBump").outputs["Normal"], shader.inputs["Normal"])
    _, tree = quad("glass", 3)
    surface(tree, "BsdfGlass")
    _, tree = quad("glowing", 4)
    surface(tree, "Emission", Color=(0.5, 1, 0.25, 1), Strength=4)
    ghost, tree = quad("ghost", 5)
    surface(tree, "BsdfDiffuse")
    ghost.visible_diffuse = ghost.visible_shadow = False
    shadowless, tree = quad("shadowless", 6)
    surface(tree, "BsdfDiffuse")
    shadowless.visible_shadow = False
    for name in ("lamp", "hidden"):
        lamp = bpy.data.objects.new(name, bpy.data.lights.new(name, "POINT"))
        bpy.context.scene.collection.objects.link(lamp)
        lamp.visible_diffuse = name == "lamp"
    camera = bpy.data.objects.new("view", bpy.data.cameras.new("view"))
    camera.data.type, camera.data.ortho_scale, camera.data.shift_x, camera.data.shift_y = "ORTHO", 6, 0.25, -0.5
    camera.location = (1, 2, 3)
    scene = bpy.context.scene
    scene.collection.objects.link(camera)
    scene.camera = camera
    scene.render.resolution_x, scene.render.resolution_y, scene.render.resolution_percentage = 400, 200, 50
    bpy.ops.wm.save_as_mainfile(filepath=os.path.join(folder, "things.blend"))


target = sys.argv[sys.argv.index("--") + 1]
world_case(target, "picture", picture_world)
world_case(target, "sky", sky_world)
things(target)
