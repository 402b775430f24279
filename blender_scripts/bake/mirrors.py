"""Mirrors: receivers that show the radiance that arrives along one ray each (src/bake/mirrors.h).

What a ray meets at once, a lamp, a glowing surface or the sky, is to be left out: it comes from plain receivers, with less
noise. A bake that may not bounce shows just that, so it is taken off. Hiding lamps would show what is behind them, and nodes
that hide what glows are not asked by lamps.
"""
from array import array

import bpy

from scene_ops.plain_material import empty_tree


def make_material(image):
    """A perfect mirror; `image` is what the bake writes to."""
    material = bpy.data.materials.new("rnmbake mirror")
    tree = empty_tree(material)
    shader, output, texture = (tree.nodes.new(kind) for kind in
                               ("ShaderNodeBsdfGlossy", "ShaderNodeOutputMaterial", "ShaderNodeTexImage"))
    if bpy.app.version < (4, 0):
        shader.distribution = "SHARP"
    shader.inputs["Color"].default_value = (1, 1, 1, 1)
    shader.inputs["Roughness"].default_value = 0
    tree.links.new(shader.outputs[0], output.inputs["Surface"])
    texture.image = image
    tree.nodes.active = texture
    return material


def take_off(pixels, met_at_once):
    """RGBA of what arrives, without what is met at once; coverage stays."""
    both = array("f", pixels)
    for channel in range(3):
        both[channel::4] = array("f", map(float.__sub__, pixels[channel::4], met_at_once[channel::4]))
    return both
