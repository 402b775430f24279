"""What the volumes of sample_volumes.h hold, worked out once more; formats_check.py and threejs_check.py compare with it.

Everything is in Blender's world space unless a function says otherwise.
"""
import itertools
import math
import os
import subprocess

HALF_STEP = 2 ** -11  # share of a number by which a half float may be off

AXES = {"+x": (1, 0, 0), "-x": (-1, 0, 0), "+y": (0, 1, 0), "-y": (0, -1, 0), "+z": (0, 0, 1), "-z": (0, 0, -1)}
WALLS = {"+x": (1, .4, .4), "-x": (.4, 1, 1), "+y": (.5, 1.1, .5), "-y": (1.1, .5, 1.1), "+z": (.4, .4, 1.2), "-z": (1.2, 1.2, .4)}
COLOURS = {"+x": "red", "-x": "cyan", "+y": "green", "-y": "magenta", "+z": "blue", "-z": "yellow"}
NORMALS = list(AXES.values()) + [tuple(s / math.sqrt(3) for s in signs) for signs in itertools.product((-1, 1), repeat=3)] + [
    (.6, .8, 0), (0, -.6, .8), (-.8, 0, -.6)]

_C = math.sqrt(.75)
# Name: counts, the first probe's place, steps, whether probes are told apart.
BOXES = {
    "room": ((2, 2, 2), (-1, -1, -1), ((2, 0, 0), (0, 2, 0), (0, 0, 2)), False),
    "hall": ((2, 3, 4), (10, -20, 3), ((.5, 0, 0), (0, 1.5, 0), (0, 0, .75)), True),
    "turned": ((3, 2, 2), (5, 6, 7), ((2 * _C, 1, 0), (-.5, _C, 0), (0, 0, 1.5)), True),
    "single": ((1, 1, 1), (3, -4, 5), ((2, 0, 0), (0, 3, 0), (0, 0, 4)), False),
}
POINTS = {(1, 2, 3): 1, (-4, 5, -6): .5}


def light(normal):
    """E/pi of the walls at a unit normal."""
    found = [normal[0] * normal[1] / 10, normal[1] * normal[2] / 10, normal[0] * normal[2] / 10]
    for axis, name in enumerate("xyz"):
        for channel in range(3):
            ahead, behind = WALLS["+" + name][channel], WALLS["-" + name][channel]
            found[channel] += (ahead + behind) / 2 * normal[axis] ** 2 + (ahead - behind) / 2 * normal[axis]
    return found


# Share of its light by which a place, of floats up to 20, may be off where steps are half a unit and light at most doubles in one.
PLACE = 3 * 20 * 2 ** -23 / .5


def share(name, x, y, z):
    """What the walls' light is multiplied with at a probe, or between probes."""
    return (1 + x) * (1 + y / 2) * (1 + z / 4) if BOXES[name][3] else 1


def place(name, x, y, z):
    _, first, steps, _ = BOXES[name]
    return tuple(first[c] + x * steps[0][c] + y * steps[1][c] + z * steps[2][c] for c in range(3))


def probes(name):
    """Indices of all probes, x fastest."""
    nx, ny, nz = BOXES[name][0]
    return [(x, y, z) for z in range(nz) for y in range(ny) for x in range(nx)]


def between(name):
    """Indices half-way between neighbours, where a trilinear look-up gives share()."""
    return [tuple(i + .5 for i in index) for index in itertools.product(*(range(count - 1) for count in BOXES[name][0]))]


def y_up(v):
    """glTF's axes; three.js, Godot and Bevy have the same."""
    return (v[0], v[2], -v[1])


def unity(v):
    return (-v[0], v[2], -v[1])


def write(folder, name, what="boxes"):
    subprocess.run([os.environ["SAMPLE_FORMATS"], name, str(folder), what], check=True, timeout=60)


def sh_basis(n):
    """Orthonormal, in the order of Ramamoorthi and Hanrahan 2001."""
    x, y, z = n
    first, second = math.sqrt(3 / (4 * math.pi)), math.sqrt(15 / (4 * math.pi))
    return [math.sqrt(1 / (4 * math.pi)), first * y, first * z, first * x, second * x * y, second * y * z,
            math.sqrt(5 / (16 * math.pi)) * (3 * z * z - 1), second * x * z, second / 2 * (x * x - y * y)]


def from_radiance(coefficients, normal):
    """E/pi of nine RGB coefficients of radiance: bands times 1, 2/3 and 1/4."""
    basis = sh_basis(normal)
    return [sum(coefficients[k][c] * basis[k] * (1 if k == 0 else 2 / 3 if k < 4 else 1 / 4) for k in range(9)) for c in range(3)]
