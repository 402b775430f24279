"""Checks the scene that Blender's own command line opened, or says in one line why it cannot be baked."""
import json
import os

import bpy

from core.task import INVALID_INPUT, Refusal
from opening import untrusted
from opening.added_light import add_light
from opening.caches import missing_caches
from opening.choose import choose
from opening.pictures import picture_faults
from scene_ops.keys import CAMERA_PROPERTY
from scene_ops.neutral import neutralise

# On a scene that was imported (import_scene.py): a JSON list of what its file says and nobody follows.
NOTES_PROPERTY = "rnmbake notes"


def open_scene(task):
    """Check the open scene, request["scene"], after going to what of it is to be baked."""
    if not bpy.data.filepath:
        raise Refusal(f"{task.request['scene']}: Blender did not open it; is it damaged, or saved by a newer Blender?")
    choose(task)
    add_light(task.request)
    refuse_devices()
    refuse_missing_libraries()
    refuse_blocked_scripts(task)
    untrusted.refuse_stopped()
    leave_edit_mode()


def open_to_measure(task):
    """open_scene() for launches that measure the scene's light; returns warnings for the user."""
    open_scene(task)
    untrusted.settle_programs(task, bpy.context.scene)
    return neutralise(bpy.context.scene)


def scene_warnings():
    """Warnings about the open scene: losses of its import, missing pictures and caches."""
    scene = bpy.context.scene
    looked_at_before = CAMERA_PROPERTY in scene  # lambert_entry.py made it, and has said what was wrong with the pictures
    return import_notes(scene) + ([] if looked_at_before else [*picture_faults()]) + [*missing_caches()]


def import_notes(scene):
    try:
        notes = json.loads(scene.get(NOTES_PROPERTY, "[]"))
    except (TypeError, ValueError):
        return []  # a property of the user's own
    return [note for note in notes if isinstance(note, str)] if isinstance(notes, list) else []


def leave_edit_mode():
    """A mesh that was saved in Edit mode has empty UV layers until the mode is left."""
    view_layer = bpy.context.view_layer
    active = view_layer.objects.active
    for ob in view_layer.objects:
        if ob.mode != "OBJECT":
            view_layer.objects.active = ob
            bpy.ops.object.mode_set(mode="OBJECT")
    view_layer.objects.active = active


def refuse_devices():
    """Reading a device or a pipe in a picture's place would never end."""
    for path in bpy.utils.blend_paths(absolute=True, packed=False):
        if os.path.exists(path) and not os.path.isfile(path) and not os.path.isdir(path):
            raise Refusal(f"{path}: the scene reads it, but it is no file; name one in Blender (File > External Data)")


def refuse_missing_libraries():
    for library in bpy.data.libraries:
        path = bpy.path.abspath(library.filepath, library=library.parent)
        if not library.packed_file and not os.path.exists(path):
            raise Refusal(f"linked library not found: {path}; restore it, or relink it in Blender "
                          "(File > External Data)")
    for kind in (bpy.data.objects, bpy.data.meshes, bpy.data.materials, bpy.data.collections):
        for block in kind:
            if block.library and getattr(block, "is_missing", False):
                path = bpy.path.abspath(block.library.filepath)
                raise Refusal(f"linked library {path} no longer holds {block.name!r}; relink it in Blender",
                              object_name=block.name)


def refuse_blocked_scripts(task):
    """Blender sets autoexec_fail when it loads a script, or evaluates a driver, that it was told to block."""
    if task.request.get("allow_scripts") or not bpy.app.autoexec_fail:
        return
    owner = scripted_driver_owner()
    what = f"object or data {owner!r}" if owner else os.path.basename(task.request["scene"])
    raise Refusal(f"{what}: embedded scripts or drivers are blocked ({bpy.app.autoexec_fail_message}) and the bake "
                  "would silently be wrong; pass --allow-scripts if you trust the file", INVALID_INPUT, owner)


def scripted_driver_owner():
    """The first thing, objects before data, with a driver that needs Python; "" if there is none."""
    for kind in (bpy.data.objects, bpy.data.meshes, bpy.data.shape_keys, bpy.data.curves, bpy.data.lights,
                 bpy.data.materials, bpy.data.node_groups, bpy.data.worlds, bpy.data.scenes):
        for block in kind:
            if has_scripted_driver(block) or has_scripted_driver(getattr(block, "node_tree", None)):
                return block.name
    return ""


def has_scripted_driver(block):
    animation = getattr(block, "animation_data", None)
    return animation is not None and any(
        curve.driver.type == "SCRIPTED" and not curve.driver.is_simple_expression for curve in animation.drivers)
