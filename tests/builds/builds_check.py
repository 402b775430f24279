"""Lightmaps as a part of real builds: CMake with Ninja and with make, and the rules that docs/builds.md shows.

    RNMBAKE_BINARY=build/release/rnmbake RNMBAKE_BUILD=build/release python3 tests/builds/builds_check.py

Installs the build into a folder of its own and bakes a plane of 16 texels there.
"""
import json
import os
from pathlib import Path
import re
import shutil
import subprocess
import sys
import tempfile
import time
import unittest

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests" / "with_blender"))
from harness import environment, run_blender  # noqa: E402

BUILD = Path(os.environ["RNMBAKE_BUILD"]).resolve()
LIMIT_SECONDS = 300
SCENE = "plane and sun.blend"  # CMake 3.25 writes a # into its depfiles as it is
PROJECT = f"""
cmake_minimum_required(VERSION 3.21)
project(game NONE)
find_package(rnmbake 0.1 REQUIRED)
rnmbake_add_lightmaps(TARGET lightmaps SCENE "{SCENE}" CONFIG bake.toml OUTPUT maps OBJECTS "pla*" "*ne"
                      FLAGS --samples 1 --quiet)
add_custom_command(OUTPUT packed COMMAND sh -c "echo packed >> packings && touch packed"
                   DEPENDS "${{CMAKE_CURRENT_BINARY_DIR}}/maps/manifest.json" VERBATIM)
add_custom_target(pack ALL DEPENDS packed)
"""
SETTINGS = "[bake]\nresolution = 16\nbounces = 0\nbasis = \"my directions.toml\"\n\n[output]\nsave_scene = \"never\"\n"
DIRECTIONS = "[[basis]]\nname = \"{name}\"\ndirection = [0.0, 0.0, 1.0]\n"  # no CMakeLists.txt names that file


def run(*command, cwd, path=None, fails=False):
    env = environment()
    env.pop("MAKEFLAGS", None)
    if path:
        env["PATH"] = f"{path}{os.pathsep}{env['PATH']}"
    done = subprocess.run([str(word) for word in command], cwd=cwd, env=env, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, encoding="utf-8", timeout=LIMIT_SECONDS)
    if fails != (done.returncode != 0):
        raise AssertionError(f"{command} ended with {done.returncode}: {done.stdout}")
    return done.stdout


def shown(name):
    """The block of docs/builds.md that is marked as tested under that name."""
    text = (ROOT / "docs" / "builds.md").read_text(encoding="utf-8")
    return re.search(rf"<!-- tested: {name} -->\n```\w+\n(.*?)```", text, re.DOTALL)[1]


class Builds(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        for tool in ("cmake", "ninja", "make"):
            if not shutil.which(tool):
                raise unittest.SkipTest(f"SKIPPED: no {tool} on this machine")
        folder = tempfile.TemporaryDirectory(prefix="rnmbake-builds-")
        cls.addClassCleanup(folder.cleanup)
        cls.folder = Path(folder.name)
        cls.prefix = cls.folder / "usr"
        run("cmake", "--install", BUILD, "--prefix", cls.prefix, cwd=cls.folder)
        cls.scene = cls.folder / "plane.blend"
        run_blender(ROOT / "scenes" / "make.py", "plane_sun", cls.scene)

    def project(self, name, generator=None):
        """A source folder with a scene; with a generator, configured into its folder b."""
        source = self.folder / name
        source.mkdir()
        shutil.copy(self.scene, source / (SCENE if generator else "hall.blend"))
        if generator:
            (source / "CMakeLists.txt").write_text(PROJECT, encoding="utf-8")
            (source / "bake.toml").write_text(SETTINGS, encoding="utf-8")
            self.directions(source, "up")
            run("cmake", "-G", generator, "-S", source, "-B", source / "b", f"-DCMAKE_PREFIX_PATH={self.prefix}", cwd=source)
        return source

    @staticmethod
    def directions(source, name):
        (source / "my directions.toml").write_text(DIRECTIONS.format(name=name), encoding="utf-8")

    def manual(self, *command, cwd, fails=False):
        """With the installed program in the PATH, as the rules of the documentation have it."""
        return run(*command, cwd=cwd, path=self.prefix / "bin", fails=fails)

    @staticmethod
    def touch(path):
        """Later than all that was made."""
        os.utime(path, (time.time() + 2, time.time() + 2))
        time.sleep(2.1)

    @staticmethod
    def packings(folder):
        return len((folder / "packings").read_text().splitlines())

    def test_cmake_with_ninja(self):
        source = self.project("by ninja", "Ninja")
        out = source / "b"
        self.assertIn("Baking lightmaps", run("cmake", "--build", out, cwd=source))
        objects = json.loads((out / "maps" / "manifest.json").read_text(encoding="utf-8"))["objects"]
        self.assertEqual([(one["status"], one["width"], one["samples"]) for one in objects], [("baked", 16, 1)])
        self.assertIn("no work to do", run("ninja", cwd=out))
        self.assertEqual(self.packings(out), 1)
        # The scene is newer, the light the same: the bake runs, and nothing after it.
        self.touch(source / SCENE)
        self.assertIn("Baking lightmaps", run("ninja", cwd=out))
        self.assertEqual(self.packings(out), 1)
        self.assertIn("no work to do", run("ninja", cwd=out))
        # A file that only the depfile knows.
        self.directions(source, "above")
        self.assertIn("Baking lightmaps", run("ninja", cwd=out))
        self.assertEqual(self.packings(out), 2)
        self.assertIn("no work to do", run("ninja", cwd=out))

    def test_cmake_with_make(self):
        source = self.project("by make", "Unix Makefiles")
        out = source / "b"
        self.assertIn("Baking lightmaps", run("cmake", "--build", out, cwd=source))
        self.assertNotIn("Baking lightmaps", run("cmake", "--build", out, cwd=source))
        self.assertEqual(self.packings(out), 1)
        self.touch(source / "my directions.toml")
        self.assertIn("Baking lightmaps", run("cmake", "--build", out, cwd=source))
        self.assertNotIn("Baking lightmaps", run("cmake", "--build", out, cwd=source))

    def test_a_wrong_call_is_named(self):
        source = self.folder / "wrong"
        source.mkdir()
        (source / "CMakeLists.txt").write_text(PROJECT.replace("OUTPUT maps", ""), encoding="utf-8")
        said = run("cmake", "-G", "Ninja", "-S", source, "-B", source / "b", f"-DCMAKE_PREFIX_PATH={self.prefix}", cwd=source,
                   fails=True)
        self.assertIn("rnmbake_add_lightmaps: OUTPUT is missing", said)

    def test_the_ninja_rule_of_the_documentation(self):
        source = self.project("ninja rule")
        rule = shown("ninja").replace("--samples 64", "--samples 1 --resolution 16 --save-scene never")
        (source / "build.ninja").write_text(rule + "rule pack\n  command = echo packed >> packings && touch packed\n"
                                            "build packed: pack lightmaps/manifest.json\n", encoding="utf-8")
        self.manual("ninja", cwd=source)
        self.assertIn("    hall.blend\n", self.manual("ninja", "-t", "deps", "lightmaps/manifest.json", cwd=source))
        self.touch(source / "hall.blend")
        self.manual("ninja", cwd=source)
        self.assertEqual(self.packings(source), 1)
        self.assertIn("no work to do", self.manual("ninja", cwd=source))

    def test_the_make_rule_of_the_documentation(self):
        source = self.project("make rule")
        rule = shown("make").replace("--samples 64", "--samples 1 --resolution 16 --save-scene never --jobs 2")
        (source / "Makefile").write_text(rule, encoding="utf-8")
        said = self.manual("make", "-j3", cwd=source)
        self.assertNotIn("INTERNAL", said, "make counts its tokens")
        self.assertIn("up to date", self.manual("make", cwd=source))
        self.touch(source / "hall.blend")
        self.assertIn("rnmbake bake", self.manual("make", cwd=source))
        self.assertIn("up to date", self.manual("make", cwd=source))
        self.assertIn("hall.blend", (source / "lightmaps.d").read_text())

    def test_the_stamp_of_the_documentation(self):
        source = self.project("stamp rule")
        rule = shown("stamp").replace("--samples 64", "--samples 1 --resolution 16 --save-scene never")
        (source / "Makefile").write_text("packed: lightmaps/manifest.json\n\techo packed >> packings\n\ttouch packed\n\n" + rule,
                                         encoding="utf-8")
        self.manual("make", cwd=source)
        self.touch(source / "hall.blend")
        said = self.manual("make", cwd=source)
        self.assertIn("rnmbake bake", said)
        self.assertEqual(self.packings(source), 1, said)
        self.assertNotIn("rnmbake bake", self.manual("make", cwd=source))


if __name__ == "__main__":
    unittest.main()
