"""A view layer's material override becomes every surface's own material, as a render of that layer shows it.

Left where it is, Cycles would give it to receivers, too.
"""
import bpy

from core.task import Refusal


def take_over(layer):
    """Returns what the user should be told, a line each."""
    material = layer.material_override
    if material is None:
        return
    layer.material_override = None
    for other in bpy.data.materials:
        if other != material:
            other.user_remap(material)
    for data in {ob.data for ob in bpy.data.objects if hasattr(ob.data, "materials")}:
        _fill(data, material)
    for ob in bpy.data.objects:
        _fill_slots(ob, material, layer)
    for tree in bpy.data.node_groups:
        _fill_sockets(tree, material)
    yield (f"view layer '{layer.name}' overrides all materials with '{material.name}': their light is baked, as it "
           "is rendered; clear View Layer > Override > Material if it was left there by mistake")


def _fill(data, material):
    """Also the surfaces that have no slot, and those of linked files, which a remap leaves alone."""
    if not data.materials:
        data.materials.append(material)
    for slot in range(len(data.materials)):
        data.materials[slot] = material


def _fill_slots(ob, material, layer):
    for slot in ob.material_slots:
        if slot.material != material and ob.library:
            raise Refusal(f"object '{ob.name}' of a linked file keeps its material under the override of view layer "
                          f"'{layer.name}'; clear View Layer > Override > Material", object_name=ob.name)
        if slot.material != material:
            slot.material = material


def _fill_sockets(tree, material):
    for node in tree.nodes:
        for socket in node.inputs:
            if socket.type == "MATERIAL" and socket.default_value:
                socket.default_value = material
