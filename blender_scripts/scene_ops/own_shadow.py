"""Keeps light from coming to a see-through object's receivers through the object itself.

Cycles looks for lamps above the horizon of a closure's normal, also where they stand under the face, and leaves it to
the surface below the receiver to block them. A see-through one does not. So its front is opaque for shadow rays that
start right above it: as no other rays do.
"""
import bpy

from scene_ops.describe_nodes import active_output
from scene_ops.see_through import has_transparency

# A receiver's height over its face, as in src/scene/surface.cpp, and how many of them count as right above it: light
# that comes from less than 0.1 degrees under the face gets through.
LEAST, SHARE, REACH = 1e-5, 1e-6, 500


def block_light_from_below():
    for material in bpy.data.materials:
        if not material.library and has_transparency(material):
            _wrap(material.node_tree, active_output(material).inputs["Surface"])


def _wrap(tree, surface):
    nodes, links = tree.nodes, tree.links
    mix, black = nodes.new("ShaderNodeMixShader"), nodes.new("ShaderNodeBsdfDiffuse")
    black.inputs["Color"].default_value = (0, 0, 0, 1)
    links.new(_from_own_receiver(tree), mix.inputs[0])
    links.new(surface.links[0].from_socket, mix.inputs[1])
    links.new(black.outputs[0], mix.inputs[2])
    links.new(mix.outputs[0], surface)


def _from_own_receiver(tree):
    """1 for a short shadow ray that meets the front."""
    nodes, links = tree.nodes, tree.links
    ray, place, distance = (nodes.new(kind) for kind in
                            ("ShaderNodeLightPath", "ShaderNodeNewGeometry", "ShaderNodeVectorMath"))
    distance.operation = "LENGTH"
    links.new(place.outputs["Position"], distance.inputs[0])

    def math(operation, one, other):
        node = nodes.new("ShaderNodeMath")
        node.operation = operation
        for socket, value in zip(node.inputs, (one, other)):
            if isinstance(value, bpy.types.NodeSocket):
                links.new(value, socket)
            else:
                socket.default_value = value
        return node.outputs[0]

    height = math("MAXIMUM", LEAST, math("MULTIPLY", SHARE, distance.outputs["Value"]))
    is_near = math("LESS_THAN", ray.outputs["Ray Length"], math("MULTIPLY", REACH, height))
    is_front = math("SUBTRACT", 1, place.outputs["Backfacing"])
    return math("MULTIPLY", ray.outputs["Is Shadow Ray"], math("MULTIPLY", is_near, is_front))
