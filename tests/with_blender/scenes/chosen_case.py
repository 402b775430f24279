"""blender -b --factory-startup --python chosen_case.py -- OUT.blend: two scenes, two view layers, a sun that brightens.

"First" holds the floor "a" and is what the file is saved with. "Second" holds the floor "b", and "c" high above, which the layer
"Less" leaves out; its sun shines straight down, with strength F at frame F.
"""
import os
import sys

import bpy

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

from squares import empty_dark_scene, mesh_of  # noqa: E402


def floor(name, collection, height):
    square = [(0, 0, height), (1, 0, height), (1, 1, height), (0, 1, height)]
    collection.objects.link(bpy.data.objects.new(name, mesh_of(name, [square])))


def sun(scene):
    light = bpy.data.lights.new("sun", "SUN")
    light.angle = 0
    for frame in (1, 101):
        light.energy = frame
        light.keyframe_insert("energy", frame=frame)
    action = light.animation_data.action
    curves = action.fcurves if hasattr(action, "fcurves") else action.layers[0].strips[0].channelbags[0].fcurves
    for point in curves[0].keyframe_points:
        point.interpolation = "LINEAR"
    scene.collection.objects.link(bpy.data.objects.new("sun", light))


def main(path):
    empty_dark_scene()
    first = bpy.context.scene
    first.name = "First"
    floor("a", first.collection, 0)
    sun(first)
    second = bpy.data.scenes.new("Second")
    second.world = first.world
    floor("b", second.collection, 0)
    sun(second)
    above = bpy.data.collections.new("above")
    floor("c", above, 5)
    second.collection.children.link(above)
    second.view_layers[0].name = "All"
    less = second.view_layers.new("Less")
    for layer in second.view_layers:
        layer.layer_collection.children["above"].exclude = layer == less
    bpy.ops.wm.save_as_mainfile(filepath=path)


main(sys.argv[sys.argv.index("--") + 1])
