"""`rnmbake deliver` to engines of the web that read raw pages: what their npm packages show of the panels scene in headless
Chromium against `rnmbake render`.

    RNMBAKE_BINARY=build/release/rnmbake python3 tests/with_blender/deliver/web_engines_check.py [PlayCanvas|Babylon]

RNMBAKE_NODE_MODULES names a node_modules folder that holds the packages; without it npm fetches them. Left out, with a word,
where there is no Chromium, npm or network.
"""
import unittest

from engine_view import EngineView, deliver
from harness import OK, rnmbake


class PlayCanvas(EngineView):
    ENGINE = "playcanvas"

    def test_directional_light_is_that_of_render(self):
        self.assert_same_view("vrad")

    def test_flat_light_is_that_of_render(self):
        self.assert_same_view("single", flat=True)

    def test_values_below_zero_arrive(self):
        """The layers of zh3 have them."""
        out = self.top / "zh3"
        done = deliver(self.ENGINE, self.maps, out, "--encoding", "zh3")
        self.assertEqual(done.returncode, OK, done.stderr)
        self.furnish(out)
        maps = self.top / "zh3 maps"
        done = rnmbake("convert", self.maps, "--to", "zh3", "-o", maps, "-q")
        self.assertEqual(done.returncode, OK, done.stderr)
        self.assert_same_view("encoded", site="zh3", maps=maps)

    def test_the_page_shows_the_scene(self):
        self.assert_page_shows_the_scene()


class Babylon(EngineView):
    ENGINE = "babylon"

    def test_directional_light_is_that_of_render(self):
        self.assert_same_view("vrad")

    def test_flat_light_is_that_of_render(self):
        self.assert_same_view("single", flat=True)

    def test_the_page_shows_the_scene(self):
        self.assert_page_shows_the_scene()


if __name__ == "__main__":
    unittest.main()
