"""Opens the scene that a task names, or says in one line why it cannot be baked."""
import os

import bpy

from core.task import ENVIRONMENT, INVALID_INPUT, IO, UNSUPPORTED, Refusal
from scene_ops import untrusted
from scene_ops.caches import missing_caches
from scene_ops.neutral import neutralise
from scene_ops.saving import save_copy

GLTF = (".glb", ".gltf")
IMPORTED = (*GLTF, ".obj")


def open_scene(task):
    """Open and check request["scene"]; returns what the user should be warned of.

    A .blend was opened by Blender's own command line, before this script ran. glTF and OBJ are imported here,
    into an empty scene, and saved beside the request as imported.blend for the launches that follow.
    """
    scene = task.request["scene"]
    extension = os.path.splitext(scene)[1].lower()
    if extension in GLTF:
        task.progress("load", os.path.basename(scene))
        import_gltf(scene)
    elif extension == ".obj":
        task.progress("load", os.path.basename(scene))
        import_obj(scene)
    elif extension != ".blend":
        raise Refusal(f"{scene}: not a .blend, .glb, .gltf or .obj file", UNSUPPORTED)
    elif not bpy.data.filepath:
        raise Refusal(f"{scene}: Blender did not open it; is it damaged, or saved by a newer Blender?")
    refuse_missing_libraries()
    refuse_blocked_scripts(task)
    untrusted.refuse_stopped()
    leave_edit_mode()
    return [f"picture missing: {image}" for image in missing_images()] + [*missing_caches()]


def open_to_measure(task):
    """The same, for launches that ask what light the scene has."""
    warnings = open_scene(task)
    untrusted.settle_programs(task, bpy.context.scene)
    return warnings + neutralise(bpy.context.scene)


def imported_blend(task):
    """Where the scene of an imported file is kept as a .blend; None for a scene that is one already."""
    if os.path.splitext(task.request["scene"])[1].lower() not in IMPORTED:
        return None
    path = task.path("imported.blend")
    save_copy(path, relative_remap=False, check_existing=False)
    return path


def import_gltf(path):
    if not os.path.isfile(path):
        raise Refusal(f"{path}: no such file", IO)
    mend_numpy()
    bpy.ops.wm.read_factory_settings(use_empty=True)
    if not hasattr(bpy.types, "IMPORT_SCENE_OT_gltf"):
        raise Refusal(f"{path}: this Blender has no glTF importer (add-on io_scene_gltf2); install it, or "
                      "save the scene as .blend", ENVIRONMENT)
    try:
        finished = bpy.ops.import_scene.gltf(filepath=path)
    except RuntimeError as error:
        raise Refusal(f"{path}: the glTF importer gave up: {last_line(error)}") from error
    if "FINISHED" not in finished:
        raise Refusal(f"{path}: the glTF importer refused the file; see the launch's stdout.log")
    bpy.context.view_layer.update()


def import_obj(path):
    """By Blender's own importer (3.3 and later), which turns Y up into Z up."""
    if not os.path.isfile(path):
        raise Refusal(f"{path}: no such file", IO)
    bpy.ops.wm.read_factory_settings(use_empty=True)
    try:
        finished = bpy.ops.wm.obj_import(filepath=path)
    except (AttributeError, RuntimeError) as error:
        raise Refusal(f"{path}: the OBJ importer gave up: {last_line(error)}") from error
    if "FINISHED" not in finished:
        raise Refusal(f"{path}: the OBJ importer refused the file; see the launch's stdout.log")
    bpy.context.view_layer.update()


def mend_numpy():
    """The importer of Blender 3.x uses numpy.bool and its kin, which numpy 1.24 took away."""
    try:
        import numpy
    except ImportError as error:
        raise Refusal("the glTF importer needs numpy, which this Blender's Python does not have; install it "
                      "(Debian: python3-numpy), or save the scene as .blend", ENVIRONMENT) from error
    for name, builtin in (("bool", bool), ("int", int), ("float", float), ("object", object), ("str", str)):
        if name not in numpy.__dict__:
            setattr(numpy, name, builtin)


def last_line(error):
    lines = [line.strip() for line in str(error).splitlines() if line.strip()]
    return lines[-1].replace("Error: ", "", 1) if lines else repr(error)


def leave_edit_mode():
    """A mesh that was saved in Edit mode has empty UV layers until the mode is left."""
    view_layer = bpy.context.view_layer
    active = view_layer.objects.active
    for ob in view_layer.objects:
        if ob.mode != "OBJECT":
            view_layer.objects.active = ob
            bpy.ops.object.mode_set(mode="OBJECT")
    view_layer.objects.active = active


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


def missing_images():
    for image in bpy.data.images:
        if image.source != "FILE" or image.packed_file or not image.filepath or not image.users:
            continue
        path = bpy.path.abspath(image.filepath, library=image.library)
        if not os.path.exists(path):
            yield path


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
