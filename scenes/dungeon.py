"""A dungeon out of a kit: 150 instances of seven meshes, on a plan of tiles, lit by torches and by the sky over its court.

What level designers build: pieces that share their meshes, turned and placed again and again; a lightmap for each.
"""

import math

import bpy
from mathutils import Matrix

import kit

TILE, HEIGHT = 2.0, 2.6
# '.' floor, 'o' floor under the open sky, 'p' floor with a pillar, 'c' with a crate, 't' with a torch on its wall
PLAN = ("..c..c   ",
        ".p..p.t..",
        ".oooo...c",
        "toooo c. ",
        ".oooo... ",
        ".p..p.t..",
        ". .c.c   ")
SIDES = ((1, 0), (0, 1), (-1, 0), (0, -1))


def _pieces():
    """Each mesh once, around the middle of its tile's floor."""
    stone, dark = kit.diffuse("stone", (0.52, 0.47, 0.42)), kit.diffuse("dark stone", (0.24, 0.2, 0.19))
    wood, flame = kit.diffuse("wood", (0.4, 0.22, 0.09)), kit.diffuse("flame", (0.8, 0.5, 0.2), emission=(60, 26, 6))
    half = TILE / 2
    floor, ceiling, wall = kit.Builder(tile=1.0), kit.Builder(tile=1.0), kit.Builder(tile=1.0)
    floor.quad((-half, -half, 0), (TILE, 0, 0), (0, TILE, 0), cells=(2, 2))
    ceiling.quad((-half, half, HEIGHT), (TILE, 0, 0), (0, -TILE, 0))
    wall.quad((half, half, 0), (0, -TILE, 0), (0, 0, HEIGHT), cells=(2, 2))  # on the side of +x, facing the tile
    wall.quad((half + 0.2, -half, 0), (0, TILE, 0), (0, 0, HEIGHT))          # its back
    pillar, crate, torch = kit.Builder(), kit.Builder(), kit.Builder()
    pillar.lathe([(0.34, 0), (0.34, 0.2), (0.24, 0.3), (0.22, 2.2), (0.34, 2.4), (0.34, HEIGHT)], 16, (0, 0, 0))
    crate.box((-0.45, -0.45, 0), (0.45, 0.45, 0.8), skip="z")
    torch.box((half - 0.16, -0.05, 1.4), (half - 0.02, 0.05, 1.6))
    ember = kit.Builder()
    ember.box((half - 0.15, -0.05, 1.62), (half - 0.05, 0.05, 1.78))
    made = (("floor", floor, stone), ("ceiling", ceiling, dark), ("wall", wall, stone), ("pillar", pillar, stone),
            ("crate", crate, wood), ("torch", torch, wood), ("ember", ember, flame))
    return {name: _mesh(builder, name, material) for name, builder, material in made}


def _mesh(builder, name, material):
    ob = builder.object(name, [material])
    mesh = ob.data
    bpy.data.objects.remove(ob)
    return mesh


class _Kit:
    def __init__(self):
        self._meshes, self._count = _pieces(), {}

    def place(self, piece, x, y, turn=0):
        number = self._count[piece] = self._count.get(piece, 0) + 1
        ob = bpy.data.objects.new(f"{piece}.{number:03}", self._meshes[piece])
        ob.matrix_world = Matrix.Translation((x * TILE, y * TILE, 0)) @ Matrix.Rotation(turn * math.pi / 2, 4, "Z")
        bpy.context.scene.collection.objects.link(ob)


def _cell(x, y):
    return PLAN[y][x] if 0 <= y < len(PLAN) and 0 <= x < len(PLAN[y]) else " "


def build():
    kit.start()
    pieces = _Kit()
    for y, row in enumerate(PLAN):
        for x, cell in enumerate(row):
            if cell == " ":
                continue
            pieces.place("floor", x, y)
            if cell != "o":
                pieces.place("ceiling", x, y)
            walls = [turn for turn, (dx, dy) in enumerate(SIDES) if _cell(x + dx, y + dy) == " "]
            for turn in walls:
                pieces.place("wall", x, y, turn)
            if cell == "p":
                pieces.place("pillar", x, y)
            if cell == "c":
                pieces.place("crate", x, y, turn=1)
            if cell == "t":
                pieces.place("torch", x, y, walls[0])
                pieces.place("ember", x, y, walls[0])
    kit.world((0.6, 0.75, 1.0), 1.5)
    kit.sun(kit.direction(28, 200), 3.0, (1, 0.93, 0.82), 0.53)
    kit.camera((4 * TILE, 0.4 * TILE, 1.7), (2.4 * TILE, 5 * TILE, 1.1), lens=20)
