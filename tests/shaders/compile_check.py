#!/usr/bin/env python3
"""Compiles each file of shaders/ with glslang: as GLSL 3.30 and 4.50, as ESSL 3.00 and as HLSL.

    compile_check.py --binary build/release/rnmbake

So is what `rnmbake shaders` prints for each engine. Fails where glslangValidator is missing. What the files compute is tests/shaders/*_test.cpp's to check.
"""

import argparse
from pathlib import Path
import re
import shutil
import subprocess
import sys
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

ENGINES = {  # and the languages that its text must be; Godot's is a dialect of ESSL that glslang takes for it
    "glsl": ["GLSL 3.30", "GLSL 4.50", "ESSL 3.00"],
    "hlsl": ["HLSL"],
    "unity": ["HLSL"],
    "godot": ["ESSL 3.00"],
    "unreal": ["HLSL"],
    "threejs": ["ESSL 3.00"],
    "playcanvas": ["ESSL 3.00"],
    "bevy": [],  # WGSL, which glslang does not know
    "source": ["HLSL"],  # without samplers: glslang does not know those of Direct3D 9
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


def in_custom_node(text):
    """Unreal puts a node's code into a function."""
    return f"float3 CustomExpression0(float3 N)\n{{\n{text}return rnmbake.rnm_decode_squared(N, N, N, N);\n}}\n"


class Compile(unittest.TestCase):
    binary = None

    def shaders(self, *arguments):
        done = subprocess.run([self.binary, "shaders", *arguments], check=True, stdout=subprocess.PIPE, encoding="utf-8")
        return done.stdout

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

    def test_what_is_printed_for_each_engine(self):
        listed = self.shaders("--list").partition("Engines:")[2]
        self.assertEqual(re.findall(r"^  ([a-z]+) ", listed, flags=re.MULTILINE), [*ENGINES, "blender"])  # nodes, no text
        names = [file.stem for file in sorted(SHADERS.glob("*.glsl")) if file.stem != "rnmbake_types"]
        for engine, languages in ENGINES.items():
            alone = names if engine in ("glsl", "unity", "unreal") else []  # one of each kind of text
            everything = [name for name in names if "normal_shadows" not in name] if engine == "source" else []
            for chosen in (everything, *([name] for name in alone)):
                if engine == "unreal" and chosen:
                    chosen = ["rnm", *chosen]  # which in_custom_node() calls
                text = self.shaders("--engine", engine, *chosen)
                if engine == "unreal":
                    text = in_custom_node(text)
                for language in languages:
                    with self.subTest(engine=engine, shaders=chosen, language=language):
                        self.assertEqual(compile_text(text, language), "")

    def test_a_mistake_is_found(self):
        for language in LANGUAGES:
            with self.subTest(language=language):
                wrong = '#include "rnm.glsl"\nvec3 wrong(vec3 n) { return rnm_decode_linear(n, n, n); }\n'
                self.assertIn("rnm_decode_linear", compile_text(wrong, language))


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--binary", type=Path, required=True)
    args, rest = parser.parse_known_args()
    Compile.binary = args.binary.resolve()
    unittest.main(argv=[sys.argv[0], *rest])
