#!/usr/bin/env python3
"""Checks what the documentation says against what is there.

    check_docs.py --binary build/release/rnmbake

Links lead somewhere; every flag exists; docs/README.md lists every page; src/README.md has the floors that
tools/dev/floors.py enforces; blender_scripts/README.md names every entry script; files and folders that comments name
are there; snippets of shaders are those of shaders/.
"""

import argparse
import ast
import functools
import importlib.util
import io
import os
from pathlib import Path
import re
import subprocess
import sys
import tokenize
import unittest

ROOT = Path(__file__).resolve().parents[2]
NOT_OURS = {".git", ".roots", "build", "out", "shared"}

# Flags of other programs, as the documentation shows them.
FOREIGN_FLAGS = {
    "--factory-startup", "--python", "--python-exit-code",  # blender
    "--install", "--preset", "--build", "--prefix",  # cmake
    "--user", "--scope",  # systemd-run
    "--array", "--cpus-per-task", "--dependency", "--job-name", "--open-mode", "--requeue",  # sbatch
    "--security-opt", "--privileged",  # docker
    "--info", "--ch", "--chnames",  # oiiotool
    "--gtest_filter",  # GoogleTest
}
HIDDEN_FLAGS = {"--print-settings-doc"}  # of rnmbake; generates a part of the documentation

SCRIPTS = ROOT / "blender_scripts"
CODE = ("src", "tests", "bench", "blender_scripts", "scenes", "tools", "cmake")
SOURCES = (ROOT, ROOT / "src", ROOT / "tests", ROOT / "tests" / "support", SCRIPTS)  # comments name paths below these
PLACEHOLDERS = {"src/NAME", "src/NAME/room.cmake", "core/b.py", "scenes/built"}

FLAG = re.compile(r"(?<![\w-])--[a-z][a-z0-9_-]*")
LINK = re.compile(r"\]\(([^)\s]+)\)")
PATH = re.compile(r"(?<![\w./$:<\"-])(?:[\w-]+/)+[\w-]+(?:\.[a-z]+)?(?![\w/*])")
CALL = re.compile(r"\brnmbake ([a-z]+)\b(.*)")


def pages():
    for folder, folders, files in os.walk(ROOT):
        folders[:] = sorted(f for f in folders if f not in NOT_OURS)
        yield from (Path(folder) / name for name in sorted(files) if name.endswith(".md"))


def numbered_lines(page):
    """(place, line), for messages."""
    for number, line in enumerate(page.read_text(encoding="utf-8").splitlines(), start=1):
        yield f"{page.relative_to(ROOT)}:{number}", line


def without_code(page):
    """The lines outside fenced blocks."""
    fenced = False
    for place, line in numbered_lines(page):
        if line.lstrip().startswith("```"):
            fenced = not fenced
        elif not fenced:
            yield place, line


def anchors(page):
    """What GitHub makes of the headings."""
    for _, line in without_code(page):
        if line.startswith("#"):
            kept = re.sub(r"[^\w\- ]", "", line.lstrip("#").strip().lower())
            yield kept.replace(" ", "-")


def flags_in(text):
    expanded = re.sub(r"--\[no-\]([a-z0-9-]+)", r"--\1 --no-\1", text)
    return set(FLAG.findall(expanded))


def commands_in(text):
    """What a help lists under Subcommands."""
    _, _, listed = text.partition("Subcommands:")
    return re.findall(r"^  ([a-z-]+) ", listed.split("Examples:")[0], flags=re.MULTILINE)


def cpp_comments(text):
    for number, line in enumerate(text.splitlines(), start=1):
        code, _, comment = line.partition("//")
        if code.count('"') % 2 == 0:
            yield number, comment


def python_comments(text):
    """Docstrings, too."""
    for token in tokenize.generate_tokens(io.StringIO(text).readline):
        if token.type == tokenize.COMMENT:
            yield token.start[0], token.string
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, (ast.Module, ast.ClassDef, ast.FunctionDef)) and ast.get_docstring(node):
            yield from enumerate(node.body[0].value.value.splitlines(), start=node.body[0].lineno)


def shell_comments(text):
    for number, line in enumerate(text.splitlines(), start=1):
        if line.lstrip().startswith("#"):
            yield number, line


COMMENTS = {".h": cpp_comments, ".cpp": cpp_comments, ".js": cpp_comments, ".py": python_comments,
            ".sh": shell_comments, ".cmake": shell_comments}


def paths_in_comments():
    """(file, line, path) of what looks like a file or folder of ours: its first folder is one."""
    ours = {folder.name for base in SOURCES for folder in base.iterdir() if folder.is_dir()} - NOT_OURS
    for folder in CODE:
        for file in sorted(path for path in (ROOT / folder).rglob("*") if path.suffix in COMMENTS):
            for number, comment in COMMENTS[file.suffix](load_text(file)):
                for path in PATH.findall(comment):
                    if path.split("/")[0] in ours and path not in PLACEHOLDERS:
                        yield file, number, path


def is_there(path, beside):
    """As it stands, or without its suffix."""
    return any((base / path).exists() or any((base / path).parent.glob(f"{Path(path).name}.*"))
               for base in (*SOURCES, beside))


def load_text(path):
    return path.read_text(encoding="utf-8")


def load(path):
    spec = importlib.util.spec_from_file_location(path.stem, path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


class Documentation(unittest.TestCase):
    binary = None

    @classmethod
    def help_of(cls, *command):
        done = subprocess.run([cls.binary, *command, "--help"], check=True, stdout=subprocess.PIPE, encoding="utf-8")
        return done.stdout

    @classmethod
    def flags_below(cls, *command):
        """Flags of a command and of those below it."""
        text = cls.help_of(*command)
        below = commands_in(text)
        return flags_in(text).union(*(cls.flags_below(*command, name) for name in below))

    @classmethod
    @functools.lru_cache(maxsize=1)
    def flags_by_command(cls):
        overview = cls.help_of()
        common = flags_in(overview) | HIDDEN_FLAGS
        return {name: common | cls.flags_below(name) for name in commands_in(overview)}

    def test_words_for_materials_and_lights_are_explained(self):
        """Whatever a report may say is outside the model is in the table of docs/inspect.md."""
        describe = load_text(SCRIPTS / "scene_ops" / "describe.py")
        notes = load_text(SCRIPTS / "lambert" / "notes.py")
        words = set(re.findall(r'(?:yield|outside\.add\(|NotCarried\()\s*"([^"]+)"', describe + notes))
        words |= set(re.findall(r'^    "[A-Z_]+": "([^"]+)"', describe, flags=re.MULTILINE))
        words |= set(re.findall(r'^    "([a-z ]+)": \(', describe, flags=re.MULTILINE))
        self.assertGreater(len(words), 30)
        explained = load_text(ROOT / "docs" / "inspect.md")
        self.assertEqual([word for word in sorted(words) if f"`{word}`" not in explained], [],
                         "explain them in docs/inspect.md under The words")

    def test_pictures_do_not_say_where_they_were_made(self):
        for picture in sorted((ROOT / "docs" / "images").iterdir()):
            with self.subTest(picture=picture.name):
                self.assertNotIn(b"oiiotool", picture.read_bytes(), "its metadata holds a command line; write it with --nosoftwareattrib")

    def test_links_lead_somewhere(self):
        for page in pages():
            for place, line in without_code(page):
                for target in LINK.findall(line):
                    if "://" in target:
                        continue
                    name, _, anchor = target.partition("#")
                    file = page.parent / name if name else page
                    with self.subTest(place, link=target):
                        self.assertTrue(file.exists())
                        if anchor:
                            self.assertIn(anchor, set(anchors(file)))

    def test_flags_exist(self):
        by_command = self.flags_by_command()
        dev = subprocess.run([ROOT / "dev"], check=True, stdout=subprocess.PIPE, encoding="utf-8").stdout
        known = set().union(FOREIGN_FLAGS, flags_in(dev), *by_command.values())
        for files, call in (("bench/**/*.py", "add_argument"), ("tests/**/*.py", "add_argument"),
                            ("tools/**/*.py", "add_argument"), ("bench/*.cpp", "add_option")):
            for file in ROOT.glob(files):
                known |= {flag for _, line in numbered_lines(file) if call in line for flag in flags_in(line)}
        for page in pages():
            for place, line in numbered_lines(page):
                with self.subTest(place):
                    self.assertEqual(flags_in(line) - known, set())

    def test_calls_pass_flags_of_their_command(self):
        by_command = self.flags_by_command()
        for page in pages():
            for place, line in numbered_lines(page):
                call = CALL.search(line.split("`")[1] if line.count("`") == 2 else line)
                if not call or not line.startswith("    "):
                    continue
                with self.subTest(place):
                    self.assertIn(call[1], by_command)
                    self.assertEqual(flags_in(call[2].split(" # ")[0]) - by_command[call[1]], set())

    def test_files_that_comments_name_are_there(self):
        found = list(paths_in_comments())
        self.assertGreater(len(found), 300)
        self.assertEqual([f"{file.relative_to(ROOT)}:{number}: {path}" for file, number, path in found
                          if not is_there(path, file.parent)], [])

    def test_shaders_shown_are_those_of_their_files(self):
        snippets = load(ROOT / "tests/docs/shader_snippets.py")
        fences = 0
        for page in pages():
            text = load_text(page)
            shown = list(snippets.SNIPPET.finditer(text))
            fences += len(shown)
            with self.subTest(page.relative_to(ROOT)):
                self.assertEqual(len(snippets.FENCE.findall(text)), len(shown), "a shader without its source file")
            for snippet in shown:
                with self.subTest(page.relative_to(ROOT), functions=snippet["names"]):
                    self.assertEqual(snippet["code"], snippets.expected_code(snippet, self.binary),
                                     "python3 tests/docs/shader_snippets.py --binary BINARY rewrites it")
        self.assertGreater(fences, 3)

    def test_index_lists_every_page(self):
        index = (ROOT / "docs/README.md").read_text(encoding="utf-8")
        for page in (ROOT / "docs").glob("*.md"):
            if page.name != "README.md":
                self.assertIn(f"]({page.name})", index)

    def test_glossary_gives_each_word_one_meaning(self):
        rows = re.findall(r"^\| ([a-zA-Z].*?) \|", load_text(ROOT / "docs" / "glossary.md"), flags=re.MULTILINE)
        words = [word for row in rows if row != "word" for word in row.split(", ")]
        self.assertGreater(len(words), 40)
        self.assertEqual(sorted(words), sorted(set(words)))

    def test_floors_are_those_enforced(self):
        enforced = load(ROOT / "tools/dev/floors.py").FLOORS
        rooms = {path.name for path in (ROOT / "src").iterdir() if path.is_dir()}
        described = {}
        for _, line in numbered_lines(ROOT / "src/README.md"):
            if row := re.match(r"\| (\d) \| `(\w+)` \|", line):
                described[row[2]] = int(row[1])
        self.assertEqual(described, {room: enforced[room] for room in rooms})

    def test_entry_scripts_are_those_described(self):
        text = (ROOT / "blender_scripts/README.md").read_text(encoding="utf-8")
        described = set(re.findall(r"^\| `(\w+_entry\.py)`", text, flags=re.MULTILINE))
        self.assertEqual(described, {path.name for path in (ROOT / "blender_scripts").glob("*_entry.py")})


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--binary", type=Path, required=True)
    args, rest = parser.parse_known_args()
    Documentation.binary = args.binary.resolve()
    unittest.main(argv=[sys.argv[0], *rest])
