"""Eevee for a picture of the scene as it stands: its lamps and world, nothing that bounces."""
from core.task import ENVIRONMENT, Refusal
from scene_ops.neutral import set_if_there

ENGINES = ("BLENDER_EEVEE_NEXT", "BLENDER_EEVEE")  # 4.2 to 4.5; before and after


def apply_settings(scene, settings):
    """`settings`: samples."""
    _choose(scene.render)
    scene.render.filter_size = 0.0  # over a pixel's square alone, as near as it can
    scene.eevee.taa_render_samples = settings["samples"]
    for effect in ("use_bloom", "use_motion_blur"):
        set_if_there(scene.eevee, effect, False)


def _choose(render):
    for name in ENGINES:
        try:
            render.engine = name
            return
        except TypeError:
            continue
    raise Refusal("this Blender has no Eevee; use --with cycles", ENVIRONMENT)
