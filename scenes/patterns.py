"""Height fields and colours that repeat in both directions, in plain Python: what the `panels` walls are made of.

Each pattern returns a Pattern of SIZE x SIZE texels, row 0 at the bottom (v = 0). Heights are shares of the
tile's side; colours are sRGB-coded.
"""

import math
import random

SIZE = 256


class Pattern:
    def __init__(self, height, color):
        """Both: functions of (u, v) in [0,1), evaluated at the texels' centres."""
        places = [((x + 0.5) / SIZE, (y + 0.5) / SIZE) for y in range(SIZE) for x in range(SIZE)]
        self.heights = [height(u, v) for u, v in places]
        self.colors = [color(u, v) for u, v in places]

    def normals(self):
        """Tangent-space normals, Y up, coded to [0,1]."""
        coded, h = [], self.heights
        for y in range(SIZE):
            up, down = (y + 1) % SIZE * SIZE, (y - 1) % SIZE * SIZE
            for x in range(SIZE):
                right, left = (x + 1) % SIZE, (x - 1) % SIZE
                slope_u = (h[y * SIZE + right] - h[y * SIZE + left]) * SIZE / 2
                slope_v = (h[up + x] - h[down + x]) * SIZE / 2
                length = math.sqrt(slope_u * slope_u + slope_v * slope_v + 1)
                coded.append((0.5 - 0.5 * slope_u / length, 0.5 - 0.5 * slope_v / length, 0.5 + 0.5 / length))
        return coded


# ---- building blocks -----------------------------------------------------------------------------


def step(low, high, x):
    """Smooth from 0 to 1."""
    t = min(1.0, max(0.0, (x - low) / (high - low)))
    return t * t * (3 - 2 * t)


def mix(a, b, t):
    return tuple(p + (q - p) * t for p, q in zip(a, b))


def tint(color, factor):
    return tuple(min(1.0, c * factor) for c in color)


class Noise:
    """Periodic value noise, -1 to 1."""

    def __init__(self, cells, seed):
        rng = random.Random(seed)
        self.cells = cells
        self.values = [[rng.uniform(-1, 1) for _ in range(cells)] for _ in range(cells)]

    def __call__(self, u, v):
        x, y = u * self.cells, v * self.cells
        column, row = math.floor(x), math.floor(y)
        s, t = step(0, 1, x - column), step(0, 1, y - row)
        n = self.cells
        low, high = self.values[row % n], self.values[(row + 1) % n]
        a = low[column % n] * (1 - s) + low[(column + 1) % n] * s
        b = high[column % n] * (1 - s) + high[(column + 1) % n] * s
        return a * (1 - t) + b * t


class Grain:
    """A few octaves of noise."""

    def __init__(self, cells, seed, octaves=3):
        self.layers = [(Noise(cells * 2**i, seed + i), 0.5**i) for i in range(octaves)]

    def __call__(self, u, v):
        return sum(weight * noise(u, v) for noise, weight in self.layers)


def rim(u, v, box):
    """Distance from (u, v) to the nearest edge of box = (x0, y0, x1, y1), negative outside."""
    return min(u - box[0], box[2] - u, v - box[1], box[3] - v)


# ---- the patterns --------------------------------------------------------------------------------


def bricks():
    rows, columns = 6, 3
    rng = random.Random(3)
    shade = [[(rng.uniform(0.75, 1.1), rng.uniform(0, 1), rng.uniform(-1, 1), rng.uniform(-1, 1))
              for _ in range(columns)] for _ in range(rows)]
    grain, wobble = Grain(24, 5), Noise(16, 9)

    def brick(u, v):
        row = int(v * rows)
        x = u * columns + 0.5 * (row % 2)
        s, t = x % 1.0, v * rows % 1.0
        edge = min(min(s, 1 - s) / columns, min(t, 1 - t) / rows) + 0.003 * wobble(u, v)
        return shade[row % rows][int(x) % columns], s, t, edge

    def height(u, v):
        (_, lift, lean_s, lean_t), s, t, edge = brick(u, v)
        top = 0.8 + 0.2 * lift + 0.12 * (lean_s * (s - 0.5) + lean_t * (t - 0.5))
        return 0.022 * step(0.006, 0.02, edge) * top + 0.0022 * grain(u, v)

    def color(u, v):
        (bright, warm, _, _), _, _, edge = brick(u, v)
        face = tint(mix((0.67, 0.27, 0.16), (0.8, 0.45, 0.25), warm), bright * (1 + 0.1 * grain(u, v)))
        return mix((0.62, 0.56, 0.5), face, step(0.006, 0.014, edge))

    return Pattern(height, color)


def tiles():
    grain = Grain(10, 21)

    def tile(u, v):
        x, y = u * 2, v * 2
        dark = (int(x) + int(y)) % 2
        s, t = x % 1.0, y % 1.0
        diamond = 0.34 - (abs(s - 0.5) + abs(t - 0.5))
        return dark, rim(s, t, (0, 0, 1, 1)), diamond

    def height(u, v):
        dark, edge, diamond = tile(u, v)
        inlay = 0.0 if dark else 0.35 * step(-0.02, 0.03, diamond) - 0.3 * step(0.07, 0.12, diamond)
        return 0.02 * (step(0.012, 0.06, edge) + inlay) + 0.0012 * grain(u, v)

    def color(u, v):
        dark, edge, diamond = tile(u, v)
        face = (0.27, 0.33, 0.42) if dark else mix((0.82, 0.76, 0.66), (0.78, 0.52, 0.2), step(0, 0.02, diamond))
        return mix((0.3, 0.27, 0.25), tint(face, 1 + 0.07 * grain(u, v)), step(0.01, 0.03, edge))

    return Pattern(height, color)


def _plates(rng, box, depth):
    """Splits the tile into plates, larger ones first."""
    x0, y0, x1, y1 = box
    wide, high = x1 - x0, y1 - y0
    if depth == 0 or max(wide, high) < 0.28 or (depth < 3 and rng.random() < 0.22):
        return [(box, rng.choice(("plain", "plain", "inset", "grille", "rivets", "hatch")), rng.random())]
    cut = rng.choice((0.34, 0.5, 0.5, 0.62))
    if wide > high:
        middle = x0 + wide * cut
        return _plates(rng, (x0, y0, middle, y1), depth - 1) + _plates(rng, (middle, y0, x1, y1), depth - 1)
    middle = y0 + high * cut
    return _plates(rng, (x0, y0, x1, middle), depth - 1) + _plates(rng, (x0, middle, x1, y1), depth - 1)


def plates(seed=12, base=(0.2, 0.5, 0.55), accent=(0.9, 0.5, 0.13)):
    """Science-fiction panelling."""
    rng = random.Random(seed)
    parts = _plates(rng, (0.0, 0.0, 1.0, 1.0), 5)
    grain = Grain(16, seed)

    def part(u, v):
        return next(p for p in parts if p[0][0] <= u < p[0][2] and p[0][1] <= v < p[0][3])

    def ornament(u, v, box, kind):
        """Height on top of the plate, -1 to 1, and how much of the accent colour shows."""
        edge = rim(u, v, box)
        if kind == "inset":
            return -0.7 * step(0.035, 0.055, edge), step(0.045, 0.05, edge)
        if kind == "grille":
            wave = 0.5 + 0.5 * math.sin(2 * math.pi * v / 0.03125)
            return -0.9 * step(0.03, 0.04, edge) * wave, 0.0
        if kind == "hatch":
            wave = 0.5 + 0.5 * math.sin(2 * math.pi * (u + v) / 0.0625)
            return 0.45 * step(0.03, 0.045, edge) * step(0.3, 0.7, wave), step(0.03, 0.04, edge) * step(0.45, 0.55, wave)
        if kind == "rivets":
            s = min(u - box[0], box[2] - u) - 0.035
            t = min(v - box[1], box[3] - v) - 0.035
            away = math.hypot(s, t) / 0.015
            return 0.7 * math.sqrt(max(0.0, 1 - away * away)), 0.0
        return 0.0, 0.0

    def height(u, v):
        box, kind, lift = part(u, v)
        plate = step(0.004, 0.016, rim(u, v, box)) * (0.75 + 0.35 * lift)
        return 0.022 * (plate + 0.6 * ornament(u, v, box, kind)[0]) + 0.0006 * grain(u, v)

    def color(u, v):
        box, kind, lift = part(u, v)
        face = mix(tint(base, 0.7 + 0.5 * lift), accent, 0.9 * ornament(u, v, box, kind)[1])
        worn = tint(face, 1 + 0.08 * grain(u, v))
        return mix(tint(base, 0.3), worn, step(0.003, 0.01, rim(u, v, box)))

    return Pattern(height, color)


def studs(base=(0.42, 0.28, 0.5), knob=(0.87, 0.83, 0.76), columns=4):
    """Domes in a honeycomb; the tile is stretched a little so that the comb repeats."""
    rows = columns  # an even count, so that the shift by half a column repeats
    grain = Grain(16, 31)

    def dome(u, v):
        near = 9.0
        row = math.floor(v * rows)
        for r in (row - 1, row, row + 1):
            shift = 0.5 * (r % 2)
            column = math.floor(u * columns - shift + 0.5)
            ds, dt = u * columns - shift - column, v * rows - r - 0.5
            near = min(near, math.hypot(ds, dt))
        return near

    def height(u, v):
        d = dome(u, v) / 0.4
        collar = step(0.8, 0.9, d / 1.25) - step(0.95, 1.05, d / 1.25)
        return (0.3 / columns) * (math.sqrt(max(0.0, 1 - d * d)) * 0.55 + 0.12 * collar) + 0.001 * grain(u, v)

    def color(u, v):
        return tint(mix(knob, base, step(0.39, 0.42, dome(u, v))), 1 + 0.06 * grain(u, v))

    return Pattern(height, color)


def cobbles(cells=6, seed=53):
    """Rounded stones in sand: cells around scattered points, higher towards their middle."""
    rng = random.Random(seed)
    points = [[(rng.uniform(0.2, 0.8), rng.uniform(0.2, 0.8), rng.uniform(0.75, 1)) for _ in range(cells)]
              for _ in range(cells)]
    grain = Grain(24, seed)

    def nearest(u, v):
        """Distances to the two nearest points, in cells, and the lift of the nearest stone."""
        column, row = int(u * cells), int(v * cells)
        found = []
        for r in range(row - 2, row + 3):
            for c in range(column - 2, column + 3):
                x, y, lift = points[r % cells][c % cells]
                found.append((math.hypot(u * cells - c - x, v * cells - r - y), lift))
        (first, lift), (second, _) = sorted(found)[:2]
        return first, second, lift

    def height(u, v):
        first, second, lift = nearest(u, v)
        inside = min(1.0, (second - first) / 0.7)
        return 0.045 * lift * math.sqrt(1 - (1 - inside) ** 2) + 0.0008 * grain(u, v)

    def color(u, v):
        first, second, lift = nearest(u, v)
        return mix((0.42, 0.37, 0.3), tint((0.55, 0.54, 0.52), lift + 0.06 * grain(u, v)), step(0.02, 0.12, second - first))

    return Pattern(height, color)


def stone(base=(0.75, 0.7, 0.63), depth=0.012, seed=41):
    """Hewn rock: ridged noise."""
    rough, fine = Grain(5, seed, 4), Grain(24, seed + 7, 3)

    def height(u, v):
        return depth * (0.9 - abs(rough(u, v)) * 1.4) + 0.12 * depth * fine(u, v)

    def color(u, v):
        return tint(base, 0.97 + 0.14 * rough(u, v) + 0.08 * fine(u, v))

    return Pattern(height, color)


RELIEFS = {"floor": cobbles, "wall": bricks, "crate": plates}  # of the scene `cobbles`, by object
