"""--sky and --sun on scenes that bring no light, against closed forms.

    RNMBAKE_BINARY=build/release/rnmbake python3 tests/with_blender/added_light_check.py
"""
import json
from math import cos, pi, radians, sin, sqrt
from pathlib import Path
import tempfile
import unittest

from harness import INVALID_INPUT, OK, SCENES, USAGE, rnmbake, run_blender
from pictures import read_picture

SKY, AZIMUTH, ELEVATION, SUN = 2, 90, 30, 6
LIGHT = ("--sky", SKY, "--sun", f"{AZIMUTH},{ELEVATION},{SUN}")
BAKE = ("-q", "--resolution", 4, "--samples", 256, "--depth", "float", "--dilate", 0)
BASES = ("flat", "rnm0", "rnm1", "rnm2")
NORMALS = {"flat": (0, 0, 1), "rnm0": (sqrt(2 / 3), 0, sqrt(1 / 3)), "rnm1": (-sqrt(1 / 6), sqrt(1 / 2), sqrt(1 / 3)),
           "rnm2": (-sqrt(1 / 6), -sqrt(1 / 2), sqrt(1 / 3))}


def expected(basis):
    """E/pi of the sky's half that such a normal sees above the plane, and of the sun."""
    azimuth, elevation = radians(AZIMUTH), radians(ELEVATION)
    sun = (sin(azimuth) * cos(elevation), cos(azimuth) * cos(elevation), sin(elevation))
    normal = NORMALS[basis]
    return SKY * (1 + normal[2]) / 2 + SUN / pi * max(0, sum(a * b for a, b in zip(sun, normal)))


def means(file):
    """Of each direction, over all texels and colours."""
    pixels = [pixel for row in read_picture(file)[2] for pixel in row]
    return {basis: sum(pixel[(f"{basis}." if basis != "flat" else "") + colour] for pixel in pixels for colour in "RGB")
            / (3 * len(pixels)) for basis in BASES}


class AddedLight(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory(prefix="rnmbake-light-")
        cls.addClassCleanup(folder.cleanup)
        cls.top = Path(folder.name)
        cls.blend, cls.glb = cls.top / "plane.blend", cls.top / "plane.glb"
        run_blender(SCENES / "dark_plane.py", cls.blend, cls.glb)

    def bake(self, scene, name, *flags, command="bake"):
        out = self.top / name
        done = rnmbake(command, scene, "-o", out, *BAKE, *LIGHT, *flags)
        self.assertEqual(done.returncode, OK, done.stderr)
        (file,) = out.glob("*.exr")
        return out, means(file)

    def check(self, found, within):
        for basis in BASES:
            self.assertAlmostEqual(found[basis] / expected(basis), 1, delta=within, msg=basis)

    def test_cycles(self):
        # the sky's noise: a texel's standard error is at most its radiance / sqrt(256), of 16 texels
        self.check(self.bake(self.blend, "cycles")[1], 3 / sqrt(256 * 16))

    def test_our_tracer_and_the_reference(self):
        self.check(self.bake(self.blend, "embree", "--engine", "embree")[1], 3 / sqrt(256 * 16))
        self.check(self.bake(self.blend, "reference", command="reference")[1], 3 / sqrt(256 * 16))

    def test_a_gltf_and_the_scene_saved_with_it(self):
        out, found = self.bake(self.glb, "gltf", "--engine", "embree", "--save-scene", "always")
        self.check(found, 3 / sqrt(256 * 16))
        saved = out / json.loads((out / "manifest.json").read_text())["scene_with_uvs"]
        self.check(self.bake(saved, "again", "--engine", "embree")[1], 3 / sqrt(256 * 16))

    def test_what_is_no_sun_is_refused(self):
        for sun in ("135,45", "135,100,3", "135,45,0", "135,45,3,4", "noon"):
            done = rnmbake("bake", self.blend, "-o", self.top / "no", "--sun", sun)
            self.assertEqual(done.returncode, USAGE, done.stderr)
            self.assertIn("135,45,3", done.stderr)
        self.assertFalse((self.top / "no").exists())

    def test_without_light_the_error_names_both(self):
        done = rnmbake("bake", self.blend, "-o", self.top / "dark")
        self.assertEqual(done.returncode, INVALID_INPUT)
        self.assertIn("--sky", done.stderr)
        self.assertIn("--sun", done.stderr)


if __name__ == "__main__":
    unittest.main()
