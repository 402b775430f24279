"""Keeps a glowing surface from lighting its own receivers from behind.

A receiver floats just above its face. Cycles aims light samples at the glowing triangles of a scene, also at the
one right below, which fills the whole lower hemisphere there, and a tilted corner normal takes part of it in.
Paths that find the light by chance never look below the face. So where such a surface is too large to be missed,
it is left to chance alone; that is the better way to sample it anyway. A small lamp stays a target of samples,
or everything else would be noisy. The receivers on lamps are therefore baked in a launch of their own, in which
their lamps are left to chance. Objects of which less than half glows are not: the bases of texels on the glowing
part are too bright then, by 5 to 12 % of what a lone square lamp emits.
"""
from array import array

import bpy

from scene_ops.describe import describe_material
from scene_ops.keys import material_name

LARGE = 0.25  # of the area of everything that is rendered


def leave_large_emitters_to_chance():
    areas, glowing = _areas_by_material()
    total = sum(areas.values())
    for material in glowing:
        if areas[material] > LARGE * total:
            _no_light_sampling(material)


def leave_to_chance(names):
    """Materials by the names that the survey gave them."""
    for material in bpy.data.materials:
        if material_name(material) in names:
            _no_light_sampling(material)


def _areas_by_material():
    """Square units of each material as it is rendered, and which of them emit light."""
    areas = {}
    for instance in bpy.context.evaluated_depsgraph_get().object_instances:
        ob = instance.object
        if ob.type != "MESH":
            continue
        scale = abs(instance.matrix_world.determinant()) ** (2 / 3)
        materials = [slot.material.original if slot.material else None for slot in ob.material_slots] or [None]
        for material, area in zip(materials, _areas_by_slot(ob.data, len(materials))):
            areas[material] = areas.get(material, 0) + scale * area
    return areas, [material for material in areas if material and describe_material(material)["emissive"]]


def _areas_by_slot(mesh, slots):
    count = len(mesh.polygons)
    area, index = array("f", bytes(4 * count)), array("i", bytes(4 * count))
    mesh.polygons.foreach_get("area", area)
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
