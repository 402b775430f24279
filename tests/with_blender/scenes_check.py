"""Checks the built scenes: run by a headless Blender,

  blender -b --factory-startup -noaudio --python-exit-code 86 --python tests/with_blender/scenes_check.py -- scenes/built

Every scene must be there, with the objects and UV layers that its project file and its README promise. Exits 1 and
names the scene, the object and what is wrong.
"""

import math
import os
import sys

import bpy
from mathutils import Vector

# scene -> meshes in it, most triangles that one of them may have; `attic` is in disorder on purpose (attic_check.py)
EXPECTED = {
    "plane_sun": (1, 2), "plane_sky": (1, 2), "plane_lamp": (2, 2), "furnace": (1, 12),
    "suns": (7 * 4 + 5 * 2 * 4, 2), "smooth_box": (1, 12), "smooth_cylinder": (1, 28),
    "cornell": (9, 4000), "hall": (40, 4000), "cave": (1, 25000), "panels": (13, 4000),
    "cobbles": (4, 4000), "two_rooms": (6, 4000), "dungeon": (150, 4000),
}
RASTER = 128


def all_finite(values):
    return all(math.isfinite(value) for value in values)


def area_of_charts(mesh, layer):
    """Sum of the triangles' areas in UV space, each as a positive number."""
    mesh.calc_loop_triangles()
    total = 0.0
    for triangle in mesh.loop_triangles:
        (ax, ay), (bx, by), (cx, cy) = (layer.data[loop].uv for loop in triangle.loops)
        total += abs((bx - ax) * (cy - ay) - (cx - ax) * (by - ay)) / 2
    return total


def overlapping_texels(mesh, layer):
    """Texels of a RASTER x RASTER lightmap whose centre lies well inside more than one triangle."""
    seen, twice = {}, 0
    for triangle in mesh.loop_triangles:
        (ax, ay), (bx, by), (cx, cy) = (layer.data[loop].uv * RASTER for loop in triangle.loops)
        double_area = (bx - ax) * (cy - ay) - (cx - ax) * (by - ay)
        if abs(double_area) < 1e-9:
            continue
        for y in range(math.floor(min(ay, by, cy)), math.ceil(max(ay, by, cy))):
            for x in range(math.floor(min(ax, bx, cx)), math.ceil(max(ax, bx, cx))):
                px, py = x + 0.5, y + 0.5
                b = ((px - ax) * (cy - ay) - (cx - ax) * (py - ay)) / double_area
                c = ((bx - ax) * (py - ay) - (px - ax) * (by - ay)) / double_area
                if min(b, c, 1 - b - c) > 1e-3:
                    twice += (x, y) in seen
                    seen[x, y] = True
    return twice


def faults_of_mesh(thing):
    mesh = thing.data
    names = [layer.name for layer in mesh.uv_layers]
    if names != ["UVMap", "Lightmap"]:
        yield f"UV layers are {names}"
        return
    if not mesh.uv_layers["UVMap"].active_render:
        yield "UVMap is not the layer that textures use"
    if not all_finite(value for vertex in mesh.vertices for value in vertex.co):
        yield "a position is not finite"
    for layer in mesh.uv_layers:
        if not all_finite(value for loop in layer.data for value in loop.uv):
            yield f"a UV of {layer.name} is not finite"
    lightmap = mesh.uv_layers["Lightmap"]
    if not all(-1e-5 <= value <= 1 + 1e-5 for loop in lightmap.data for value in loop.uv):
        yield "Lightmap leaves [0,1]"
    covered = area_of_charts(mesh, lightmap)
    if not 0.2 < covered < 1.00001:
        yield f"Lightmap covers {covered:.3f} of the square"
    if twice := overlapping_texels(mesh, lightmap):
        yield f"{twice} texels of Lightmap lie in two triangles"
    if not mesh.materials or None in mesh.materials[:]:
        yield "a material slot is empty"


def faults_of_scene(name, folder):
    path = os.path.join(folder, name + ".blend")
    if not os.path.isfile(path):
        yield f"{path} is missing: run ./dev scenes"
        return
    bpy.ops.wm.open_mainfile(filepath=path)
    things = [thing for thing in bpy.context.scene.objects if thing.type == "MESH"]
    count, most = EXPECTED[name]
    if len(things) != count:
        yield f"{len(things)} meshes, expected {count}"
    if bpy.context.scene.camera is None:
        yield "no camera"
    if bpy.context.scene.render.engine != "CYCLES":
        yield "not set to Cycles"
    for thing in things:
        for fault in faults_of_mesh(thing):
            yield f"{thing.name}: {fault}"
        triangles = len(thing.data.loop_triangles)
        if triangles > most:
            yield f"{thing.name}: {triangles} triangles, expected {most} at most"
    for image in bpy.data.images:
        if image.packed_file is None:
            yield f"picture {image.name} is not packed"


def faults_of_suns(folder):
    """The sun must stand where each plane's name says, in the frame that its UVs and its matrix give."""
    bpy.ops.wm.open_mainfile(filepath=os.path.join(folder, "suns.blend"))
    lamp = next(thing for thing in bpy.context.scene.objects if thing.type == "LIGHT")
    to_sun = lamp.matrix_world.to_3x3() @ Vector((0, 0, 1))
    for thing in bpy.context.scene.objects:
        if thing.type != "MESH":
            continue
        angle, azimuth = (math.radians(float(text)) for text in thing.name.split("_")[-2:])
        expected = (math.sin(angle) * math.cos(azimuth), math.sin(angle) * math.sin(azimuth), math.cos(angle))
        place, uv = thing.data.vertices, thing.data.uv_layers["UVMap"].data
        a, b, _, d = thing.data.polygons[0].vertices  # the quad's first edge runs along u, its last along v
        matrix = thing.matrix_world.to_3x3()
        backwards = -1 if uv[1].uv.x < uv[0].uv.x else 1
        tangent = (matrix @ (place[b].co - place[a].co)).normalized() * backwards
        bitangent = (matrix @ (place[d].co - place[a].co)).normalized()
        normal = (matrix.inverted().transposed() @ thing.data.polygons[0].normal).normalized()
        for axis, wanted in zip((tangent, bitangent, normal), expected):
            if abs(axis.dot(to_sun) - wanted) > 2e-5:
                yield f"suns: {thing.name}: the sun stands at {axis.dot(to_sun):.6f} instead of {wanted:.6f}"


def main(folder):
    faults = [f"{name}: {fault}" for name in EXPECTED for fault in faults_of_scene(name, folder)]
    faults = faults or list(faults_of_suns(folder))
    for fault in faults:
        print("scenes_check:", fault, file=sys.stderr)
    if faults:
        raise SystemExit(1)
    print(f"scenes_check: {len(EXPECTED)} scenes are as promised")


main(sys.argv[sys.argv.index("--") + 1])
