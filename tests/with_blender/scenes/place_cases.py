"""blender -b --factory-startup --python place_cases.py -- grazing|places FILE

grazing: upright walls under suns and lamps that run along them, or nearly so.
places: a floor with a post on it under a slanted sun, the same near the origin, far from it, small and large.
"""
import math
import os
import sys

import bpy

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

import squares  # noqa: E402

# Radians between a wall's plane and the red sun, which shines straight down; positive: above the wall.
TILTS = (0, 1e-7, -1e-7, 1e-5, -1e-5, 1e-4, -1e-4, 1e-3, -1e-3, 1e-2, -1e-2)
PLACES = {"here": ((0, 10, 0), 1), "km": ((1000, 700, 300), 1), "5km": ((-5000, 3500, 1500), 1),
          "100km": ((1e5, 7e4, 3e4), 1), "tiny": ((0, 0, 0), 1e-4), "huge": ((0, -3e5, 0), 1e4)}


def black():
    found = bpy.data.materials.get("black")
    if found is None:
        found = bpy.data.materials.new("black")
        found.use_nodes = True
        nodes = found.node_tree.nodes
        nodes.clear()
        shader = nodes.new("ShaderNodeBsdfDiffuse")
        shader.inputs["Color"].default_value = (0, 0, 0, 1)
        found.node_tree.links.new(shader.outputs[0], nodes.new("ShaderNodeOutputMaterial").inputs["Surface"])
    return found


def add(name, quads, place=(0, 0, 0), turn=(0, 0, 0), scale=1):
    mesh = squares.mesh_of(name, quads)
    mesh.materials.append(black())
    ob = bpy.data.objects.new(name, mesh)
    ob.location, ob.rotation_euler, ob.scale = place, turn, (scale,) * 3
    bpy.context.scene.collection.objects.link(ob)


def lamp(kind, color, energy, place=(0, 0, 0), turn=(0, 0, 0), **sizes):
    data = bpy.data.lights.new(kind, kind)
    data.color, data.energy = color, energy
    for name, value in sizes.items():
        setattr(data, name, value)
    ob = bpy.data.objects.new(kind, data)
    ob.location, ob.rotation_euler = place, turn
    bpy.context.scene.collection.objects.link(ob)


def upright(width=1, height=1, columns=1):
    """A wall that faces +x, u along +y, in strips that share no vertices."""
    step = width / columns
    return [((0, i * step, 0), (0, (i + 1) * step, 0), (0, (i + 1) * step, height), (0, i * step, height))
            for i in range(columns)]


def grid(count):
    """The wall as one mesh whose vertices are shared."""
    mesh = bpy.data.meshes.new("grid")
    side = count + 1
    mesh.from_pydata([(0, y / count, z / count) for z in range(side) for y in range(side)], [],
                     [(z * side + y, z * side + y + 1, (z + 1) * side + y + 1, (z + 1) * side + y)
                      for z in range(count) for y in range(count)])
    layer = mesh.uv_layers.new(name="Lightmap")
    for loop in mesh.loops:
        layer.data[loop.index].uv = mesh.vertices[loop.vertex_index].co.yz
    mesh.materials.append(black())
    return mesh


def box_sides(half, height):
    ring = [(half, -half), (half, half), (-half, half), (-half, -half)]
    return [((*ring[i], 0), (*ring[(i + 1) % 4], 0), (*ring[(i + 1) % 4], height), (*ring[i], height))
            for i in range(4)]


def grazing():
    for number, tilt in enumerate(TILTS):  # a turn about y raises the face
        add(f"wall{number}", upright(), (0, 3 * number, 0), (0, -tilt, 0))
    add("strips", upright(columns=4), (0, -3, 0))
    add("turned", upright(), (0, -6, 0), (0, 0, 0.65))
    add("far", upright(), (1000, 700, 300), (0, 0, 0.65))
    ob = bpy.data.objects.new("grid", grid(4))
    ob.location = (0, -9, 0)
    bpy.context.scene.collection.objects.link(ob)
    add("box", [*box_sides(0.5, 1), ((-.5, -.5, 1), (.5, -.5, 1), (.5, .5, 1), (-.5, .5, 1))], (0, -12, 0))
    add("shadowless", upright(), (0, -15, 0), (0, 0.5, 0))  # its back to the sun
    bpy.data.objects["shadowless"].visible_shadow = False
    lamp("SUN", (1, 0, 0), math.pi, angle=0)
    lamp("SUN", (0, 1, 0), math.pi, angle=0.02)  # half of it is above a wall
    lamp("POINT", (0, 0, 1), 4 * math.pi ** 2 * 4, (0, 0.5, 3), shadow_soft_size=0)  # in the plane of most walls


def places():
    for name, (place, scale) in PLACES.items():
        add("floor " + name, [((-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0))], place, scale=scale)
        add("post " + name, [*box_sides(0.2, 0.5), ((-.2, -.2, .5), (.2, -.2, .5), (.2, .2, .5), (-.2, .2, .5))],
            place, scale=scale)
    lamp("SUN", (1, 1, 1), math.pi, turn=(0.3, math.radians(45), 0), angle=0)


what, path = sys.argv[sys.argv.index("--") + 1:]
squares.empty_dark_scene()
{"grazing": grazing, "places": places}[what]()
bpy.ops.wm.save_as_mainfile(filepath=path)
