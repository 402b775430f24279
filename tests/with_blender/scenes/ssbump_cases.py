"""blender -b --factory-startup --python ssbump_cases.py -- FOLDER: a low quad and the detail to put on it.

detail.blend, .glb and .obj hold a floor with a long wall beside the quad, low.* the quad alone; both.blend holds the
two together, each once more mirrored, and an unwrapped, an overlapping and a far-off quad besides.
"""
import os
import sys

import bpy

SIDE = 1.0  # half of the quad's
FLOOR = 50.0
FAR = 1e5  # of the wall: rays that pass beside it count for less than 1e-4


def fresh():
    bpy.ops.wm.read_factory_settings(use_empty=True)


def add(name, corners, faces, uvs=None, location=(0, 0, 0)):
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(corners, [], faces)
    if uvs:
        layer = mesh.uv_layers.new(name="UVMap")
        for loop, uv in zip(layer.data, uvs):
            loop.uv = uv
    mesh.update()
    ob = bpy.data.objects.new(name, mesh)
    ob.location = location
    bpy.context.scene.collection.objects.link(ob)
    return ob


SQUARE = [(-SIDE, -SIDE, 0), (SIDE, -SIDE, 0), (SIDE, SIDE, 0), (-SIDE, SIDE, 0)]
WHOLE = [(0, 0), (1, 0), (1, 1), (0, 1)]


def add_low(name="low"):
    return add(name, SQUARE, [(0, 1, 2, 3)], WHOLE)


def add_detail(name="detail"):
    """The wall stands at x = 2 and hides whatever lies towards +x."""
    floor = [(-FLOOR, -FLOOR, 0), (FLOOR, -FLOOR, 0), (FLOOR, FLOOR, 0), (-FLOOR, FLOOR, 0)]
    wall = [(2, FAR, -1), (2, -FAR, -1), (2, -FAR, FAR), (2, FAR, FAR)]
    return add(name, floor + wall, [(0, 1, 2, 3), (4, 5, 6, 7)])


def save(folder, name):
    path = os.path.join(folder, name)
    bpy.ops.wm.save_as_mainfile(filepath=path + ".blend", relative_remap=False)
    try:
        import numpy  # the glTF exporter needs it
        for old in ("bool", "object"):
            if old not in numpy.__dict__:
                setattr(numpy, old, getattr(__import__("builtins"), old))
        bpy.ops.export_scene.gltf(filepath=path + ".glb")
    except ImportError:
        pass
    bpy.ops.wm.obj_export(filepath=path + ".obj")


def main(folder):
    fresh()
    add_detail()
    save(folder, "detail")
    fresh()
    add_low()
    save(folder, "low")

    fresh()
    add_detail()
    add_low()
    add_detail("turned").scale = (1, -1, 1)
    add_low("mirrored").scale = (-1, 1, 1)
    add("bare", SQUARE, [(0, 1, 2, 3)])
    add("twice", SQUARE + [(x + 4, y, z) for x, y, z in SQUARE], [(0, 1, 2, 3), (4, 5, 6, 7)], WHOLE + WHOLE)
    add("far", SQUARE, [(0, 1, 2, 3)], WHOLE, location=(0, 0, 50))
    bpy.ops.wm.save_as_mainfile(filepath=os.path.join(folder, "both.blend"), relative_remap=False)


main(sys.argv[sys.argv.index("--") + 1])
