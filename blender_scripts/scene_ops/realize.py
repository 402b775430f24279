"""Instances, curves and the like become mesh objects of their own, where a bake needs an object to write to."""
import bpy

from core.task import Refusal
from scene_ops import light_linking
from scene_ops.instance_values import attributes_by_host, values_of
from scene_ops.keys import Keys, instancer_of, shown_surfaces
from scene_ops.lambert_collect import Shown, copy_mesh
from scene_ops.names import fitting
from scene_ops.survey import with_render_depsgraph

PIVOT = "rnmbake pivot"


def targets_as_objects(targets):
    """One mesh object for each target, in order. Those that can stay as they are do."""
    copies = realize({target["key"] for target in targets if needs_copy(target)})
    return [copies.get(target["key"]) or bpy.data.objects[target["name"]] for target in targets]


def needs_copy(target):
    ob = bpy.data.objects.get(target["name"])
    if ob is None or target["key"] != ob.name or ob.library or ob.type != "MESH" or ob.data.library:
        return True
    if not can_be_selected(ob):
        return True
    return "uv_array" in target or "polygons" in target or target["uv_layer"] not in ob.data.uv_layers


def can_be_selected(ob):
    """Blender bakes what is selected, and what only renders show cannot be."""
    ob.hide_select = False
    try:
        ob.select_set(True)
    except RuntimeError:  # not in the view layer
        return False
    return ob.visible_get() and ob.select_get()


def realize(keys):
    """Replace what has one of these keys by plain objects; returns them by key.

    An object that makes instances is replaced as a whole: it and all of its instances.
    """
    if not keys:
        return {}
    shown = collect(lambda key, instance: key in keys)
    missing = keys - {item.name for item in shown}
    if missing:
        raise Refusal(f"'{sorted(missing)[0]}' was there when the scene was surveyed and is gone now")
    objects = {item.name: make_object(item) for item in shown}
    for owner in {item.owner for item in shown}:
        owner.hide_render = True  # of a linked one for as long as Blender runs
        for child in stop_instancing(owner):
            child.hide_render = True
    return objects


def collect(is_wanted):
    """A Shown, with its mesh as evaluated, for each surface that is_wanted(key, instance), and for all else that its
    object makes. Objects that share evaluated data share the mesh."""
    shown = []
    by_host = attributes_by_host()
    with_render_depsgraph(lambda depsgraph: shown.extend(_collect(depsgraph, is_wanted, by_host)))
    return shown


def _collect(depsgraph, is_wanted, by_host):
    names, owners, surfaces = Keys(), set(), []
    for instance in shown_surfaces(depsgraph):
        key, owner = names.new(instance), owner_of(instance)
        surfaces.append((key, owner))
        if is_wanted(key, instance):
            owners.add(owner)
    meshes = {}
    for (key, owner), instance in zip(surfaces, shown_surfaces(depsgraph)):
        if owner not in owners:
            continue
        item = Shown(instance, key)
        data = instance.object.data.as_pointer()
        if data not in meshes:
            meshes[data] = copy_mesh(instance.object)  # the render depsgraph keeps all UV layers
        item.data, item.values = meshes[data], values_of(instance, by_host)
        item.materials = [slot.material.original if slot.material else None for slot in instance.object.material_slots]
        yield item


def owner_of(instance):
    """The object that would have to go with it: what makes the instance, or the object itself."""
    return (instance.parent if instancer_of(instance) else instance.object).original


def stop_instancing(owner):
    """Returns the objects that only its instances showed, and that now show themselves."""
    patterns = list(owner.children) if owner.instance_type in ("VERTS", "FACES") else []
    owner.instance_type = "NONE"
    return patterns


def make_object(item):
    """What a render shows there, as an object that nothing else changes."""
    ob = bpy.data.objects.new(fitting(item.name, bpy.data.objects), item.data)
    bpy.context.scene.collection.objects.link(ob)
    place(ob, item.matrix)
    keep_flags(ob, item)
    give_materials(ob, item.materials)
    return ob


def keep_flags(ob, item):
    """Who sees it, what Cycles and materials read of it, and which lights light it or are its own."""
    for name, value in {**item.visible, **item.flags}.items():
        setattr(ob, name, value)
    for name, value in item.cycles_flags.items():
        setattr(ob.cycles, name, value)
    for name, value in item.values.items():
        ob[name] = value
    for role, collection in item.linking.items():
        setattr(ob.light_linking, role, collection)
    light_linking.follow(ob, item.owner if light_linking.memberships(item.owner) else item.original)


def give_materials(ob, materials):
    while len(ob.data.materials) < len(materials):
        ob.data.materials.append(None)
    for slot, material in zip(ob.material_slots, materials):
        if slot.material != material:
            slot.link, slot.material = "OBJECT", material


def place(ob, matrix):
    """By location, rotation and scale; a matrix with shear needs a parent, whose inverse may be any matrix."""
    ob.matrix_basis = matrix
    error = max(abs(a - b) for row, wanted in zip(ob.matrix_basis, matrix) for a, b in zip(row, wanted))
    if error <= 1e-6 * max(1, max(abs(value) for row in matrix for value in row)):
        return
    ob.matrix_basis.identity()
    ob.parent = bpy.data.objects.get(PIVOT) or _make_pivot()
    ob.matrix_parent_inverse = matrix


def _make_pivot():
    pivot = bpy.data.objects.new(PIVOT, None)
    bpy.context.scene.collection.objects.link(pivot)
    return pivot
