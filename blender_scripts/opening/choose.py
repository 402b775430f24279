"""Which scene, view layer and frame of a file are baked: those that it was saved with, or those asked for."""
import bpy

from core.task import USAGE, Refusal


def choose(task):
    """request["scene_name"], ["view_layer"] (""), ["frame"] (-1): the file's own. Every window then shows them, for that is
    what operators work on."""
    request = task.request
    scene, layer, frame = request.get("scene_name", ""), request.get("view_layer", ""), request.get("frame", -1)
    if scene:
        _show("scene", _named(request, "scene", scene, [one for one in bpy.data.scenes if not one.library]))
    if layer:
        _show("view_layer", _named(request, "view layer", layer, bpy.context.scene.view_layers))
    if scene or layer or frame >= 0:
        # Animation moves lamps, of which a bake takes what they are in the file's data, only where the view layer was
        # evaluated before.
        bpy.context.evaluated_depsgraph_get()
        bpy.context.scene.frame_set(frame if frame >= 0 else bpy.context.scene.frame_current)


def _named(request, what, name, there):
    for one in there:
        if one.name == name:
            return one
    raise Refusal(f"{request['scene']}: no {what} {name!r} in it; there is " +
                  " and ".join(", ".join(repr(one.name) for one in there).rsplit(", ", 1)), USAGE)


def _show(what, chosen):
    for window in bpy.context.window_manager.windows:
        setattr(window, what, chosen)
    if getattr(bpy.context, what) != chosen:
        raise RuntimeError(f"Blender does not go to {chosen.name!r}")
