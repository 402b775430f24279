"""Deliveries to an engine, and what the engine's own package shows of them in headless Chromium against `rnmbake render`."""
import functools
import json
from pathlib import Path
import shutil
import struct
import sys
import tempfile
import unittest

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[2]
sys.path[:0] = [str(HERE.parent), str(ROOT / "tests" / "report")]
import browser  # noqa: E402
from harness import OK, rnmbake, run_blender  # noqa: E402
from pictures import read_picture, unlike_blocks  # noqa: E402
import served  # noqa: E402

PANELS = ROOT / "scenes" / "built" / "panels.blend"
QUICK = ("--bake-engine", "embree", "--resolution", "48", "--samples", "4", "--bounces", "1", "-q")
WIDTH = 240  # of views


def json_of(glb):
    data = glb.read_bytes()
    (length,) = struct.unpack_from("<I", data, 12)
    return json.loads(data[20:20 + length])


def embedded(glb, view):
    """Bytes of a buffer view."""
    data, view = glb.read_bytes(), json_of(glb)["bufferViews"][view]
    (length,) = struct.unpack_from("<I", data, 12)
    first = 28 + length + view.get("byteOffset", 0)
    return data[first:first + view["byteLength"]]


def deliver(engine, source, out, *flags):
    return rnmbake("deliver", source, "--engine", engine, "-o", out, *QUICK, *flags)


def delivered_once(engine, source=PANELS, flags=()):
    """A temporary folder and the scene in it, made matt and delivered into site/."""
    return delivered(engine, source, flags)


@functools.cache  # which holds calls for others that leave out what is the default
def delivered(engine, source, flags):
    folder = tempfile.TemporaryDirectory(prefix="rnmbake-deliver-")
    unittest.addModuleCleanup(folder.cleanup)
    top = Path(folder.name)
    scene = top / "scene.blend"
    run_blender(HERE / "matt_scene.py", scene, scene=source)
    done = deliver(engine, scene, top / "site", *flags)
    assert done.returncode == OK, done.stderr
    return top, scene


class Delivered(unittest.TestCase):
    """All tests of an engine look at one delivery."""

    ENGINE, SOURCE, FLAGS = "threejs", PANELS, ()
    BLACK = 0  # of a picture's brightness, by which surfaces without light may differ

    @classmethod
    def setUpClass(cls):
        cls.top, cls.scene = delivered_once(cls.ENGINE, cls.SOURCE, cls.FLAGS)
        cls.out = cls.top / "site"
        cls.maps = cls.out / ".lightmaps"
        cls.record = json.loads((cls.out / "lightmaps.json").read_text())


class EngineView(Delivered, served.Served):
    """views/ENGINE.html in the delivery's folder, beside the engine's packages of npm."""

    @classmethod
    def setUpClass(cls):
        browser.require()
        super().setUpClass()
        cls.modules = served.node_modules(cls.top, *served.ENGINES[cls.ENGINE])
        cls.furnish(cls.out)
        cls.serve(cls.top, 480, 270)

    @classmethod
    def furnish(cls, site):
        (site / "node_modules").symlink_to(cls.modules)
        for file in (f"{cls.ENGINE}.html", "coarser.js", "three_view.js"):
            shutil.copy(HERE / "views" / file, site)

    def rendered(self, decode, maps, height):
        """What `rnmbake render` makes of the view; the scene's camera has its aspect."""
        picture = self.top / f"{decode}.exr"
        done = rnmbake("render", self.scene, "--lightmaps", maps, "--decode", decode, "-o", picture, "--resolution",
                       f"{WIDTH}x{height}", "--samples", "64", "-q")
        self.assertEqual(done.returncode, OK, done.stderr)
        read = read_picture(picture)
        self.assertEqual(read[:2], (WIDTH, height))
        return read

    def assert_same_view(self, decode, flat=False, site="site", maps=None):
        """Over blocks of pixels that see nothing but surfaces, the mean of both is the same within 2 %."""
        self.open(f"{site}/{self.ENGINE}.html")
        height = round(WIDTH / json_of(self.out / "scene.glb")["cameras"][0]["perspective"]["aspectRatio"])
        seen = self.browser.run(f"seen({WIDTH}, {height}, {str(flat).lower()})")
        self.assertEqual(self.problems(), [])

        def light(x, y):  # rows of the browser run from the bottom
            first = 3 * ((height - 1 - y) * WIDTH + x)
            return seen[first:first + 3]

        compared, off = unlike_blocks(self.rendered(decode, maps or self.maps, height), light, self.BLACK)
        self.assertGreater(compared, 250)
        self.assertLessEqual(len(off), .05 * compared, off[:20])

    def assert_page_shows_the_scene(self):
        self.open("site/index.html")
        self.assertEqual(self.browser.run("document.getElementById('said').textContent"), "")
        self.assertEqual(self.problems(), [])
