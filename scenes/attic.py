"""What other people's files are like: an attic full of small things that were never meant for a lightmap.

Hundreds of objects, few of them in order: meshes without UVs, with one layer or with three; splinters a hundred times
longer than wide; faces and whole meshes without area; modifiers that make faces; curves, texts, shared meshes, two
kinds of instances; names longer than Blender keeps; pictures that lie beside the file, found by relative paths. What
is wrong with an object is the first word of its name, so that tests know what to expect of it.
"""

import math
import random

import bpy
from mathutils import Matrix, Vector

import kit
import patterns

WIDTH, LENGTH, EAVES, RIDGE = 4.0, 8.0, 0.6, 2.9  # half width; heights above the floor
LONG = "crate with a name that somebody wrote in full and that no file system would mind "


# ---- materials -----------------------------------------------------------------------------------


def _textured(name, pattern, uv_map=""):
    """A Lambertian material whose colour is a picture beside the .blend; `uv_map` "": the layer for rendering."""
    material = bpy.data.materials.new(name)
    nodes = kit.Nodes(material)
    texture = nodes.add("ShaderNodeTexImage")
    texture.image = kit.picture_beside("attic", name, patterns.SIZE, pattern.colors)
    surface = nodes.add("ShaderNodeBsdfDiffuse", Roughness=0.0)
    if uv_map:
        where = nodes.add("ShaderNodeUVMap")
        where.uv_map = uv_map
        nodes.wire(where, "UV", texture, "Vector")
    nodes.wire(texture, "Color", surface, "Color")
    nodes.wire(surface, "BSDF", nodes.add("ShaderNodeOutputMaterial"), "Surface")
    return material


# ---- meshes without order ------------------------------------------------------------------------


def _mesh_object(name, vertices, faces, material, layers=(), place=(0, 0, 0), edges=()):
    """`layers`: names of UV layers; each corner gets its x and y, or x and z where the face stands upright."""
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata([tuple(v) for v in vertices], list(edges), faces)
    for layer in layers:
        uvs = mesh.uv_layers.new(name=layer)
        for loop in mesh.loops:
            x, y, z = mesh.vertices[loop.vertex_index].co
            uvs.data[loop.index].uv = (x + 0.5, y + z + 0.5)
    thing = kit.add_object(name, mesh, [material] if material else [])
    thing.location = place
    return thing


def _box(size):
    """Vertices and faces of a box that stands on z = 0."""
    x, y, z = (0.5 * side for side in size)
    vertices = [(sx * x, sy * y, z + sz * z) for sz in (-1, 1) for sy in (-1, 1) for sx in (-1, 1)]
    faces = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
    return vertices, faces


def _splinter(rng):
    """A board broken lengthwise: long triangles, the thinnest half a millimetre wide."""
    length, width = rng.uniform(0.8, 1.6), 10 ** rng.uniform(-3.3, -2)
    vertices = [(0, 0, 0), (length, 0, 0), (length, width, 0.02), (0, width, 0.02), (length / 2, width, 0.04)]
    return vertices, [(0, 1, 2), (0, 2, 4), (0, 4, 3)]


# ---- the room ------------------------------------------------------------------------------------


def _shell(boards, plaster):
    floor = kit.Builder(tile=1.2)
    floor.quad((-WIDTH, 0, 0), (2 * WIDTH, 0, 0), (0, LENGTH, 0), cells=(8, 8))
    floor.object("floor", [boards])
    for name, sign in (("roof_left", -1), ("roof_right", 1)):
        slope = kit.Builder(tile=1.2)
        low, high = Vector((sign * WIDTH, 0, EAVES)), Vector((0, 0, RIDGE))
        along, up = Vector((0, LENGTH, 0)), high - low
        corner, u, v = (low, along, up) if sign > 0 else (low + along, -along, up)
        slope.quad(corner, u, v, cells=(4, 2))
        slope.object(name, [boards])
    for name, y, sign in (("gable_front", 0, -1), ("gable_back", LENGTH, 1)):
        _gable(name, y, sign, plaster)


def _gable(name, y, sign, plaster):
    """An end wall that faces the room; the one at the back has a window."""
    wall = kit.Builder(tile=2)
    if sign < 0:
        wall.quad((WIDTH, y, 0), (-2 * WIDTH, 0, 0), (0, 0, RIDGE))
    else:
        for low, high, bottom, top in ((-WIDTH, -0.8, 0, RIDGE), (0.8, WIDTH, 0, RIDGE), (-0.8, 0.8, 0, 0.9),
                                       (-0.8, 0.8, 2.1, RIDGE)):
            wall.quad((low, y, bottom), (high - low, 0, 0), (0, 0, top - bottom))
    wall.object(name, [plaster])


# ---- what stands in it ---------------------------------------------------------------------------


class Places:
    """Free places on the floor, row by row, each a little off."""

    def __init__(self, count, rng):
        columns = 16
        self._free = [(-WIDTH * 0.85 + 1.7 * WIDTH * (i % columns) / (columns - 1),
                       0.4 + (LENGTH - 0.8) * (i // columns) / max(1, (count - 1) // columns)) for i in range(count)]
        self._rng = rng
        rng.shuffle(self._free)

    def next(self):
        x, y = self._free.pop()
        return (x + self._rng.uniform(-0.03, 0.03), y + self._rng.uniform(-0.03, 0.03), 0.002)


def _crate(number, place, rng, wood, tin):
    """One of the many; `number` decides what is in disorder about it."""
    size = [rng.uniform(0.12, 0.34) for _ in range(3)]
    vertices, faces = _box(size)
    kind = number % 8
    if kind == 0:
        return _mesh_object(f"bare_{number:03d}", vertices, faces, tin, (), place)
    if kind == 1:
        return _mesh_object(f"plain_{number:03d}", vertices, faces, wood, ("UVMap",), place)
    if kind == 2:
        return _mesh_object(f"layers_{number:03d}", vertices, faces, wood, ("Detail", "UVMap", "Decals"), place)
    if kind == 3:
        return _mesh_object(f"splinter_{number:03d}", *_splinter(rng), wood, ("UVMap",), place)
    if kind == 4:  # one face of no area among six
        faces = [*faces, (0, 1, 1 + len(vertices) - 1)]
        return _mesh_object(f"flawed_{number:03d}", [*vertices, vertices[0]], faces, tin, (), place)
    if kind == 5:
        thing = _mesh_object(f"bevelled_{number:03d}", vertices, faces, wood, ("UVMap",), place)
        bevel = thing.modifiers.new("Bevel", "BEVEL")
        bevel.width, bevel.segments = 0.02, 1
        return thing
    if kind == 6:
        thing = _mesh_object(f"{LONG}{number:03d}", vertices, faces, tin, ("UVMap",), place)
        thing.rotation_euler.z = rng.uniform(0, 3)
        return thing
    thing = kit.Builder(tile=0.5)
    thing.box((-size[0] / 2, -size[1] / 2, 0), (size[0] / 2, size[1] / 2, size[2]), skip="z")
    return thing.object(f"tidy_{number:03d}", [wood], Matrix.Translation(place))


def _without_area(count, tin):
    """Meshes of which nothing can be seen: two triangles on a line, a point, edges alone, nothing at all."""
    line = [(0, 0, 1), (0.5, 0, 1), (1, 0, 1), (1.5, 0, 1)]
    for number in range(count):
        place = (-1.5 + 0.1 * number, 1.0, 0)
        vertices, faces, edges = ((line, [(0, 1, 2), (1, 2, 3)], ()), ([(0, 0, 1)] * 3, [(0, 1, 2)], ()),
                                  (line, [], ((0, 1), (1, 2))), ([], [], ()))[number % 4]
        _mesh_object(f"nothing_{number:03d}", vertices, faces, tin, ("UVMap",) if number % 8 < 4 else (), place, edges)


def _with_modifiers(wood, tin):
    """Rows of rafters from one, halves that are mirrored, a cushion, a shelf without thickness of its own."""
    rafter = _mesh_object("rafters", *_box((0.12, 0.16, 0.12)), wood, ("UVMap", "Lightmap"), (0, 0.5, RIDGE - 0.4))
    rafter.scale.x = 12
    array = rafter.modifiers.new("Array", "ARRAY")
    array.count, array.use_relative_offset, array.use_constant_offset = 8, False, True
    array.constant_offset_displace = (0, 0.95, 0)

    trunk = _mesh_object("trunk", [(0, y, z) for y in (-0.3, 0.3) for z in (0, 0.4)]
                         + [(0.5, y, z) for y in (-0.3, 0.3) for z in (0, 0.4)],
                         [(4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (1, 5, 7, 3), (0, 2, 6, 4)], wood, ("UVMap",),
                         (-2.6, 6.6, 0.002))
    trunk.modifiers.new("Mirror", "MIRROR")

    cushion = _mesh_object("cushion", *_box((0.6, 0.6, 0.25)), tin, (), (2.4, 6.4, 0.002))
    smooth = cushion.modifiers.new("Subdivision", "SUBSURF")
    smooth.levels = smooth.render_levels = 2

    shelf = _mesh_object("shelf", [(-1, 0, 0), (1, 0, 0), (1, 0.4, 0), (-1, 0.4, 0)], [(0, 1, 2, 3)], wood, ("UVMap",),
                         (0, 0.05, 1.2))
    shelf.modifiers.new("Solidify", "SOLIDIFY").thickness = 0.04


def _without_mesh(tin):
    """A thick rope (curve) and a label (text): they have faces only where they are rendered."""
    curve = bpy.data.curves.new("rope", "CURVE")
    curve.dimensions, curve.bevel_depth, curve.resolution_u, curve.bevel_resolution = "3D", 0.15, 4, 1
    spline = curve.splines.new("POLY")
    spline.points.add(5)
    for i, point in enumerate(spline.points):
        point.co = (-1 + 0.4 * i, 4 + 0.2 * math.sin(i), 1.6 - 0.1 * (i % 2), 1)
    text = bpy.data.curves.new("label", "FONT")
    text.body, text.size, text.extrude = "FRAGILE", 0.3, 0.01
    for name, data, place in (("rope", curve, (0, 0, 0)), ("label", text, (-0.6, 3, 0.02))):
        data.materials.append(tin)
        thing = bpy.data.objects.new(name, data)
        thing.location = place
        bpy.context.scene.collection.objects.link(thing)


def _instances(count, tin, wood):
    """Jars that share a mesh, and shelves of books that are one collection shown again and again."""
    jar = kit.Builder()
    jar.lathe([(0.05, 0), (0.06, 0.05), (0.06, 0.14), (0.04, 0.18)], 8)
    first = jar.object("jar", [tin], Matrix.Translation((-0.9, 0.25, 1.24)))
    for number in range(1, count):
        again = bpy.data.objects.new(f"jar_{number:03d}", first.data)
        again.location = (-0.9 + 1.8 * number / count, 0.25, 1.24)
        bpy.context.scene.collection.objects.link(again)

    books = bpy.data.collections.new("books")
    for number in range(4):
        book = _mesh_object(f"book_{number}", *_box((0.05, 0.18, 0.22 + 0.02 * number)), wood, ("UVMap",),
                            (0.06 * number, 0, 0))
        bpy.context.scene.collection.objects.unlink(book)
        books.objects.link(book)
    for number in range(max(1, count // 4)):
        shelf = bpy.data.objects.new(f"books_{number:02d}", None)
        shelf.instance_type, shelf.instance_collection = "COLLECTION", books
        shelf.location = (3.0, 1.0 + 0.5 * number, 0.002)
        shelf.rotation_euler.z = 0.4 * number
        bpy.context.scene.collection.objects.link(shelf)


def build(things=240, seed=11):
    if things < 8:
        raise SystemExit(f"attic: things is {things}; it takes 8 or more")
    kit.start(exposure=0.3, look="Medium High Contrast")
    rng = random.Random(seed)
    wood = _textured("wood", patterns.tiles())
    boards = _textured("boards", patterns.plates(), kit.DETAIL_UV)
    tin = kit.diffuse("tin", (0.55, 0.57, 0.6))
    _shell(boards, kit.diffuse("plaster", (0.74, 0.68, 0.58)))

    without_area = max(4, things // 40)
    places = Places(things, rng)
    for number in range(things):
        _crate(number, places.next(), rng, wood, tin)
    _without_area(without_area, tin)
    _with_modifiers(wood, tin)
    _without_mesh(tin)
    _instances(max(4, things // 20), tin, wood)

    kit.sun((0.3, 0.8, 0.5), 12.0, (1.0, 0.86, 0.66), size=0.5)
    kit.world((0.4, 0.6, 1.0), 1.0)
    kit.area("bulb", (0, 3.5, RIDGE - 0.6), (0, 0, -1), (0.15, 0.15), 60, (1.0, 0.8, 0.5))
    kit.camera((0.3, 0.3, 1.7), (0, 6.0, 0.8), lens=22)
