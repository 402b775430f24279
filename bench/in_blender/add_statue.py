"""Adds Suzanne to the opened scene, smooth and about as wide as a person's shoulders, and saves a copy.

Arguments: the .blend to write, width in units, turn about the vertical in degrees (0: it looks along -y), place (x,y,z)
that the camera is turned to as well, camera's place, the answer's path.
"""
import json
import math
import os
import sys

import bpy
from mathutils import Matrix, Vector

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../blender_scripts"))
sys.dont_write_bytecode = True

from scene_ops.plain_material import new_diffuse  # noqa: E402

ALBEDO = (0.6, 0.6, 0.6)
SUBDIVISIONS = 2


def numbers(text):
    return Vector(float(number) for number in text.split(","))


def add(width, turn, place):
    bpy.ops.mesh.primitive_monkey_add(location=(0, 0, 0))
    statue = bpy.context.object
    statue.name = "statue"
    smooth = statue.modifiers.new("smooth", "SUBSURF")
    smooth.levels = smooth.render_levels = SUBDIVISIONS
    bpy.ops.object.shade_smooth()
    statue.scale = [width / statue.dimensions.x] * 3
    statue.rotation_euler = (0, 0, math.radians(turn))
    bpy.ops.object.transform_apply(location=False, rotation=True, scale=True)
    statue.location = place
    statue.data.materials.append(new_diffuse("statue", ALBEDO))


def look_at(camera, place, target):
    camera.matrix_world = Matrix.Translation(place) @ (target - place).to_track_quat("-Z", "Y").to_matrix().to_4x4()


def main():
    out, width, turn, place, camera, answer = sys.argv[sys.argv.index("--") + 1:]
    add(float(width), float(turn), numbers(place))
    look_at(bpy.context.scene.camera, numbers(camera), numbers(place))
    bpy.context.scene.camera.data.lens = 50
    bpy.ops.wm.save_as_mainfile(filepath=out)
    with open(answer, "w", encoding="utf-8") as file:
        json.dump({"blender": bpy.app.version_string}, file)


main()
