"""Materials of one Diffuse BSDF."""
import bpy

NO_MATERIAL = (0.8, 0.8, 0.8)  # colour of Cycles for slots without a material


def new_diffuse(name, color):
    material = bpy.data.materials.new(name)
    make_diffuse(material, color)
    return material


def make_diffuse(material, color):
    """Diffuse BSDF of roughness 0 in place of whatever the material was."""
    tree = empty_tree(material)
    shader, output = tree.nodes.new("ShaderNodeBsdfDiffuse"), tree.nodes.new("ShaderNodeOutputMaterial")
    shader.inputs["Color"].default_value = (*color, 1)
    shader.inputs["Roughness"].default_value = 0
    tree.links.new(shader.outputs["BSDF"], output.inputs["Surface"])


def make_clear(material):
    """Lets all light through, as if there were no surface."""
    tree = empty_tree(material)
    shader, output = tree.nodes.new("ShaderNodeBsdfTransparent"), tree.nodes.new("ShaderNodeOutputMaterial")
    shader.inputs["Color"].default_value = (1, 1, 1, 1)
    tree.links.new(shader.outputs["BSDF"], output.inputs["Surface"])


def empty_tree(owner):
    """Empty the node tree of a material or world. Blender 5 makes a tree by itself and warns about use_nodes."""
    if not owner.use_nodes:
        owner.use_nodes = True
    owner.node_tree.nodes.clear()
    return owner.node_tree
