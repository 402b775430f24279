"""Fences: upright strips along the rims of faces that keep light which does not rise over a face from its receivers.

The driver says where they stand (src/bake/fences.h). Only rays to lights meet them, and those that rise over the face
go through.
"""
from array import array

import bpy

from core.arrays import read_floats
from scene_ops import light_linking
from scene_ops.plain_material import new_diffuse

GRAZING_SINE = 1e-6  # as in src/scene/surface.h
UP = "rnmbake up"


def build(task, scene, fences):
    count = fences["count"]
    if count == 0:
        return
    with open(task.path(fences["arrays"]), "rb") as stream:
        mesh = _mesh_of(stream, count)
    mesh.materials.append(_make_material())
    fence = bpy.data.objects.new(mesh.name, mesh)
    scene.collection.objects.link(fence)
    for ray in ("camera", "diffuse", "glossy", "transmission", "volume_scatter"):
        setattr(fence, "visible_" + ray, False)
    light_linking.block(fence)


def _mesh_of(stream, count):
    """Four corners each, then the normal of the face for each corner."""
    mesh = bpy.data.meshes.new("rnmbake fence")
    mesh.vertices.add(4 * count)
    mesh.loops.add(4 * count)
    mesh.polygons.add(count)
    mesh.vertices.foreach_set("co", read_floats(stream, 12 * count))
    mesh.loops.foreach_set("vertex_index", array("i", range(4 * count)))
    mesh.polygons.foreach_set("loop_start", array("i", range(0, 4 * count, 4)))
    if bpy.app.version < (4, 0):
        mesh.polygons.foreach_set("loop_total", array("i", [4]) * count)
    mesh.attributes.new(UP, "FLOAT_VECTOR", "POINT").data.foreach_set("vector", read_floats(stream, 12 * count))
    mesh.update()
    return mesh


def _make_material():
    """Black for light that does not rise over the face, else transparent."""
    material = new_diffuse("rnmbake fence", (0, 0, 0))
    nodes, links = material.node_tree.nodes, material.node_tree.links
    surface = next(node for node in nodes if node.type == "OUTPUT_MATERIAL").inputs["Surface"]
    black = surface.links[0].from_socket
    up, geometry, falls, blocks, mix, clear = (
        nodes.new("ShaderNode" + kind)
        for kind in ("Attribute", "NewGeometry", "VectorMath", "Math", "MixShader", "BsdfTransparent"))
    up.attribute_name = UP
    falls.operation = "DOT_PRODUCT"
    links.new(geometry.outputs["Incoming"], falls.inputs[0])  # against the ray
    links.new(up.outputs["Vector"], falls.inputs[1])
    blocks.operation = "GREATER_THAN"
    links.new(falls.outputs["Value"], blocks.inputs[0])
    blocks.inputs[1].default_value = -GRAZING_SINE
    links.new(blocks.outputs[0], mix.inputs[0])
    links.new(clear.outputs[0], mix.inputs[1])
    links.new(black, mix.inputs[2])
    links.new(mix.outputs[0], surface)
    return material
