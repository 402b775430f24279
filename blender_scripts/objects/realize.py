"""Instances, curves and the like become mesh objects of their own, where a bake needs an object to write to."""
import bpy

from core.task import Refusal
from objects import shown, stand_ins


def targets_as_objects(targets):
    """Mesh objects of the targets, in order. Objects that are meshes already stay."""
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
    found = shown.collect(lambda key, instance: key in keys)
    missing = keys - {item.name for item in found.surfaces}
    if missing:
        raise Refusal(f"'{sorted(missing)[0]}' was there when the scene was surveyed and is gone now")
    stand_ins.answer_instances(found)
    for item in found:
        stand_ins.put(item)
    stand_ins.link_lights(found)
    for owner in {item.owner for item in found}:
        owner.hide_render = True  # of a linked one for as long as Blender runs
        for child in stop_instancing(owner):
            child.hide_render = True
    return {item.name: item.object for item in found.surfaces}


def remove(keys):
    """Take what has one of these keys out of the scene; what makes it, and what hangs on that, stay."""
    for ob in realize(set(keys)).values():
        bpy.data.objects.remove(ob)


def stop_instancing(owner):
    """Returns the objects that only its instances showed, and that now show themselves."""
    patterns = list(owner.children) if owner.instance_type in ("VERTS", "FACES") else []
    owner.instance_type = "NONE"
    return patterns
