"""Scenes, most of them made by others, through `rnmbake deliver`: what three.js shows in headless Chromium of the whole
delivery, and of its .glb alone, against `rnmbake render`.

    RNMBAKE_BINARY=build/release/rnmbake python3 tests/with_blender/deliver/scenes_check.py [Dungeon|LivingRoom|Staircase]

As engine_view.py; scenes that are not there are left out, with a word.
"""
import unittest

from engine_view import ROOT, EngineView
import served

OTHERS = ROOT.parent / "shared" / "scenes"


class Scene:
    """By both targets. Fine enough that a texel at the edge of a chart is no wider than a block of pixels."""

    FLAGS = ("--resolution", "256", "--samples", "16")
    BLACK = .001

    @classmethod
    def setUpClass(cls):
        if not cls.SOURCE.exists():
            served.skip(f"no {cls.SOURCE}")
        super().setUpClass()

    def test_light_is_that_of_render(self):
        if self.ENGINE == "gltf":
            self.assert_same_view("single", flat=True)
        else:
            self.assert_same_view("vrad")


class Dungeon(Scene, EngineView):
    SOURCE, FLAGS = ROOT / "scenes" / "built" / "dungeon.blend", ()


class DungeonGltf(Dungeon):
    ENGINE = "gltf"


class LivingRoom(Scene, EngineView):
    SOURCE = OTHERS / "living_room" / "living_room.blend"


class LivingRoomGltf(LivingRoom):
    ENGINE = "gltf"


class Staircase(Scene, EngineView):
    SOURCE = OTHERS / "staircase2" / "staircase2.blend"


class StaircaseGltf(Staircase):
    ENGINE = "gltf"


if __name__ == "__main__":
    unittest.main()
