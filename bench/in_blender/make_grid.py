"""A lit scene with one quad ("small") and one grid of a given number of triangles ("grid").

    blender -b --factory-startup --python make_grid.py -- TRIANGLES OUTPUT.blend
"""
import sys
from array import array

import bpy


def grid_mesh(name, cells):
    """A square of cells x cells quads, one UV layer that covers the unit square."""
    side = cells + 1
    points = array("f")
    for row in range(side):
        for column in range(side):
            points.extend((column / cells, row / cells, 0.0))
    corners = array("i")
    for row in range(cells):
        for column in range(cells):
            first = row * side + column
            corners.extend((first, first + 1, first + side + 1, first + side))
    mesh = bpy.data.meshes.new(name)
    mesh.vertices.add(side * side)
    mesh.loops.add(len(corners))
    mesh.polygons.add(cells * cells)
    mesh.vertices.foreach_set("co", points)
    mesh.loops.foreach_set("vertex_index", corners)
    mesh.polygons.foreach_set("loop_start", array("i", range(0, len(corners), 4)))
    if bpy.app.version < (4, 0):
        mesh.polygons.foreach_set("loop_total", array("i", [4]) * (cells * cells))
    uvs = array("f")
    for vertex in corners:
        uvs.extend(points[3 * vertex:3 * vertex + 2])
    mesh.uv_layers.new(name="Lightmap")
    mesh.uv_layers[0].data.foreach_set("uv", uvs)
    mesh.update()
    return mesh


def add(name, cells, height):
    ob = bpy.data.objects.new(name, grid_mesh(name, cells))
    ob.location.z = height
    bpy.context.scene.collection.objects.link(ob)


triangles, output = sys.argv[sys.argv.index("--") + 1:]
bpy.ops.wm.read_factory_settings(use_empty=True)
add("small", 1, 1.0)
add("grid", round((int(triangles) / 2) ** 0.5), 0.0)
world = bpy.data.worlds.new("sky")
bpy.context.scene.world = world
world.use_nodes = True
bpy.ops.wm.save_as_mainfile(filepath=output)
