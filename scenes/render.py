"""Renders an opened scene through its camera:

  blender -b --factory-startup -noaudio --python-exit-code 86 SCENE.blend --python scenes/render.py -- \\
      PICTURE.png [WIDTH HEIGHT SAMPLES]
"""

import os
import sys

import bpy

path, *numbers = sys.argv[sys.argv.index("--") + 1:]
width, height, samples = (int(n) for n in numbers or (640, 400, 256))
scene = bpy.context.scene
scene.render.resolution_x, scene.render.resolution_y = width, height
scene.render.resolution_percentage = 100
scene.cycles.samples = samples
scene.cycles.sample_clamp_indirect = 8.0  # for the eye only: a bake must not clamp
scene.render.image_settings.file_format = "PNG"
scene.render.image_settings.color_mode = "RGB"
scene.render.image_settings.compression = 100
scene.render.filepath = os.path.abspath(path)
bpy.ops.render.render(write_still=True)
