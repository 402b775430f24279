"""The pictures of the documentation: Cycles, then a filter of our own, because not every build has a denoiser.

  blender -b --factory-startup -noaudio --python-exit-code 86 SCENE.blend --python scenes/render.py -- \\
      passes FOLDER [WIDTH HEIGHT SAMPLES]
  blender -b ... SCENE.blend --python scenes/render.py -- picture FOLDER PICTURE.png

The filter is an edge-avoiding wavelet transform (Dammertz and others, 2010) of the picture divided by its albedo,
guided by normal, depth and brightness. Needs numpy and a Blender before 5.0; nothing else here does.
"""

import os
import sys

import bpy
import numpy as np

PASSES = {"color": "Image", "albedo": "Denoising Albedo", "normal": "Denoising Normal", "depth": "Denoising Depth"}


def render_passes(folder, width=640, height=400, samples=128):
    scene = bpy.context.scene
    scene.render.resolution_x, scene.render.resolution_y = width, height
    scene.render.resolution_percentage = 100
    scene.cycles.samples = samples
    scene.cycles.sample_clamp_indirect = 8.0  # for the eye only: a bake must not clamp
    scene.view_layers[0].cycles.denoising_store_passes = True
    scene.use_nodes = True
    nodes, links = scene.node_tree.nodes, scene.node_tree.links
    nodes.clear()
    source = nodes.new("CompositorNodeRLayers")
    output = nodes.new("CompositorNodeOutputFile")
    output.base_path = os.path.abspath(folder)
    output.format.file_format = "OPEN_EXR"
    output.format.color_depth = "32"
    output.file_slots.clear()
    for name, socket in PASSES.items():
        output.file_slots.new(name + "_")
        links.new(source.outputs[socket], output.inputs[name + "_"])
    bpy.ops.render.render()


def load(folder, name):
    """Rows x columns x 3, bottom row first, linear."""
    file = next(f for f in sorted(os.listdir(folder)) if f.startswith(name + "_") and f.endswith(".exr"))
    image = bpy.data.images.load(os.path.join(os.path.abspath(folder), file))
    image.colorspace_settings.name = "Non-Color"
    pixels = np.empty(len(image.pixels), dtype=np.float32)
    image.pixels.foreach_get(pixels)
    return pixels.reshape(image.size[1], image.size[0], 4)[:, :, :3]


def shifted(values, dy, dx):
    """values[y + dy, x + dx], the border repeated."""
    rows = np.clip(np.arange(values.shape[0]) + dy, 0, values.shape[0] - 1)
    columns = np.clip(np.arange(values.shape[1]) + dx, 0, values.shape[1] - 1)
    return values[rows][:, columns]


def brightness(light):
    return np.log(light.mean(axis=2) + 0.02)


def wavelet_level(light, normal, depth, reach, contrast):
    """One pass of a 5 x 5 kernel with holes of `reach` texels."""
    kernel = np.array([1, 4, 6, 4, 1]) / 16.0
    guide = sum(brightness(shifted(light, dy, dx)) for dy in (-1, 0, 1) for dx in (-1, 0, 1)) / 9
    total, weights = np.zeros_like(light), np.zeros(light.shape[:2])
    for j in range(5):
        for i in range(5):
            move = ((j - 2) * reach, (i - 2) * reach)
            turn = ((shifted(normal, *move) - normal) ** 2).sum(axis=2)
            away = np.abs(shifted(depth, *move) - depth) / (0.02 * reach * depth + 1e-3)
            step = (shifted(guide, *move) - guide) / contrast
            weight = kernel[j] * kernel[i] * np.exp(-turn / 0.05 - away - step * step)
            total += shifted(light, *move) * weight[:, :, None]
            weights += weight
    return total / weights[:, :, None]


def filtered(color, albedo, normal, depth):
    albedo = np.where(albedo.max(axis=2, keepdims=True) > 0.01, albedo, 1.0) + 0.01
    light = color / albedo
    for level in range(4):
        light = wavelet_level(light, normal, depth, 2**level, 0.5 / (1 + 0.6 * level))
    return light * albedo


def write_picture(folder, path):
    color, albedo, normal, depth = (load(folder, name) for name in PASSES)
    clean = filtered(color, albedo, normal, np.minimum(depth[:, :, 0], 1e4))
    image = bpy.data.images.new("picture", color.shape[1], color.shape[0], alpha=False, float_buffer=True)
    opaque = np.concatenate([clean, np.ones(clean.shape[:2] + (1,))], axis=2).astype(np.float32)
    image.pixels.foreach_set(opaque.ravel())
    settings = bpy.context.scene.render.image_settings
    settings.file_format, settings.color_mode, settings.compression = "PNG", "RGB", 100
    image.save_render(os.path.abspath(path), scene=bpy.context.scene)


command, folder, *rest = sys.argv[sys.argv.index("--") + 1:]
if command == "passes":
    render_passes(folder, *(int(number) for number in rest))
else:
    write_picture(folder, *rest)
