"""Low-poly solids shaded smooth: their normals stand far off their faces (54.7 degrees at a cube's corner).

So some basis normals fall below the horizon of the face they belong to. Each texel's right answer is a formula:
`light=sun`: max(0, D . b) x strength / pi where the FACE looks towards the sun, else 0;
`light=sky`: the clipped cosine of b over the face's hemisphere, which is (1 + b . face normal) / 2.
Nothing else is in the scene and both solids are convex, so no other light arrives.
"""

import math

import kit


def _light(light, angle, azimuth, strength):
    if light == "sun":
        kit.sun(kit.direction(angle, azimuth), strength)
        kit.world()
    elif light == "sky":
        kit.world((1, 1, 1), 1.0)
    else:
        raise SystemExit(f"light is '{light}'; take sun or sky")
    kit.camera((3, -5, 3), (0, 0, 0))


def _weld(builder):
    """Faces share the vertices that lie in one place, so that their normals blend."""
    index, vertices, moved = {}, [], []
    for vertex in builder.vertices:
        key = tuple(round(value, 5) for value in vertex)
        if key not in index:
            index[key] = len(vertices)
            vertices.append(vertex)
        moved.append(index[key])
    builder.vertices = vertices
    builder.faces = [[moved[i] for i in face] for face in builder.faces]
    builder.smooth = [True] * len(builder.faces)


def box(light="sun", angle=35.0, azimuth=25.0, strength=math.pi):
    kit.start()
    builder = kit.Builder(tile=2.0)
    builder.box((-1, -1, -1), (1, 1, 1))
    _weld(builder)
    builder.object("smooth_box", [kit.diffuse("white", (0.8, 0.8, 0.8))])
    _light(light, angle, azimuth, strength)


def cylinder(sides=8, light="sun", angle=35.0, azimuth=25.0, strength=math.pi):
    kit.start()
    builder = kit.Builder(tile=2.0)
    builder.lathe([(1, -1), (1, 1)], sides)
    for height, turn in ((-1, -1), (1, 1)):
        _cap(builder, sides, height, turn)
    _weld(builder)
    builder.object("smooth_cylinder", [kit.diffuse("white", (0.8, 0.8, 0.8))])
    _light(light, angle, azimuth, strength)


def _cap(builder, sides, height, turn):
    """A polygon of `sides` corners that faces up (turn 1) or down (turn -1), with a chart of its own."""
    chart = kit.Chart(2, 2)
    chart.first_face = len(builder.faces)
    corners = []
    base = len(builder.vertices)
    for side in range(sides):
        angle = 2 * math.pi * side / sides
        x, y = math.cos(angle), math.sin(angle)
        builder.vertices.append(kit.Vector((x, turn * y, height)))
        corners.append((0.5 + x / 2, 0.5 + y / 2))
    builder.faces.append(list(range(base, base + sides)))
    chart.corners.append(corners)
    builder.detail.append(corners)
    builder.slots.append(0)
    builder.smooth.append(True)
    builder.charts.append(chart)
