"""What Blender itself bakes, with nothing of rnmbake's: one plain DIFFUSE bake of each named object.

    blender -b SCENE --python plain_bake.py -- OUT_FOLDER SIZE SAMPLES BOUNCES OBJECT...

Writes OUT_FOLDER/<n>.f32 for the n-th object: RGBA floats, bottom row first, of its layer "Lightmap".
"""
import os
import sys
from array import array

import bpy


def main(folder, size, samples, bounces, *names):
    scene = bpy.context.scene
    prepare(scene, int(samples), int(bounces))
    for number, name in enumerate(names):
        pixels = bake(scene, bpy.data.objects[name], int(size))
        with open(os.path.join(folder, f"{number}.f32"), "wb") as stream:
            pixels.tofile(stream)


def prepare(scene, samples, bounces):
    scene.render.engine = "CYCLES"
    cycles = scene.cycles
    cycles.samples, cycles.seed = samples, 7
    cycles.max_bounces = cycles.diffuse_bounces = cycles.glossy_bounces = bounces
    cycles.sample_clamp_indirect = cycles.sample_clamp_direct = 0
    cycles.blur_glossy = cycles.light_sampling_threshold = 0
    cycles.use_adaptive_sampling = cycles.use_denoising = False


def bake(scene, ob, size):
    image = bpy.data.images.new("plain", size, size, alpha=True, float_buffer=True)
    image.colorspace_settings.name = "Non-Color"
    for slot in ob.material_slots:
        nodes = slot.material.node_tree.nodes
        nodes.active = nodes.new("ShaderNodeTexImage")
        nodes.active.image = image
    ob.data.uv_layers.active = ob.data.uv_layers["Lightmap"]
    for other in bpy.context.view_layer.objects:
        other.select_set(other == ob)
    bpy.context.view_layer.objects.active = ob
    bpy.ops.object.bake(type="DIFFUSE", pass_filter={"DIRECT", "INDIRECT"}, margin=0, use_clear=True)
    pixels = array("f", bytes(16 * size * size))
    image.pixels.foreach_get(pixels)
    return pixels


main(*sys.argv[sys.argv.index("--") + 1:])
