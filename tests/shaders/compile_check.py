#!/usr/bin/env python3
"""Compiles each file of shaders/ with glslang: as GLSL 3.30 and 4.50, as ESSL 3.00 and as HLSL.

Fails where glslangValidator is missing. What the files compute is tests/shaders/*_test.cpp's to check.
"""

from pathlib import Path
import shutil
import subprocess
import tempfile
import unittest

SHADERS = Path(__file__).resolve().parents[2] / "shaders"
INCLUDES = "#extension GL_GOOGLE_include_directive : require\n"
PRECISION = "precision highp float;\nprecision highp int;\nprecision highp sampler2D;\n"
LANGUAGES = {
    # name: (ending, before the file, after it, glslang's arguments)
    "GLSL 3.30": ("frag", "#version 330\n" + INCLUDES, "void main() {}\n", ["-l"]),
    "GLSL 4.50": ("comp", "#version 450\n" + INCLUDES, "layout(local_size_x = 1) in;\nvoid main() {}\n", ["-l"]),
    "ESSL 3.00": ("frag", "#version 300 es\n" + INCLUDES + PRECISION, "void main() {}\n", ["-l"]),
    "HLSL": ("hlsl", "", "float4 main() : SV_Target { return float4(0, 0, 0, 0); }\n",
             ["-DRNM_HLSL", "-D", "-V", "-S", "frag", "-e", "main"]),
}


def compile_text(text, language):
    """What glslang says of it; nothing where it compiles."""
    ending, before, after, arguments = LANGUAGES[language]
    with tempfile.TemporaryDirectory(prefix="rnmbake-shaders-") as folder:
        unit = Path(folder) / f"unit.{ending}"
        unit.write_text(before + text + after, encoding="utf-8")
        done = subprocess.run(["glslangValidator", f"-I{SHADERS}", *arguments, unit], cwd=folder,
                              stdout=subprocess.PIPE, encoding="utf-8", timeout=60)
    return done.stdout if done.returncode else ""


class Compile(unittest.TestCase):
    def setUp(self):
        self.assertIsNotNone(shutil.which("glslangValidator"), "missing: apt-get install glslang-tools")

    def test_each_file_in_each_language(self):
        files = sorted(SHADERS.glob("*.glsl"))
        self.assertGreater(len(files), 10)
        for file in files:
            for language in LANGUAGES:
                with self.subTest(file=file.name, language=language):
                    self.assertEqual(compile_text(f'#include "{file.name}"\n', language), "")

    def test_all_files_together(self):
        """No two files define the same function, and none is taken twice."""
        together = "".join(f'#include "{file.name}"\n' for file in sorted(SHADERS.glob("*.glsl")))
        for language in LANGUAGES:
            with self.subTest(language=language):
                self.assertEqual(compile_text(together, language), "")

    def test_a_mistake_is_found(self):
        for language in LANGUAGES:
            with self.subTest(language=language):
                wrong = '#include "rnm.glsl"\nvec3 wrong(vec3 n) { return rnm_decode_linear(n, n, n); }\n'
                self.assertIn("rnm_decode_linear", compile_text(wrong, language))


if __name__ == "__main__":
    unittest.main()
