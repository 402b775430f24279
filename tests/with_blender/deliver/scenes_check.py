"""Scenes, most of them made by others, through `rnmbake deliver`: what three.js shows in headless Chromium of the whole
delivery, and of its .glb alone, against `rnmbake render`.

    RNMBAKE_BINARY=build/release/rnmbake python3 tests/with_blender/deliver/scenes_check.py [Dungeon|LivingRoom|Staircase|House]

As engine_view.py; scenes that are not there are left out, with a word.
"""
from pathlib import Path
import tempfile
import unittest

from engine_view import ROOT, EngineView
from harness import OK, rnmbake
import served

OTHERS = ROOT.parent / "shared" / "scenes"


class Scene:
    """By both targets. Fine enough that a texel at the edge of a chart is no wider than a block of pixels."""

    FLAGS = ("--resolution", "192", "--samples", "16")

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
    SOURCE = ROOT / "scenes" / "built" / "dungeon.blend"


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


class House(Scene, EngineView):
    """A .glb with UVs for lightmaps and no light: as the importer of `bake` reads it."""

    SOURCE = OTHERS / "house" / "house.glb"
    FLAGS = (*Scene.FLAGS, "--sky", "1")

    @classmethod
    def setUpClass(cls):
        if cls.SOURCE.suffix == ".glb" and cls.SOURCE.exists():
            folder = tempfile.TemporaryDirectory(prefix="rnmbake-house-")
            cls.addClassCleanup(folder.cleanup)
            done = rnmbake("bake", cls.SOURCE, "-o", folder.name, "--save-scene", "always", "--sky", "1", "--resolution", "8",
                           "--samples", "1", "-q")
            assert done.returncode == OK, done.stderr
            (cls.SOURCE,) = Path(folder.name).glob("*.blend")
        super().setUpClass()


class HouseGltf(House):
    ENGINE = "gltf"


if __name__ == "__main__":
    unittest.main()
