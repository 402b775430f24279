"""What the readers of formats_check.py and more_formats_check.py share: files of a format, and a look-up as hardware does it."""
import math
from pathlib import Path
import tempfile
import unittest

import known_light as known


class Files(unittest.TestCase):
    """Makes a folder with the files of `form`."""
    form, what = None, "boxes"

    @classmethod
    def setUpClass(cls):
        if cls.form is None:
            raise unittest.SkipTest("the base of the others")
        folder = tempfile.TemporaryDirectory(prefix="rnmbake-formats-")
        cls.addClassCleanup(folder.cleanup)
        cls.folder = Path(folder.name)
        known.write(cls.folder, cls.form, cls.what)

    def assert_light(self, found, expected, tolerance, message=""):
        for channel in range(3):
            self.assertLessEqual(abs(found[channel] - expected[channel]), tolerance,
                                 f"{message}: found {found}, expected {expected}")

    def assert_walls(self, look_up, tolerance):
        """`look_up(place, normal)` in the room, Blender's axes: each wall's colour where it is, by its name."""
        for axis, normal in known.AXES.items():
            found = look_up((.3, -.2, .1), normal)
            self.assert_light(found, known.WALLS[axis], tolerance, axis)
            middle = (max(found) + min(found)) / 2
            bright = "".join(letter for letter, value in zip("rgb", found) if value > middle)
            self.assertEqual({"r": "red", "gb": "cyan", "g": "green", "rb": "magenta", "b": "blue", "rg": "yellow"}[bright],
                             known.COLOURS[axis])

    def assert_boxes(self, look_up, normals, relative):
        """`look_up(name, place, normal)` at and between all probes of all boxes."""
        for name in known.BOXES:
            for index in known.probes(name) + known.between(name):
                share = known.share(name, *index)
                for normal in normals:
                    expected = [share * value for value in known.light(normal)]
                    self.assert_light(look_up(name, known.place(name, *index), normal), expected,
                                      relative * share, f"{name} {index} {normal}")


def sampled(texel, size, at):
    """Trilinear, clamped to the edge, as graphics hardware does; `at` in texels, whose centres are at + 1/2."""
    low, shares = [], []
    for k in range(3):
        base = math.floor(at[k] - .5)
        low.append(base)
        shares.append(at[k] - .5 - base)
    found = None
    for corner in range(8):
        weight, where = 1, []
        for k in range(3):
            far = corner >> k & 1
            weight *= shares[k] if far else 1 - shares[k]
            where.append(min(max(low[k] + far, 0), size[k] - 1))
        if weight:
            value = texel(*where)
            found = [weight * v + (found[i] if found else 0) for i, v in enumerate(value)]
    return found


def turned_by(q, v):
    """Rotates v by the unit quaternion x, y, z, w."""
    x, y, z, w = q
    a, b, c = v
    i, j, k, r = w * a + y * c - z * b, w * b + z * a - x * c, w * c + x * b - y * a, -x * a - y * b - z * c
    return (-r * x + i * w - j * z + k * y, -r * y + j * w - k * x + i * z, -r * z + k * w - i * y + j * x)
