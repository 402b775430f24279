"""Cycles as an irradiance meter: every default that biases a bake is turned off."""
import math
import os
from array import array

import bpy

from core.task import ENVIRONMENT, Refusal
from scene_ops.neutral import set_if_there

LAYERS = 128  # see-through surfaces that a ray may cross; beyond Cycles takes them for opaque


# Properties of scene.cycles that change light. All others are reset to Cycles' defaults.
FOLLOWED = {"caustics_reflective", "caustics_refractive", "volume_bounces", "volume_step_rate", "volume_max_steps",
            "volume_unbiased", "volume_biased", "transparent_max_bounces", "shading_system"}


def apply_settings(scene, settings):
    """`settings`: samples, bounces, seed, clamp, device, as in the [bake] table of a project file. A bake in passes
    chooses samples and seed pass by pass (take_pass)."""
    scene.render.engine = "CYCLES"
    cycles = scene.cycles
    _put_back(cycles)
    cycles.samples = settings["samples"]
    cycles.seed = settings["seed"]
    cycles.sample_clamp_direct = settings["clamp"]
    cycles.sample_clamp_indirect = settings["clamp"]
    set_bounces(cycles, settings["bounces"])
    _remove_bias(cycles)
    use_device(scene, settings["device"])


def take_pass(scene, part):
    """The next bake takes `count` samples of a sequence that begins with `seed`, from number `first` on. Together the
    passes of a sequence have the samples of one bake."""
    cycles = scene.cycles
    cycles.seed = part["seed"]
    cycles.samples = part["count"]
    cycles.sample_offset = part["first"]
    if hasattr(cycles, "use_sample_subset"):  # from 4.5 on
        cycles.use_sample_subset = True
        cycles.sample_subset_length = part["count"]
        cycles.samples = part["of"]


def _put_back(cycles):
    """Time limits, sample ranges, scrambling, seeds that follow the frame, and whatever comes next."""
    for prop in cycles.bl_rna.properties:
        name = prop.identifier
        if not prop.is_readonly and name not in FOLLOWED and not name.startswith("preview_"):
            cycles.property_unset(name)


def set_bounces(cycles, bounces):
    cycles.max_bounces = bounces
    cycles.transparent_max_bounces = max(cycles.transparent_max_bounces, LAYERS)
    for lobe in ("diffuse", "glossy", "transmission"):
        setattr(cycles, lobe + "_bounces", bounces)


def _remove_bias(cycles):
    """Cycles' defaults that bias a bake."""
    cycles.blur_glossy = 0
    cycles.use_adaptive_sampling = False
    cycles.use_denoising = False  # 3.4 without OIDN bakes black with it on, and says FINISHED
    cycles.light_sampling_threshold = 0
    if bpy.app.version < (3, 5):
        cycles.sampling_pattern = "SOBOL"  # the default's samples repeat from texel to texel: a whole map errs one way
    for switch in ("use_fast_gi", "use_guiding"):
        set_if_there(cycles, switch, False)


def use_device(scene, device):
    """CPU, or one of Cycles' GPU back ends with every device of that kind."""
    if device == "CPU":
        scene.cycles.device = "CPU"
        return
    preferences = bpy.context.preferences.addons["cycles"].preferences
    try:
        preferences.compute_device_type = device
    except TypeError as error:
        raise Refusal(f"this Blender was built without {device}; use --device CPU", ENVIRONMENT) from error
    preferences.get_devices()
    usable = [d for d in preferences.devices if d.type == device]
    if not usable:
        raise Refusal(f"no {device} device was found; use --device CPU, or see rnmbake doctor", ENVIRONMENT)
    for entry in preferences.devices:
        entry.use = entry.type == device
    scene.cycles.device = "GPU"


def bake_diffuse(scene, target, clear=True):
    """Bake direct + indirect diffuse light of the active object into its active image. Units: E/pi."""
    _bake("DIFFUSE", scene, target, clear)


def bake_glossy(scene, target, clear=True):
    """... glossy light. Units: radiance, of a white perfect mirror. INDIRECT alone loses nearly all of it in 3.4."""
    _bake("GLOSSY", scene, target, clear)


def _bake(kind, scene, target, clear):
    view_layer = bpy.context.view_layer
    for other in view_layer.objects:
        other.select_set(False)
    target.select_set(True)
    view_layer.objects.active = target
    scene.render.bake.use_selected_to_active = False
    outcome = bpy.ops.object.bake(
        type=kind, pass_filter={"DIRECT", "INDIRECT"}, margin=0, use_clear=clear,
        target="IMAGE_TEXTURES", save_mode="INTERNAL")
    if outcome != {"FINISHED"}:
        raise Refusal(f"Blender cancelled the bake of '{target.name}'", object_name=target.name)


def samples_of_picture(scene, width, height, samples=None):
    """Samples of one picture, over all of its tiles, for task.progress: Cycles counts them tile by tile."""
    cycles = scene.cycles
    side = cycles.tile_size if cycles.use_auto_tile else max(width, height)
    return (samples or cycles.samples) * math.ceil(width / side) * math.ceil(height / side)


def new_float_image(name, width, height):
    image = bpy.data.images.new(name, width, height, alpha=True, float_buffer=True)
    image.colorspace_settings.name = "Non-Color"
    return image


def read_pixels(image):
    """RGBA, 32-bit float, bottom row first."""
    pixels = array("f", bytes(16 * image.size[0] * image.size[1]))
    image.pixels.foreach_get(pixels)
    return pixels


def save_pixels(image, path):
    write_pixels(read_pixels(image), path)


def write_pixels(pixels, path):
    """No header. The file appears when it is whole."""
    with open(path + ".part", "wb") as stream:
        pixels.tofile(stream)
    os.replace(path + ".part", path)
