"""Blender runs this: cubes whose materials say in nodes what glTF has words for. Two glow, one on the outside alone, by nodes with a
single value there, and one by a pattern; four are seen through, by a
picture's alpha, by its colour, by a number, and by a Principled BSDF's alpha.

    blender -b --factory-startup --python nodes_scene.py -- FILE
"""
import sys

import bpy


def new_material(name, shader):
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    tree = material.node_tree
    tree.nodes.clear()
    output, node = tree.nodes.new("ShaderNodeOutputMaterial"), tree.nodes.new(shader)
    tree.links.new(node.outputs[0], output.inputs["Surface"])
    return tree, node


def outside_alone():
    tree, emission = new_material("outside", "ShaderNodeEmission")
    geometry, strength = tree.nodes.new("ShaderNodeNewGeometry"), tree.nodes.new("ShaderNodeMath")
    front = tree.nodes.new("ShaderNodeMath")
    front.operation, front.inputs[0].default_value = "SUBTRACT", 1
    strength.operation, strength.inputs[1].default_value = "MULTIPLY", 7
    tree.links.new(geometry.outputs["Backfacing"], front.inputs[1])
    tree.links.new(front.outputs[0], strength.inputs[0])
    tree.links.new(strength.outputs[0], emission.inputs["Strength"])
    color = tree.nodes.new("ShaderNodeRGB")
    color.outputs[0].default_value = (1, .5, .25, 1)
    tree.links.new(color.outputs[0], emission.inputs["Color"])
    return "outside"


def pattern():
    tree, emission = new_material("pattern", "ShaderNodeEmission")
    noise = tree.nodes.new("ShaderNodeTexNoise")
    tree.links.new(noise.outputs["Fac"], emission.inputs["Strength"])
    return "pattern"


def mixture(name, *shaders):
    tree, mix = new_material(name, "ShaderNodeMixShader")
    for shader, side in zip(shaders, mix.inputs[1:]):
        tree.links.new(tree.nodes.new(shader).outputs[0], side)
    return tree, mix.inputs[0]


def leaf(name, pixels, output):
    """Its colour is a picture, of which an output says where it is; None: everywhere."""
    tree, factor = mixture(name, "ShaderNodeBsdfTransparent", "ShaderNodeBsdfDiffuse")
    picture = tree.nodes.new("ShaderNodeTexImage")
    picture.image = bpy.data.images.new(name, 4, 4, alpha=True)
    picture.image.pixels = pixels
    picture.image.pack()
    diffuse = next(node for node in tree.nodes if node.type == "BSDF_DIFFUSE")
    tree.links.new(picture.outputs["Color"], diffuse.inputs["Color"])
    if output:
        tree.links.new(picture.outputs[output], factor)
    else:
        factor.default_value = 1
    return name


def again(name):
    """Another material that shows the same pictures in the same way."""
    return bpy.data.materials[name].copy().name


def film():
    _, factor = mixture("film", "ShaderNodeBsdfDiffuse", "ShaderNodeBsdfTransparent")
    factor.default_value = .75
    return "film"


def veil():
    _, principled = new_material("veil", "ShaderNodeBsdfPrincipled")
    principled.inputs["Alpha"].default_value = .5
    return "veil"


bpy.ops.wm.read_factory_settings(use_empty=True)
for place, name in enumerate((
        outside_alone(), pattern(), leaf("leaf", [.25, .5, .125, 1] * 8 + [.25, .5, .125, 0] * 8, "Alpha"),
        leaf("lace", [.5, .5, .5, 1] * 16, "Color"), leaf("faded", [.75, .5, .25, .5] * 16, None), film(), veil(), again("lace"),
        again("faded"))):
    bpy.ops.mesh.primitive_cube_add(location=(4 * place, 0, 0))
    bpy.context.object.name = name
    bpy.context.object.data.materials.append(bpy.data.materials[name])
bpy.ops.wm.save_as_mainfile(filepath=sys.argv[-1])
