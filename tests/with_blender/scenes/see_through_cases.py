"""blender -b --factory-startup --python see_through_cases.py -- FILE: a floor under see-through things: a leaf and a screen
cut out by a picture of alpha, and a tinted pane that glows."""
import sys

import bpy


def new_tree(block):
    if not block.use_nodes:
        block.use_nodes = True
    block.node_tree.nodes.clear()
    return block.node_tree


def material(name, build):
    """`build(tree)` returns the shader that goes to the surface."""
    made = bpy.data.materials.new(name)
    tree = new_tree(made)
    tree.links.new(build(tree).outputs[0], tree.nodes.new("ShaderNodeOutputMaterial").inputs["Surface"])
    return made


def shader(tree, kind, color, socket="Color"):
    node = tree.nodes.new("ShaderNode" + kind)
    node.inputs[socket].default_value = (*color, 1)
    return node


def joined(tree, kind, one, other):
    """A Mix or Add Shader; its two shaders are the last inputs."""
    node = tree.nodes.new("ShaderNode" + kind)
    tree.links.new(one.outputs[0], node.inputs[-2])
    tree.links.new(other.outputs[0], node.inputs[-1])
    return node


def diffuse(color):
    return lambda tree: shader(tree, "BsdfDiffuse", color)


def leaf(tree):
    """A third of it is opaque, a third half so; alpha comes from a picture."""
    image = bpy.data.images.new("alpha", 6, 6)
    image.colorspace_settings.name = "Non-Color"
    image.pixels = [value for row in range(6) for column in range(6)
                    for value in ((row + column) % 3 / 2, (row + column) % 3 / 2, (row + column) % 3 / 2, 1)]
    image.pack()
    texture, mixed = tree.nodes.new("ShaderNodeTexImage"), None
    texture.image, texture.interpolation = image, "Closest"
    mixed = joined(tree, "MixShader", shader(tree, "BsdfTransparent", (1, 1, 1)), diffuse((0.2, 0.7, 0.1))(tree))
    tree.links.new(texture.outputs["Color"], mixed.inputs[0])
    return mixed


def screen(tree):
    """As leaf, by Principled's alpha; metallic, so that no version's own diffuse lobe counts."""
    node = shader(tree, "BsdfPrincipled", (0.5, 0.5, 0.5), "Base Color")
    node.inputs["Metallic"].default_value = 1
    checker = tree.nodes.new("ShaderNodeTexChecker")
    checker.inputs["Color1"].default_value, checker.inputs["Color2"].default_value = (1, 1, 1, 1), (0.25, 0.25, 0.25, 1)
    checker.inputs["Scale"].default_value = 4
    tree.links.new(tree.nodes.new("ShaderNodeTexCoord").outputs["UV"], checker.inputs["Vector"])
    tree.links.new(checker.outputs["Color"], node.inputs["Alpha"])
    return node


def pane(tree):
    mixed = joined(tree, "MixShader", shader(tree, "BsdfTransparent", (1, 0.5, 0.25)), diffuse((0.8, 0.4, 0.9))(tree))
    mixed.inputs[0].default_value = 0.4
    glow = shader(tree, "Emission", (0, 0, 1))
    glow.inputs["Strength"].default_value = 0.3
    return joined(tree, "AddShader", mixed, glow)


def quad(name, corners, build):
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(corners, [], [(0, 1, 2, 3)])
    mesh.uv_layers.new(name="UVMap").data.foreach_set("uv", (0, 0, 1, 0, 1, 1, 0, 1))
    mesh.materials.append(material(name, build))
    bpy.context.scene.collection.objects.link(bpy.data.objects.new(name, mesh))


def lamp(kind, energy, place=(0, 0, 0), turn=(0, 0, 0), **sizes):
    light = bpy.data.lights.new(kind, kind)
    light.energy = energy
    for name, value in sizes.items():
        setattr(light, name, value)
    ob = bpy.data.objects.new(kind, light)
    ob.location, ob.rotation_euler = place, turn
    bpy.context.scene.collection.objects.link(ob)


bpy.ops.wm.read_factory_settings(use_empty=True)
quad("floor", [(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)], diffuse((0.7, 0.7, 0.7)))
quad("wall", [(-1, 1, 0), (1, 1, 0), (1, 1, 2), (-1, 1, 2)], diffuse((0.8, 0.3, 0.2)))
quad("leaf", [(-1, -0.6, 0.5), (0.3, -0.6, 0.6), (0.3, 0.8, 0.6), (-1, 0.8, 0.5)], leaf)
quad("pane", [(-0.5, -1, 1), (1, -1, 1), (1, 0.9, 1.2), (-0.5, 0.9, 1.2)], pane)
quad("screen", [(-1, -0.2, 0), (-1, -0.2, 0.5), (1, -0.2, 0.5), (1, -0.2, 0)], screen)
lamp("SUN", 2, turn=(0.5, 0.2, 0), angle=0.1)
lamp("AREA", 30, place=(0, 0, 2), size=0.5)
world = bpy.context.scene.world = bpy.data.worlds.new("world")
nodes = new_tree(world)
nodes.links.new(shader(nodes, "Background", (0.3, 0.4, 0.5)).outputs[0],
                nodes.nodes.new("ShaderNodeOutputWorld").inputs["Surface"])
bpy.ops.wm.save_as_mainfile(filepath=sys.argv[sys.argv.index("--") + 1])
