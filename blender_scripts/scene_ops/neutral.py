"""Puts back what a saved scene says about its pictures, so that what it says about its light is all that is measured.

For launches that measure: what is saved for the user keeps its settings. docs/scene-state.md has the whole list. The
settings of Cycles itself are put back in scene_ops/cycles.py, where a bake's own are set.
"""
import bpy

from scene_ops import override
from scene_ops.describe import describe_material

SENT_ON = {"glossy", "metallic", "coat", "glass", "transmission"}  # closures that make caustics


def neutralise(scene):
    """Make the scene neutral before its first evaluation. Returns warnings, a line each."""
    layer = bpy.context.view_layer
    told = [*override.take_over(layer), *follow_layer(scene, layer), *name_caustics(scene), *name_colors()]
    told += leave_dicing_out(scene)
    settle_render(scene)
    return told


def settle_render(scene):
    render = scene.render
    for name in ("use_simplify", "use_motion_blur", "use_border", "use_persistent_data", "use_multiview",
                 "use_freestyle", "use_compositing", "use_sequencer", "use_stamp"):
        set_if_there(render, name, False)
    set_if_there(render.bake, "view_from", "ABOVE_SURFACE")  # a camera's view would turn normals towards it
    set_if_there(render.bake, "target", "IMAGE_TEXTURES")  # Cycles reads it beside what the operator says


def follow_layer(scene, layer):
    """The world of the layer, where it has one of its own, and its surfaces."""
    if getattr(layer, "world_override", None):
        scene.world, layer.world_override = layer.world_override, None
    layer.samples = 0  # the scene's
    if layer.use_solid:
        return
    layer.use_solid = True
    yield f"view layer '{layer.name}' shows no surfaces (Include > Surfaces): they are baked all the same"


def name_caustics(scene):
    off = [kind for kind in ("reflective", "refractive") if not getattr(scene.cycles, "caustics_" + kind)]
    if off and any(SENT_ON & set(describe_material(material)["outside_model"]) for material in bpy.data.materials):
        yield (f"{' and '.join(off)} caustics are off in this scene: light that gloss or glass sends on to other "
               "surfaces is not baked, as it is not rendered; turn them on in Render > Light Paths > Caustics")


def name_colors():
    """Warning about a working space other than Rec.709, which files have from 5.0 on."""
    space = getattr(getattr(bpy.data, "colorspace", None), "working_space", "")
    if space and space != "Linear Rec.709":
        yield f"the scene works in {space}: lightmaps and reference hold red, green and blue of that space"


def leave_dicing_out(scene):
    """Adaptive subdivision makes a mesh for one camera, which no survey sees."""
    switches = []
    for ob in scene.objects:
        last = ob.modifiers[-1] if ob.modifiers else None
        if last is None or last.type != "SUBSURF" or not last.show_render:
            continue
        owner = last if hasattr(last, "use_adaptive_subdivision") else ob.cycles  # before 5.0
        experimental = owner == last or scene.cycles.feature_set == "EXPERIMENTAL"
        if owner.use_adaptive_subdivision and experimental:
            switches.append((ob, owner))
    for ob, owner in switches:
        owner.use_adaptive_subdivision = False
        yield (f"object '{ob.name}': adaptive subdivision is left out, since its mesh hangs on the camera; its "
               "Subdivision modifier's render level counts")


def set_if_there(owner, name, value):
    """Set a property that not every Blender has; say whether it exists."""
    if not hasattr(owner, name):
        return False
    setattr(owner, name, value)
    return True
