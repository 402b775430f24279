"""A scene of three objects, whose launches are counted: what the checks of reuse begin with."""
import hashlib
import json
import os
from pathlib import Path
import shutil
import signal
import subprocess
import tempfile
import time
import unittest

from harness import LIMIT_SECONDS, OK, SCENES, binary, blender, environment, run_blender

WRAPPER = """#!/bin/bash
for word in "$@"; do case $word in *_entry.py) basename "$word" >> "$LAUNCHES";; esac; done
exec "{blender}" "$@"
"""
ROUNDS = int(os.environ.get("ROUNDS", "1"))  # of each victim
FEW = ("--resolution", "16", "--samples", "8", "--bounces", "2", "--save-scene", "never")
EMBREE = (*FEW, "--engine", "embree")
# Enough for several passes: the model gives a texel-sample 3 us, and a pass 10 s.
MANY = ("--resolution", "64", "--samples", "512", "--bounces", "0", "--save-scene", "never")


class Reuse(unittest.TestCase):
    COMMAND = "bake"

    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory(prefix="rnmbake-reuse-")
        cls.addClassCleanup(folder.cleanup)
        cls.origin = Path(folder.name) / "origin"
        cls.origin.mkdir()
        run_blender(SCENES / "reuse_scene.py", cls.origin / "room.blend")

    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="rnmbake-reuse-")
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        shutil.copytree(self.origin, self.folder / "scene")
        self.scene = self.folder / "scene" / "room.blend"
        self.launches = self.folder / "launches"
        self.wrapper = self.folder / "blender"
        self.wrapper.write_text(WRAPPER.format(blender=blender()), encoding="utf-8")
        self.wrapper.chmod(0o755)

    def command(self, *flags, out="out", cache="cache"):
        return [binary(), self.COMMAND, str(self.scene), "-o", str(self.folder / out), "--blender", str(self.wrapper),
                "--cache", str(self.folder / cache) if cache != "none" else cache, *flags]

    def bake(self, *flags, **where):
        """Scripts that Blender ran, and what was said."""
        self.launches.write_text("", encoding="utf-8")
        done = subprocess.run(self.command(*flags, **where), env=self.environment(), stdin=subprocess.DEVNULL,
                              capture_output=True, encoding="utf-8", timeout=LIMIT_SECONDS)
        self.assertEqual(done.returncode, OK, done.stderr)
        return self.launches.read_text(encoding="utf-8").split(), done.stderr

    def environment(self):
        return {**environment(), "LAUNCHES": str(self.launches)}

    def change(self, what):
        run_blender(SCENES / "reuse_scene.py", self.scene, what, scene=self.scene)

    def pictures(self, out="out"):
        return {str(file.relative_to(self.folder / out)): hashlib.sha256(file.read_bytes()).hexdigest()
                for file in sorted((self.folder / out).rglob("*.exr"))}

    def kept(self, kind):
        return {file.name for file in (self.folder / "cache" / kind).glob("*/*")}

    def set_box(self, settings):
        """The scene from now on; `settings` are those of the box."""
        project = self.scene.with_name("room.toml")
        project.write_text('[scene]\nfile = "room.blend"\n[bake]\nresolution = 16\n'
                           f'[[override]]\nobjects = "box"\n{settings}\n', encoding="utf-8")
        self.scene = project

    def kill_when(self, is_time, *flags):
        self.launches.write_text("", encoding="utf-8")
        process = subprocess.Popen(self.command(*flags), env=self.environment(), stdin=subprocess.DEVNULL,
                                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        while not is_time():
            self.assertIsNone(process.poll(), "it was over before it could be killed")
            time.sleep(0.05)
        process.send_signal(signal.SIGKILL)
        process.wait(LIMIT_SECONDS)

    def samples(self, out="out"):
        manifest = json.loads((self.folder / out / "manifest.json").read_text(encoding="utf-8"))
        return {entry["key"]: entry["samples"] for entry in manifest["objects"]}
