"""A sandstone cave: one large concave object that lights itself, with a hole in its roof and a mouth at its end."""

import math

import bmesh
import bpy
from mathutils import Vector, noise

import kit

HALF = Vector((4.0, 8.0, 3.6))
SKYLIGHTS = ((Vector((0.05, 0.3, 1.0)).normalized(), 0.3), (Vector((-0.5, 0.86, 0.2)).normalized(), 0.2))
FLOOR = -2.1


def _fbm(p, octaves=4):
    return sum(noise.noise(p * 2.0**i + Vector((17.3, 5.1, 9.7)) * i) / 2.0**i for i in range(octaves))


def _wall(unit):
    """Where the cave's wall lies in the direction `unit`: an ellipsoid, bent, pocketed and layered."""
    p = Vector(a * b for a, b in zip(unit, HALF))
    pockets = 0.5 * _fbm(p * 0.3) + 0.24 * _fbm(p * 0.8 + Vector((40, 0, 0)), 3)
    flow = p.z + 0.55 * noise.noise(p * 0.35) + 0.18 * p.y * 0.5
    layers = 0.06 * math.sin(flow * 4.6) + 0.03 * math.sin(flow * 11.0 + 2.0)
    p = p * (max(0.78, 1.0 + pockets) + layers)
    p.x += 1.0 * math.sin(p.y * 0.42)
    if p.z < FLOOR:  # sand covers what lies below
        depth = FLOOR - p.z
        p.z = FLOOR - 0.28 * math.tanh(depth) + 0.08 * noise.noise(Vector((p.x, p.y, 0)) * 0.8)
    return p


def _opening(unit):
    return any(unit.angle(axis) < half + 0.07 * noise.noise(unit * 5.0) for axis, half in SKYLIGHTS)


def _mesh(detail):
    """The mesh and, for each vertex, the direction from the middle that it lies in."""
    mesh = bpy.data.meshes.new("cave")
    solid = bmesh.new()
    bmesh.ops.create_icosphere(solid, subdivisions=detail, radius=1.0)
    gone = [v for v in solid.verts if _opening(v.co.normalized())]
    bmesh.ops.delete(solid, geom=gone, context="VERTS")
    units = [vertex.co.normalized() for vertex in solid.verts]
    for vertex, unit in zip(solid.verts, units):
        vertex.co = _wall(unit)
    bmesh.ops.reverse_faces(solid, faces=solid.faces)  # the rock is outside
    for face in solid.faces:
        face.smooth = True
    solid.to_mesh(mesh)
    solid.free()
    return mesh, units


def _detail_uv(mesh):
    """Each face projected along its main axis, one texture repeat for each metre."""
    corners = []
    for face in mesh.polygons:
        axis = max(range(3), key=lambda i: abs(face.normal[i]))
        u, v = [i for i in range(3) if i != axis]
        for vertex in face.vertices:
            co = mesh.vertices[vertex].co
            corners.append((co[u] * (1 if face.normal[axis] * (-1 if axis == 1 else 1) > 0 else -1), co[v]))
    kit.add_uv(mesh, kit.DETAIL_UV, corners)


def _lightmap_uv(mesh, units):
    """Six charts, the sides of a cube about the middle: each ray from there meets the wall once, so none overlap.

    `units`: for each vertex, the direction it was pushed out along.
    """
    sides = {}
    for face in mesh.polygons:
        middle = sum((units[v] for v in face.vertices), Vector())
        axis = max(range(3), key=lambda i: abs(middle[i]))
        sides.setdefault((axis, middle[axis] > 0), []).append(face)

    charts = []
    for (axis, positive), faces in sides.items():
        u, v = (axis + 1) % 3, (axis + 2) % 3

        def flat(unit):  # angles instead of tangents keep the texels' sizes closer to each other
            side = math.atan2(unit[u], abs(unit[axis]))
            return (-side if positive else side, math.atan2(unit[v], abs(unit[axis])))

        corners = [[flat(units[i]) for i in face.vertices] for face in faces]
        low = [min(uv[k] for face in corners for uv in face) for k in (0, 1)]
        high = [max(uv[k] for face in corners for uv in face) for k in (0, 1)]
        charts.append(((HALF[u], HALF[v]), faces, corners, low, high))

    layer = [None] * len(mesh.loops)
    places = kit.pack([size for size, *_ in charts], 0.006)
    for (_, faces, corners, low, high), (x, y, *extent) in zip(charts, places):
        for face, uvs in zip(faces, corners):
            for loop, uv in zip(face.loop_indices, uvs):
                share = [(uv[k] - low[k]) / (high[k] - low[k]) * extent[k] for k in (0, 1)]
                layer[loop] = (x + share[0], y + share[1])
    kit.add_uv(mesh, kit.LIGHTMAP_UV, layer)
    kit.activate_uv(mesh)


def _sandstone(albedo):
    """Warped layers that follow the height; the red channel reflects about `albedo`."""
    material = kit.diffuse("sandstone", (albedo,) * 3)
    tree = material.node_tree
    surface = next(node for node in tree.nodes if node.type == "BSDF_DIFFUSE")
    where = tree.nodes.new("ShaderNodeNewGeometry")
    bands = tree.nodes.new("ShaderNodeTexWave")
    bands.wave_type, bands.bands_direction = "BANDS", "Z"
    for name, value in (("Scale", 0.42), ("Distortion", 5.5), ("Detail", 3.0), ("Detail Scale", 0.45)):
        bands.inputs[name].default_value = value
    ramp = tree.nodes.new("ShaderNodeValToRGB")
    stops = ((0.0, (0.72, 0.46, 0.33)), (0.3, (0.86, 0.68, 0.48)), (0.5, (0.7, 0.42, 0.33)),
             (0.75, (0.88, 0.74, 0.56)), (1.0, (0.68, 0.46, 0.42)))
    while len(ramp.color_ramp.elements) < len(stops):
        ramp.color_ramp.elements.new(0.5)
    for element, (position, color) in zip(ramp.color_ramp.elements, stops):
        element.position = position
        element.color = kit.rgba([channel * albedo / 0.7 for channel in color])
    tree.links.new(where.outputs["Position"], bands.inputs["Vector"])
    tree.links.new(bands.outputs["Fac"] if "Fac" in bands.outputs else bands.outputs["Factor"], ramp.inputs[0])
    tree.links.new(ramp.outputs["Color"], surface.inputs["Color"])
    return material


def build(detail=6, albedo=0.7):
    kit.start(exposure=0.15, look="Medium High Contrast")
    mesh, units = _mesh(detail)
    _detail_uv(mesh)
    _lightmap_uv(mesh, units)
    kit.add_object("cave", mesh, [_sandstone(albedo)])
    kit.sun((-0.2, -0.02, 1.0), 11.0, (1.0, 0.87, 0.68), size=0.5)
    kit.world((0.4, 0.62, 1.0), 4.0)
    kit.camera((-0.7, -5.0, -0.9), (0.75, 2.0, -0.1), lens=22)
