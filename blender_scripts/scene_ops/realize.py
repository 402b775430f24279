"""Instances, curves and the like become mesh objects of their own, where a bake needs an object to write to."""
import bpy

from core.task import Refusal
from scene_ops import light_linking
from scene_ops.keys import Keys, instancer_of, shown_surfaces
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


def realize(keys, every=False):
    """Replace what has one of these keys (or every surface) by plain objects; returns them by key.

    An object that makes instances is replaced as a whole: it and all of its instances.
    """
    if not keys and not every:
        return {}
    found = {}
    with_render_depsgraph(lambda depsgraph: _collect(depsgraph, keys, every, found))
    originals = [ob for ob in bpy.data.objects if ob.name_full in found["replaced"]]  # linked ones have their file
    objects = {key: _make_object(key, **content) for key, content in found["copies"].items()}
    for ob in originals:
        ob.hide_render = True
        ob.instance_type = "NONE"
    missing = keys - objects.keys()
    if missing:
        raise Refusal(f"'{sorted(missing)[0]}' was there when the scene was surveyed and is gone now")
    return objects


def _collect(depsgraph, keys, every, found):
    """First find which originals have to go, then copy everything that goes with them."""
    names, replaced = Keys(), set()
    surfaces = []
    for instance in shown_surfaces(depsgraph):
        key = names.new(instance)
        owner = instancer_of(instance) or instance.object.original.name_full
        surfaces.append((key, owner))
        if every or key in keys:
            replaced.add(owner)
    going = {key for key, owner in surfaces if owner in replaced}
    found["replaced"], found["copies"] = replaced, {}
    names = Keys()
    for instance in shown_surfaces(depsgraph):
        key = names.new(instance)
        if key in going:
            found["copies"][key] = _copy(instance)


def _copy(instance):
    ob = instance.object
    mesh = bpy.data.meshes.new_from_object(ob)  # as evaluated: the render depsgraph keeps all UV layers
    materials = [slot.material.original if slot.material else None for slot in ob.material_slots]
    visible = {name: getattr(ob, name) for name in dir(ob)
               if name.startswith("visible_") and isinstance(getattr(ob, name), bool)}
    return {"original": ob.original, "mesh": mesh, "matrix": instance.matrix_world.copy(), "materials": materials,
            "visible": visible}


def _make_object(key, original, mesh, matrix, materials, visible):
    ob = bpy.data.objects.new(key[:60], mesh)
    bpy.context.scene.collection.objects.link(ob)
    place(ob, matrix)
    light_linking.follow(ob, original)
    while len(mesh.materials) < len(materials):
        mesh.materials.append(None)
    for slot, material in zip(ob.material_slots, materials):
        slot.link = "OBJECT"
        slot.material = material
    for name, value in visible.items():
        setattr(ob, name, value)
    return ob


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
