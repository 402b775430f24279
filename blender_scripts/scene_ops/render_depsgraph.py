"""The dependency graph of a final render.

Render visibility, render levels of modifiers and the instances of a final render exist only in the
dependency graph that Blender builds for a render engine. So a survey is a render engine: one tiny render
in which every object is read and not a pixel drawn.
"""
import bpy


class SurveyEngine(bpy.types.RenderEngine):
    bl_idname = "RNMBAKE_SURVEY"
    bl_label = "rnmbake survey"
    bl_use_preview = False
    visit = None
    visited = False
    error = None

    def render(self, depsgraph):
        cls = SurveyEngine
        if cls.visited:
            return
        cls.visited = True
        try:
            cls.visit(depsgraph)
        except BaseException as error:  # Blender prints what is raised in here and goes on
            cls.error = error


def with_render_depsgraph(visit):
    """Call visit(depsgraph) with the graph of a final render of the current view layer."""
    SurveyEngine.visit, SurveyEngine.visited, SurveyEngine.error = staticmethod(visit), False, None
    if not SurveyEngine.is_registered:
        bpy.utils.register_class(SurveyEngine)
    prepare_render(bpy.context.scene)
    bpy.ops.render.render()
    if SurveyEngine.error:
        raise SurveyEngine.error
    if not SurveyEngine.visited:
        raise RuntimeError("Blender rendered without calling the survey engine")


def prepare_render(scene):
    """The smallest render that reaches the engine, of the view layer that a bake would use."""
    render = scene.render
    render.engine = SurveyEngine.bl_idname
    render.resolution_x = render.resolution_y = 8
    render.resolution_percentage = 100
    for name in ("use_compositing", "use_sequencer", "use_border", "use_freestyle", "use_multiview",
                 "use_motion_blur", "use_persistent_data", "use_simplify", "use_single_layer", "use_stamp"):
        if hasattr(render, name):
            setattr(render, name, False)
    for layer in scene.view_layers:
        layer.use = layer.name == bpy.context.view_layer.name
    if scene.camera is None:
        camera = bpy.data.objects.new("rnmbake survey", bpy.data.cameras.new("rnmbake survey"))
        scene.collection.objects.link(camera)
        scene.camera = camera
