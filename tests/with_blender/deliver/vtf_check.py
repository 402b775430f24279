"""Textures of `rnmbake deliver --engine source`, read by a library of others: vtfpp, of sourcepp from PyPI.

    RNMBAKE_BINARY=build/release/rnmbake python3 tests/with_blender/deliver/vtf_check.py

RNMBAKE_BUILD names a folder for an environment that holds it, made at the first run.
"""
import os
from pathlib import Path
import struct
import subprocess
import sys
import unittest

from engine_case import delivered
from source_case import read_vtf

SOURCEPP = "sourcepp==2026.9.11"
LIMIT_SECONDS = 300
READER = """
import sys
from sourcepp import vtfpp
texture = vtfpp.VTF(sys.argv[1])
said = (bool(texture), texture.version, texture.width, texture.height, texture.mip_count, texture.format.name)
sys.stdout.buffer.write(repr(said).encode() + b"\\n" + bytes(texture.get_image_data_raw()))
"""


def run(*words):
    return subprocess.run([str(word) for word in words], stdin=subprocess.DEVNULL, capture_output=True, timeout=LIMIT_SECONDS)


def python_with_sourcepp():
    place = Path(os.environ.get("RNMBAKE_BUILD", "build/release")).resolve() / "sourcepp"
    program = place / "bin/python"
    for words in ([] if (place / "ready").exists() else [(sys.executable, "-m", "venv", place),
                                                         (place / "bin/pip", "install", "--quiet", SOURCEPP)]):
        done = run(*words)
        if done.returncode:
            last = (done.stdout + done.stderr).decode(errors="replace").strip().splitlines()[-1:]
            raise unittest.SkipTest(f"SKIPPED: no {SOURCEPP} to test with: {last}")
    (place / "ready").touch()
    return program


class Vtf(unittest.TestCase):
    def test_others_read_the_textures(self):
        program, out = python_with_sourcepp(), delivered("source")
        files = sorted(out.glob("*.vtf"))
        self.assertEqual(len(files), 5)
        for file in files:
            done = run(program, "-c", READER, file)
            self.assertEqual(done.returncode, 0, done.stderr)
            said, _, data = done.stdout.partition(b"\n")
            width, height, rows = read_vtf(file)
            self.assertEqual(said.decode(), repr((True, 2, width, height, 1, "RGBA16161616F")))
            self.assertEqual(list(struct.iter_unpack("<4e", data)), [texel for row in rows for texel in row])


if __name__ == "__main__":
    unittest.main()
