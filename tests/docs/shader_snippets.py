#!/usr/bin/env python3
"""Snippets of shaders in the documentation, which are those of shaders/.

    shader_snippets.py --binary build/release/rnmbake    rewrites those that differ

A fenced block follows a line that says where it is from, and which functions it shows, in this order:

    <!-- from shaders/rnm.glsl: rnm_dots, rnm_decode_squared -->
    <!-- from rnmbake shaders --engine hlsl rnm: rnm_dots -->
"""

import argparse
from pathlib import Path
import re
import subprocess

ROOT = Path(__file__).resolve().parents[2]
SNIPPET = re.compile(r"<!-- from (?P<source>[^:\n]+): (?P<names>[\w, ]+) -->\n```(?P<language>\w+)\n(?P<code>.*?)```\n",
                     flags=re.DOTALL)
FENCE = re.compile(r"^```(?:glsl|hlsl)$", flags=re.MULTILINE)


def text_of(source, binary):
    if source.startswith("rnmbake "):
        done = subprocess.run([binary, *source.split()[1:]], check=True, stdout=subprocess.PIPE, encoding="utf-8")
        return done.stdout
    return (ROOT / source).read_text(encoding="utf-8")


def function_in(text, name):
    """The function with the comment before it, as it stands."""
    found = re.search(rf"(?:^//[^\n]*\n)*^\w+ {name}\([^)]*\)\n{{\n.*?^}}\n", text, flags=re.MULTILINE | re.DOTALL)
    if not found:
        raise LookupError(f"no function {name}")
    return found[0]


def expected_code(snippet, binary):
    text = text_of(snippet["source"], binary)
    return "\n".join(function_in(text, name) for name in snippet["names"].split(", "))


def updated(page_text, binary):
    """The page with every snippet as it should be."""
    def replaced(snippet):
        before = snippet[0].partition("```")[0]
        return f"{before}```{snippet['language']}\n{expected_code(snippet, binary)}```\n"
    return SNIPPET.sub(replaced, page_text)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--binary", type=Path, required=True)
    binary = parser.parse_args().binary.resolve()
    for page in (ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md"))):
        old = page.read_text(encoding="utf-8")
        new = updated(old, binary)
        if new != old:
            page.write_text(new, encoding="utf-8")
            print(f"rewrote {page.relative_to(ROOT)}")


if __name__ == "__main__":
    main()
