"""What the checks of engines share: one bake of axes_scene.py, its deliveries, and what an engine's formula must return."""
import atexit
import functools
from pathlib import Path
import sys
import tempfile
import unittest

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parent), str(HERE.parents[1] / "report")]
from harness import OK, UNSUPPORTED, rnmbake, run_blender  # noqa: E402
from page_light import covered_texels  # noqa: E402

BAKE = ("--engine", "embree", "--resolution", "48", "--samples", "16", "--bounces", "1", "--save-scene", "always", "-q")


@functools.cache
def top():
    folder = tempfile.TemporaryDirectory(prefix="rnmbake-engines-")
    atexit.register(folder.cleanup)
    return Path(folder.name)


@functools.cache
def baked():
    """The scene of axes_scene.py, and its lightmaps with frames."""
    scene, maps = top() / "axes.blend", top() / "maps"
    run_blender(HERE / "axes_scene.py", scene)
    done = rnmbake("bake", scene, "-o", maps, "--frames", "--dilate", "4", *BAKE)
    assert done.returncode == OK, done.stderr
    return scene, maps


@functools.cache
def same_names():
    """Without frames, with two objects whose names become one where . and _ are the same."""
    scene, maps = top() / "names.blend", top() / "names"
    run_blender(HERE / "axes_scene.py", scene, "box.a", "box_a")
    done = rnmbake("bake", scene, "-o", maps, *BAKE, "--resolution", "16", "--samples", "1", "--objects", "box*")
    assert done.returncode == OK, done.stderr
    return maps


@functools.cache
def delivered(engine, *flags):
    out = top() / "-".join((engine, *flags))
    done = rnmbake("deliver", baked()[1], "--engine", engine, "-o", out, "-q", *flags)
    assert done.returncode == OK, done.stderr
    return out


class Engine(unittest.TestCase):
    def assert_bakes(self, decode, delivery, tolerance, to_engine, fits, share):
        """decode(texel, normal): E/pi for a normal along the engine's axes. The flat bake comes back everywhere, those of
        tilted normals where the packing has room for them (`fits`), in that share of the texels at least. The tolerance is
        one of the texel's brightest bake."""
        texels = covered_texels(delivery, baked()[1])
        self.assertGreater(len(texels), 3000)
        whole = 0
        for texel in texels:
            room = fits(texel)
            whole += room
            near = tolerance * max(max(self.packed(light)) for _, light in texel.baked.values()) + 1e-3
            for name, (normal, light) in texel.baked.items():
                if room or name == "flat":
                    off = max(abs(a - b) for a, b in zip(self.packed(decode(texel, to_engine(normal))), self.packed(light)))
                    self.assertLessEqual(off, near, (name, texel.page, texel.x, texel.y))
        self.assertGreater(whole / len(texels), share)

    @staticmethod
    def packed(light):
        """What of R, G and B the encoding keeps for tilted normals."""
        return light

    def refused(self, engine, *words, flags=()):
        done = rnmbake("deliver", same_names(), "--engine", engine, "-o", top() / "refused", "-q", *flags)
        self.assertEqual(done.returncode, UNSUPPORTED, done.stderr)
        self.assertEqual(len(done.stderr.strip().splitlines()), 1, done.stderr)
        for word in words:
            self.assertIn(word, done.stderr)
        self.assertFalse((top() / "refused" / "lightmaps.json").exists())
