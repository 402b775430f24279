"""Glowing surfaces as Cycles samples them: hidden from their own receivers, and large ones left to chance.

A receiver floats just above its face. Cycles aims light samples at the glowing triangles of a scene, also at the one
right below, which fills the whole lower hemisphere there, and a tilted corner normal takes part of it in. Rays that
meet light by chance never look below the face. So a glowing surface shows nothing to what lies in its plane, which it
cannot light anyway: where a ray's origin is no higher over the plane of what it asks than twice a receiver.

A surface too large to be missed is not aimed at: chance finds it with less noise, in less time.
"""
from array import array

import bpy

from scene_ops.describe import describe_material
from scene_ops.describe_nodes import active_output
from scene_ops.keys import material_name

LARGE = 0.25  # of the area of everything that is rendered


def leave_large_emitters_to_chance():
    glowing = [material for material in bpy.data.materials if describe_material(material)["emissive"]]
    if not glowing:
        return
    areas = _areas_by_material()
    total = sum(areas.values())
    for material in glowing:
        if areas.get(material, 0) > LARGE * total:
            _no_light_sampling(material)


def hide_from_own_receivers(heights):
    """`heights`: of the highest receiver on each glowing material, world units, by the survey's names."""
    for material in bpy.data.materials:
        height = heights.get(material_name(material))
        if height is not None:
            _hide_from_plane(material.node_tree, active_output(material).inputs["Surface"], 2 * height)


def _hide_from_plane(tree, surface, height):
    """The surface's shader stays as it is for rays from more than `height` over the plane of its face, on either
    side."""
    mix = tree.nodes.new("ShaderNodeMixShader")
    tree.links.new(surface.links[0].from_socket, mix.inputs[2])
    tree.links.new(_is_over_plane(tree, height), mix.inputs[0])
    tree.links.new(mix.outputs[0], surface)


def _is_over_plane(tree, height):
    geometry, path = tree.nodes.new("ShaderNodeNewGeometry"), tree.nodes.new("ShaderNodeLightPath")
    cosine = tree.nodes.new("ShaderNodeVectorMath")
    cosine.operation = "DOT_PRODUCT"
    tree.links.new(geometry.outputs["Incoming"], cosine.inputs[0])
    tree.links.new(geometry.outputs["True Normal"], cosine.inputs[1])
    over = _math(tree, "MULTIPLY", cosine.outputs["Value"], path.outputs["Ray Length"])
    return _math(tree, "GREATER_THAN", _math(tree, "ABSOLUTE", over), height)


def _math(tree, operation, *inputs):
    node = tree.nodes.new("ShaderNodeMath")
    node.operation = operation
    for socket, value in zip(node.inputs, inputs):
        if isinstance(value, bpy.types.NodeSocket):
            tree.links.new(value, socket)
        else:
            socket.default_value = value
    return node.outputs[0]


def _areas_by_material():
    """Square units of each material as it is rendered."""
    areas = {}
    for instance in bpy.context.evaluated_depsgraph_get().object_instances:
        ob = instance.object
        if ob.type != "MESH":
            continue
        scale = abs(instance.matrix_world.determinant()) ** (2 / 3)
        materials = [slot.material.original if slot.material else None for slot in ob.material_slots] or [None]
        for material, area in zip(materials, _areas_by_slot(ob.data, len(materials))):
            areas[material] = areas.get(material, 0) + scale * area
    return areas


def _areas_by_slot(mesh, slots):
    count = len(mesh.polygons)
    area, index = array("f", bytes(4 * count)), array("i", bytes(4 * count))
    mesh.polygons.foreach_get("area", area)
    if slots == 1:
        return [sum(area)]
    mesh.polygons.foreach_get("material_index", index)
    sums = [0.0] * slots
    for one, slot in zip(area, index):
        sums[min(slot, slots - 1)] += one
    return sums


def _no_light_sampling(material):
    if hasattr(material.cycles, "emission_sampling"):  # from 3.5 on
        material.cycles.emission_sampling = "NONE"
    else:
        material.cycles.sample_as_light = False
