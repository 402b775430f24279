"""A long hall: two rows of pillars and statues, a vault, a window for each bay that lets the sun in.

`objects` counts everything that is baked; the hall grows longer with it. This is the scaling benchmark.
"""

import math
import random

import kit

BAY = 3.2
NAVE, AISLE = 2.7, 5.2  # half widths
SPRING = 4.6            # where the vault starts
SHELL = 6               # floor, vault, four walls


def _checker(name, dark, light):
    """Square tiles in two colours, one for each unit of UVMap."""
    material = kit.diffuse(name, light)
    nodes = material.node_tree.nodes
    surface = next(node for node in nodes if node.type == "BSDF_DIFFUSE")
    tiles = nodes.new("ShaderNodeTexChecker")
    tiles.inputs["Color1"].default_value = kit.rgba(light)
    tiles.inputs["Color2"].default_value = kit.rgba(dark)
    tiles.inputs["Scale"].default_value = 2.0
    where = nodes.new("ShaderNodeUVMap")
    where.uv_map = kit.DETAIL_UV
    links = material.node_tree.links
    links.new(where.outputs["UV"], tiles.inputs["Vector"])
    links.new(tiles.outputs["Color"], surface.inputs["Color"])
    return material


# ---- the shell -----------------------------------------------------------------------------------


def _floor(length):
    builder = kit.Builder(tile=1.6)
    builder.quad((-AISLE, 0, 0), (2 * AISLE, 0, 0), (0, length, 0), cells=(8, max(4, int(length))))
    builder.object("floor", [_checker("tiles", (0.16, 0.055, 0.035), (0.62, 0.5, 0.36))])


def _vault(length, plaster):
    """The barrel over the nave, the flat ceilings of the aisles and the beams under the barrel."""
    builder = kit.Builder()

    def barrel(s, t):  # from right to left, so that it faces down
        angle = math.pi * s
        return (NAVE * math.cos(angle), length * t, SPRING + NAVE * math.sin(angle))

    builder.grid(barrel, 24, max(4, int(length)), (math.pi * NAVE, length))
    for left, right in ((-AISLE, -NAVE), (NAVE, AISLE)):
        builder.quad((left, length, SPRING), (right - left, 0, 0), (0, -length, 0))
    builder.object("vault", [plaster])


def _window_wall(length, bays, plaster):
    """The left wall, pierced by one window for each bay: piers, sills, heads and the reveals between."""
    builder = kit.Builder()
    half, sill, head, thick = 0.85, 0.9, 4.1, 0.45
    x = -AISLE
    builder.quad((x, 0, 0), (0, length, 0), (0, 0, sill))
    builder.quad((x, 0, head), (0, length, 0), (0, 0, SPRING - head))
    edges = [0.0]
    for bay in range(bays):
        middle = (bay + 0.5) * BAY
        edges += [middle - half, middle + half]
        low, high = middle - half, middle + half
        builder.quad((x - thick, low, sill), (thick, 0, 0), (0, 2 * half, 0))          # sill, up
        builder.quad((x - thick, high, head), (thick, 0, 0), (0, -2 * half, 0))        # head, down
        builder.quad((x, low, sill), (-thick, 0, 0), (0, 0, head - sill))              # faces +y
        builder.quad((x - thick, high, sill), (thick, 0, 0), (0, 0, head - sill))      # faces -y
    edges.append(length)
    for low, high in zip(edges[::2], edges[1::2]):
        if high - low > 1e-6:
            builder.quad((x, low, sill), (0, high - low, 0), (0, 0, head - sill))
    builder.object("wall_windows", [plaster])


def _plain_walls(length, plaster):
    right = kit.Builder()
    right.quad((AISLE, length, 0), (0, -length, 0), (0, 0, SPRING), cells=(max(4, int(length)), 4))
    right.object("wall_right", [kit.diffuse("terracotta", (0.6, 0.2, 0.1))])
    top = SPRING + NAVE
    for name, y, sign, material in (("wall_end", length, 1, kit.diffuse("lapis", (0.08, 0.17, 0.42))),
                                    ("wall_entry", 0, -1, plaster)):
        wall = kit.Builder()
        wall.quad((-sign * AISLE, y, 0), (sign * 2 * AISLE, 0, 0), (0, 0, top), cells=(8, 6))
        wall.object(name, [material])


# ---- what stands in it ---------------------------------------------------------------------------


def _pillar(name, x, y, stone):
    builder = kit.Builder()
    builder.box((x - 0.48, y - 0.48, 0), (x + 0.48, y + 0.48, 0.28), skip="z")
    builder.box((x - 0.5, y - 0.5, 4.3), (x + 0.5, y + 0.5, SPRING), skip="Z")
    profile = [(0.47, 0.28), (0.47, 0.38), (0.4, 0.44), (0.36, 0.5), (0.36, 1.2), (0.352, 2.0), (0.34, 2.8),
               (0.32, 3.6), (0.31, 3.9), (0.37, 3.95), (0.37, 4.03), (0.33, 4.08), (0.4, 4.2), (0.48, 4.3)]

    def flutes(angle, share):
        return 1.0 - 0.05 * (0.5 + 0.5 * math.cos(12 * angle)) * (0.2 < share < 0.65)

    builder.lathe(profile, 48, (x, y, 0), shape=flutes)
    builder.object(name, [stone])


def _figure(rng):
    """Profile and shape of one statue: a few sines decide whether it is a vase, a flame or a totem."""
    kind = rng.randrange(4)
    rows, height = 30, rng.uniform(1.2, 1.5)
    lobes, twist, depth = rng.choice((3, 4, 5)), rng.uniform(-5, 5), rng.uniform(0.1, 0.22)
    bulges = rng.choice((2, 3))
    profile = []
    for row in range(rows + 1):
        t = row / rows
        end = math.sqrt(max(1e-4, 1 - max(0.0, (t - 0.86) / 0.14) ** 2))  # rounds the top off
        if kind == 0:    # vase
            radius = 0.2 + 0.17 * math.sin(math.pi * min(1, t * 1.25)) ** 2 - 0.07 * (t > 0.8) * (t - 0.8) * 5
        elif kind == 1:  # flame
            radius = 0.34 * (1 - t) ** 0.7 + 0.03
        elif kind == 2:  # totem of balls
            radius = 0.1 + 0.25 * abs(math.sin(math.pi * bulges * min(0.999, t))) * (1 - 0.35 * t)
        else:            # robed figure: skirt, waist, shoulders, head
            radius = (0.36 - 0.42 * t if t < 0.5 else 0.15 + 0.14 * math.sin(math.pi * (t - 0.5) / 0.26) if t < 0.76
                      else 0.07 + 0.1 * math.sin(math.pi * (t - 0.76) / 0.24))
        profile.append((max(0.004, radius * end), height * t))

    def shape(angle, share):
        if kind == 2:
            return 1.0
        fold = depth * (1 - share if kind == 3 else 1.0)
        return 1.0 + fold * math.sin(lobes * angle + twist * share)

    return profile, shape


def _statue(name, x, y, rng, stones):
    builder = kit.Builder()
    builder.box((x - 0.45, y - 0.45, 0), (x + 0.45, y + 0.45, 0.16), skip="z")
    builder.box((x - 0.36, y - 0.36, 0.16), (x + 0.36, y + 0.36, 0.92), skip="zZ")
    builder.box((x - 0.42, y - 0.42, 0.92), (x + 0.42, y + 0.42, 1.02), skip="")
    profile, shape = _figure(rng)
    builder.lathe(profile, 36, (x, y, 1.02), slot=1, shape=shape)
    builder.object(name, [stones[0], rng.choice(stones[1:])])


def build(objects=40, seed=7):
    if objects < SHELL + 1:
        raise SystemExit(f"hall: objects is {objects}; it takes {SHELL + 1} or more")
    kit.start(exposure=-0.1, look="Medium High Contrast")
    rng = random.Random(seed)
    props = objects - SHELL
    bays = math.ceil(props / 4)
    length = bays * BAY

    plaster = kit.diffuse("plaster", (0.74, 0.68, 0.58))
    stone = kit.diffuse("limestone", (0.72, 0.63, 0.5))
    statues = [stone, kit.diffuse("marble", (0.82, 0.81, 0.79)), kit.diffuse("jade", (0.16, 0.42, 0.28)),
               kit.diffuse("bronze", (0.5, 0.27, 0.1)), kit.diffuse("marble_rose", (0.78, 0.52, 0.46))]
    _floor(length)
    _vault(length, plaster)
    _window_wall(length, bays, plaster)
    _plain_walls(length, plaster)
    for prop in range(props):
        bay, place = divmod(prop, 4)
        x = -NAVE if place % 2 == 0 else NAVE
        if place < 2:
            _pillar(f"pillar_{prop:03d}", x, (bay + 0.98) * BAY, stone)
        else:
            _statue(f"statue_{prop:03d}", x, (bay + 0.5) * BAY, rng, statues)

    kit.sun((-0.83, 0.16, 0.5), 22.0, (1.0, 0.8, 0.56), size=0.5)
    kit.world((0.42, 0.62, 1.0), 3.0)
    kit.camera((0.7, 0.35, 1.75), (-0.25, 9.0, 1.95), lens=23)
