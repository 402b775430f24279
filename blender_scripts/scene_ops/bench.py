"""A scene of its own in which one object at a time is baked: no lights, no world, nothing else to build rays for."""
from contextlib import contextmanager

import bpy

from core.task import Refusal

SAMPLES = 4  # spread over the texel; colour and emission have no other noise


class Bench:
    def __init__(self, like):
        self.scene = bpy.data.scenes.new("rnmbake bench")
        self.scene.frame_current = like.frame_current
        self.scene.render.engine = "CYCLES"
        cycles = self.scene.cycles
        cycles.samples, cycles.use_adaptive_sampling, cycles.use_denoising = SAMPLES, False, False
        cycles.sample_clamp_direct = cycles.sample_clamp_indirect = 0
        cycles.max_bounces = cycles.transparent_max_bounces = 0  # what lies behind is no part of a surface
        cycles.film_exposure = 1
        self.view_layer = self.scene.view_layers[0]

    @contextmanager
    def holding(self, ob):
        """`ob` is in the bench, selected and active."""
        self.scene.collection.objects.link(ob)
        ob.select_set(True, view_layer=self.view_layer)
        self.view_layer.objects.active = ob
        with bpy.context.temp_override(scene=self.scene, view_layer=self.view_layer, object=ob, active_object=ob,
                                       selected_objects=[ob]):
            yield
        self.scene.collection.objects.unlink(ob)

    def bake(self, ob, kind, margin):
        """`kind`: DIFFUSE (the colour alone) or EMIT. Into the active images of the object's materials."""
        options = {"pass_filter": {"COLOR"}} if kind == "DIFFUSE" else {}
        outcome = bpy.ops.object.bake(type=kind, margin=margin, margin_type="EXTEND", use_clear=True,
                                      target="IMAGE_TEXTURES", save_mode="INTERNAL", **options)
        if outcome != {"FINISHED"}:
            raise Refusal(f"Blender cancelled the bake of the {kind.lower()} colour of '{ob.name}'",
                          object_name=ob.name)


@contextmanager
def bench():
    """Every window shows the bench's scene for as long as this lasts: operators work on what a window shows."""
    windows = bpy.context.window_manager.windows
    before = bpy.context.scene
    made = Bench(before)
    for window in windows:
        window.scene = made.scene
    yield made
    for window in windows:
        window.scene = before
    bpy.data.scenes.remove(made.scene)


def new_image(name, side):
    image = bpy.data.images.new(name, side, side, alpha=True, float_buffer=True)
    image.colorspace_settings.name = "Non-Color"
    return image
