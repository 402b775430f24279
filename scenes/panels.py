"""The demo: a courtyard whose walls are flat and look carved. Sun, sky and three coloured lamps.

Every surface has a normal map (through UVMap) that was made here from a height field and is packed in the file.
"""

import math
from array import array

import bpy

import kit
import patterns

WIDTH, DEPTH, HEIGHT = 6.4, 5.2, 3.2


# ---- materials -----------------------------------------------------------------------------------


def _image(name, colors, is_data):
    size = patterns.SIZE
    image = bpy.data.images.new(name, size, size, alpha=False)
    image.colorspace_settings.name = "Non-Color" if is_data else "sRGB"
    image.pixels.foreach_set(array("f", [value for color in colors for value in (*color, 1.0)]))
    image.update()
    image.pack()
    return image


def mapped(name, pattern, roughness=0.5, specular=0.3):
    """A material with the pattern's colours and normals, packed in the file."""
    material = bpy.data.materials.new(name)
    nodes = kit.Nodes(material)
    output = nodes.add("ShaderNodeOutputMaterial")
    surface = nodes.add("ShaderNodeBsdfPrincipled", Roughness=roughness)
    for socket in ("Specular", "Specular IOR Level"):  # the name before and after Blender 4.0
        if socket in surface.inputs:
            surface.inputs[socket].default_value = specular
    where = nodes.add("ShaderNodeUVMap")
    where.uv_map = kit.DETAIL_UV
    for kind, colors in (("color", pattern.colors), ("normal", pattern.normals())):
        texture = nodes.add("ShaderNodeTexImage")
        texture.image = _image(f"{name}_{kind}", colors, kind == "normal")
        nodes.wire(where, "UV", texture, "Vector")
        if kind == "color":
            nodes.wire(texture, "Color", surface, "Base Color")
            continue
        bend = nodes.add("ShaderNodeNormalMap", Strength=1.0)
        bend.uv_map = kit.DETAIL_UV
        nodes.wire(texture, "Color", bend, "Color")
        nodes.wire(bend, "Normal", surface, "Normal")
    nodes.wire(surface, "BSDF", output, "Surface")
    return material


# ---- objects -------------------------------------------------------------------------------------


def _walls(brick, plate, stud, tile):
    x = WIDTH / 2
    for name, tile_size, material, corner, along_u, along_v in (
            ("floor", 1.6, tile, (-x, -0.6, 0), (WIDTH, 0, 0), (0, DEPTH + 0.6, 0)),
            ("wall_back", 2.2, plate, (-x, DEPTH, 0), (WIDTH, 0, 0), (0, 0, HEIGHT)),
            ("wall_left", 1.5, brick, (-x, -0.6, 0), (0, DEPTH + 0.6, 0), (0, 0, HEIGHT)),
            ("wall_right", 1.2, stud, (x, DEPTH, 0), (0, -DEPTH - 0.6, 0), (0, 0, HEIGHT))):
        builder = kit.Builder(tile=tile_size, margin=0.008)
        builder.quad(corner, along_u, along_v, cells=(4, 4))
        builder.object(name, [material])


def _column(name, x, y, stone):
    builder = kit.Builder(tile=1.0)
    builder.box((x - 0.36, y - 0.36, 0), (x + 0.36, y + 0.36, 0.3), skip="z")
    builder.box((x - 0.34, y - 0.34, 2.75), (x + 0.34, y + 0.34, 3.0))
    profile = [(0.3, 0.3), (0.27, 0.42), (0.25, 0.9), (0.24, 1.6), (0.23, 2.3), (0.25, 2.6), (0.31, 2.75)]
    builder.lathe(profile, 32, (x, y, 0), tiles=(2, 3))
    builder.object(name, [stone])


def _ball(name, centre, radius, material, tiles):
    builder = kit.Builder(margin=0.02)
    turns = [math.pi * (i + 0.05) / 24.1 for i in range(25)]
    profile = [(radius * math.sin(a), -radius * math.cos(a)) for a in turns]
    builder.lathe(profile, 40, centre, tiles=tiles)
    builder.object(name, [material])


def _ring(name, centre, radius, thick, material):
    """A torus that stands upright and faces the camera."""
    builder = kit.Builder(margin=0.02)

    def point(s, t):
        a, b = 2 * math.pi * s, 2 * math.pi * t
        reach = radius + thick * math.cos(b)
        return (centre[0] + reach * math.cos(a), centre[1] + thick * math.sin(b), centre[2] - reach * math.sin(a))

    builder.grid(point, 48, 18, (2 * math.pi * radius, 2 * math.pi * thick), wrap=True, tiles=(12, 2))
    builder.object(name, [material])


def _box(name, material, low, high, turn=0.0, tile=1.0):
    builder = kit.Builder(tile=tile, margin=0.015)
    builder.box(low, high, turn=turn, skip="z")
    builder.object(name, [material])


def _lights():
    kit.sun((0.44, -0.56, 0.7), 7.5, (1.0, 0.85, 0.64), size=0.5)
    kit.world((0.32, 0.5, 0.9), 0.55)
    kit.area("lamp_cyan", (-0.2, DEPTH - 0.12, 0.03), (0, 0.12, 1), (3.6, 0.1), 60, (0.1, 0.75, 1.0))
    kit.area("lamp_magenta", (WIDTH / 2 - 0.12, 3.3, 0.03), (0.12, 0, 1), (0.1, 2.6), 70, (1.0, 0.12, 0.55))
    kit.area("lamp_amber", (-WIDTH / 2 + 0.12, 2.6, 0.03), (-0.12, 0, 1), (0.1, 2.2), 35, (1.0, 0.5, 0.12))


def build():
    kit.start(exposure=0.2, look="Medium High Contrast")
    brick = mapped("bricks", patterns.bricks(), roughness=0.8)
    plate = mapped("plates", patterns.plates(), roughness=0.4, specular=0.4)
    stud = mapped("studs", patterns.studs(), roughness=0.45)
    tile = mapped("tiles", patterns.tiles(), roughness=0.4, specular=0.4)
    stone = mapped("stone", patterns.stone(), roughness=0.8)
    crate = mapped("crate", patterns.plates(5, (0.78, 0.42, 0.14), (0.16, 0.2, 0.24)), roughness=0.5)
    jade = mapped("jade", patterns.studs((0.08, 0.3, 0.26), (0.2, 0.62, 0.45)), roughness=0.35)
    gold = mapped("gold", patterns.stone((0.9, 0.6, 0.16), 0.012, 60), roughness=0.4, specular=0.5)

    _walls(brick, plate, stud, tile)
    _column("column_left", -2.35, 4.4, stone)
    _column("column_right", 2.35, 4.4, stone)
    _box("pedestal", stone, (-0.55, 2.75, 0), (0.55, 3.85, 0.55))
    _ring("ring", (0, 3.3, 1.4), 0.66, 0.18, gold)
    _ball("ball_ring", (0, 3.3, 1.4), 0.3, jade, (3, 1.5))
    _box("crate_large", crate, (-2.3, 2.0, 0), (-1.4, 2.9, 0.9), turn=24)
    _box("crate_small", crate, (-2.1, 2.2, 0.9), (-1.58, 2.72, 1.42), turn=-12, tile=0.6)
    _ball("ball", (1.75, 2.75, 0.5), 0.5, jade, (6, 3))
    _box("bench", stone, (0.75, 1.3, 0), (1.75, 1.65, 0.32), turn=-20)
    _lights()
    kit.camera((0.15, -3.1, 1.75), (0, 3.2, 1.25), lens=32)
