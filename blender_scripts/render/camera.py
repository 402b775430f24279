"""One camera's view by Cycles, without filter, denoiser, depth of field and motion blur."""
import math

import bpy
from mathutils import Matrix

SENSOR = 36.0  # mm; any would do
NEAREST, FARTHEST = 1e-4, 1e6  # nothing is clipped: the tracer does not clip either


def look_through(scene, camera):
    """A camera of our own, so that the view does not hang on how the user's fits its sensor."""
    data = bpy.data.cameras.new("rnmbake view")
    data.sensor_fit, data.sensor_width = "HORIZONTAL", SENSOR
    data.shift_x, data.shift_y = camera["shift_x"], camera["shift_y"]
    data.clip_start, data.clip_end = NEAREST, FARTHEST
    if camera["orthographic"]:
        data.type, data.ortho_scale = "ORTHO", camera["width"]
    else:
        data.lens = SENSOR / 2 / math.tan(camera["angle_x"] / 2)
    ob = bpy.data.objects.new("rnmbake view", data)
    scene.collection.objects.link(ob)
    ob.matrix_world = Matrix([camera["matrix"][4 * row:4 * row + 4] for row in range(4)])
    scene.camera = ob
    for marker in scene.timeline_markers:
        marker.camera = None  # a marker's camera would take over


def size(scene, width, height, pixel_shape):
    render = scene.render
    render.resolution_x, render.resolution_y, render.resolution_percentage = width, height, 100
    render.pixel_aspect_x, render.pixel_aspect_y = max(1.0, pixel_shape), max(1.0, 1 / pixel_shape)


def settle(scene):
    """Linear radiance, the mean over each pixel's square, world and all."""
    render = scene.render
    render.film_transparent = render.use_compositing = render.use_sequencer = False
    render.use_motion_blur = render.use_freestyle = render.use_multiview = False
    render.use_file_extension = False
    settings = render.image_settings
    if hasattr(settings, "media_type"):
        settings.media_type = "IMAGE"
    settings.file_format, settings.color_mode, settings.color_depth = "OPEN_EXR", "RGB", "32"
    settings.color_management = "FOLLOW_SCENE"  # else a file may ask for primaries of its own
    scene.cycles.pixel_filter_type = "BOX"
    shown = bpy.context.view_layer
    shown.samples = 0  # the scene's
    for layer in scene.view_layers:
        layer.use = layer == shown
