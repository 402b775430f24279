"""Plain objects for the items of a render (objects/shown.py): no other module makes or changes them."""
import bpy
from mathutils import Matrix

from objects import instance_values
from scene_ops import light_linking
from scene_ops.keys import KEY_PROPERTY, LABEL_PROPERTY, NAME_PROPERTY
from scene_ops.names import fitting

PIVOT = "rnmbake pivot"


def put(item):
    """Make what a render shows there, where it is and with its materials. Copies have many a name; others take theirs
    over, from which comes their Random."""
    make(item, fitting(item.name, bpy.data.objects) if item.is_copy else free_name(item.name))
    place(item.object, item.matrix)
    give_materials(item.object, item.materials)
    return item.object


def make(item, name):
    """An object with all that Cycles and materials read of the item, in the scene; it has no place yet."""
    ob = item.object = bpy.data.objects.new(name, item.data) if item.data else _copy(item.original, name)
    for flag, value in item.flags.items():
        setattr(ob, flag, value)
    for flag, value in item.cycles_flags.items():
        setattr(ob.cycles, flag, value)
    for key, value in item.values.items():
        ob[key] = value
    bpy.context.scene.collection.objects.link(ob)
    return ob


def _copy(original, name):
    """Copy an object without a surface, free of parent, constraints and animation."""
    ob = original.copy()
    ob.name, ob.parent, ob.hide_render = name, None, False
    ob.constraints.clear()
    ob.animation_data_clear()
    return ob


def link_lights(items, counterpart=lambda collection: collection):
    """Once all are made: the lights that light them and that they block, and what they light and what blocks them where
    they glow themselves. `counterpart`: the collection to use for one of the scene's."""
    for item in items:
        for role, collection in item.chosen.items():
            setattr(item.object.light_linking, role, counterpart(collection))
        for collection, state in item.memberships:
            light_linking.join(item.object, counterpart(collection), state)


def give_materials(ob, materials):
    """In slots of the object's own where its mesh has others: objects may share it."""
    if not materials:
        return
    while len(ob.data.materials) < len(materials):
        ob.data.materials.append(None)
    for slot, material in zip(ob.material_slots, materials):
        if slot.material != material:
            slot.link, slot.material = "OBJECT", material


def answer_instances(items):
    """Materials that ask what only instances know get copies, which read it from the stand-ins."""
    answered = {}
    for item in items:
        if instance_values.RANDOM in item.values:
            item.materials = [_answered(material, answered) for material in item.materials]


def _answered(material, answered):
    if material not in answered:
        answered[material] = material
        if material and material.node_tree and instance_values.asks(material.node_tree):
            copy = answered[material] = material.copy()
            copy[LABEL_PROPERTY] = material.get(LABEL_PROPERTY, material.name_full)
            instance_values.answer(copy.node_tree)
    return answered[material]


def place(ob, matrix):
    """Set the matrix by location, rotation and scale; by a parent where it has shear."""
    ob.matrix_basis = matrix
    error = max(abs(a - b) for row, wanted in zip(ob.matrix_basis, matrix) for a, b in zip(row, wanted))
    if error > 1e-6 * max(1, max(abs(value) for row in matrix for value in row)):
        hang(ob, matrix)


def hang(ob, matrix):
    """Set the matrix as the inverse of a parent's, which holds any matrix exactly."""
    ob.matrix_basis.identity()
    ob.parent, ob.matrix_parent_inverse = _pivot(), matrix


def _pivot():
    """Find or make the parent at the origin; one of an earlier run may have been moved."""
    held = bpy.context.scene.collection.objects
    pivot = held.get(PIVOT)
    if pivot is None or pivot.matrix_world != Matrix():
        give_way(PIVOT)
        pivot = bpy.data.objects.new(PIVOT, None)
        held.link(pivot)
    return pivot


def free_name(name):
    """The name itself, or with a hash where it is longer than names can be. What else has it gives way."""
    name = fitting(name)
    give_way(name)
    return name


def give_way(name):
    other = next((ob for ob in bpy.data.objects if ob.name == name and not ob.library), None) \
        if name in bpy.data.objects else None
    if other is not None:
        other.name = "rnmbake other"


def keep_key(ob, key, plain_name):
    """Surveys name the object, and choose it, as in the user's own scene."""
    if not ob.library and (ob.name, ob.name) != (key, plain_name):
        ob[KEY_PROPERTY], ob[NAME_PROPERTY] = key, plain_name
