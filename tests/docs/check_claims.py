#!/usr/bin/env python3
"""Holds docs/claims.md to what is there: the pages that state its figures, the tests that show them, their commands.

    check_claims.py
"""

from pathlib import Path
import re
import sys
import unittest

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "bench"))
import accuracy_page
import scene_accuracy
import scene_tables

CLAIMS = (ROOT / "docs" / "claims.md").read_text(encoding="utf-8")
README, ACCURACY = ROOT / "README.md", ROOT / "docs" / "accuracy.md"

BLENDERS = {"3.4", "4.2", "4.3", "4.5", "5.2"}  # versions, no figures
QUOTED = re.compile(r"`([^`]+)`")
FIGURE = re.compile(r"(?<![\w.])\d+\.\d+(?![\w.]*\d)(?: %)?|(?<![\w.])\d+ %")
CPP_TEST = re.compile(r"^TEST(?:_F|_P)?\((\w+), (\w+)\)", re.MULTILINE)


def words_of(text):
    return " ".join(text.split())


def section(title):
    return CLAIMS.split(f"## {title}\n")[1].split("\n## ")[0]


def rows(text):
    """Cells of the tables' rows, heads left out."""
    for line in text.splitlines():
        cells = [cell.strip() for cell in re.split(r"(?<!\\)\|", line)[1:-1]]
        if cells and cells[0] != "figures" and not cells[0].startswith("---"):
            yield cells


def prose(page):
    """What people wrote: without tables, code and what lists a table's rows."""
    text = re.sub(r"```.*?```", "", page.read_text(encoding="utf-8"), flags=re.DOTALL)
    return words_of(" ".join(line for line in text.splitlines()
                             if not re.match(r"\||    |- \w+, \d+\.\d+\.\d+: ", line)))


def cpp_tests():
    found = (CPP_TEST.findall(path.read_text(encoding="utf-8")) for path in (ROOT / "tests").rglob("*.cpp"))
    return {f"{suite}.{name}" for names in found for suite, name in names}


def ctest_names():
    """{Suite.Name: what ctest calls it}; where Blender runs, a suite is one test."""
    names = {}
    for path in (ROOT / "tests").rglob("*.cpp"):
        for suite, name in CPP_TEST.findall(path.read_text(encoding="utf-8")):
            with_blender = path.parent.name == "with_blender"
            names[f"{suite}.{name}"] = f"with_blender.{suite}" if with_blender else f"{suite}.{name}"
    return names


def python_tests():
    names = set()
    for path in (ROOT / "tests").rglob("*.py"):
        for part in re.split(r"^class ", path.read_text(encoding="utf-8"), flags=re.MULTILINE)[1:]:
            suite = re.match(r"\w+", part)[0]
            names |= {f"{suite}.{name}" for name in re.findall(r"^    def (test_\w+)", part, flags=re.MULTILINE)}
    return names


def other_tests():
    """Of ctest alone."""
    listed = (ROOT / "tests" / "extra.cmake").read_text(encoding="utf-8")
    checks = re.findall(r"^foreach\(CHECK (.*)\)\n  add_test\(NAME (\w+)\.", listed, flags=re.MULTILINE)
    cases = {f"cli_case.{path.parent.name}" for path in (ROOT / "tests" / "cli").glob("*/command")}
    return cases | {f"{group}.{check}" for names, group in checks for check in names.split()}


class Claims(unittest.TestCase):
    def test_figures_stand_on_their_page(self):
        unshown = section("Shown by nothing that can be run")
        for page, text in ((README, section("README.md")), (ACCURACY, section("accuracy.md") + unshown)):
            whole = words_of(page.read_text(encoding="utf-8"))
            for figures, *_ in rows(text):
                self.assertNotEqual(QUOTED.findall(figures), [])
                for figure in QUOTED.findall(figures):
                    with self.subTest(page.name, figure=figure):
                        self.assertTrue(figure in whole, f"{page.name} does not say so: renew docs/claims.md")

    def test_no_figure_is_missing(self):
        claimed = set(FIGURE.findall(CLAIMS))
        for page in (README, ACCURACY):
            found = {figure for figure in FIGURE.findall(prose(page)) if figure not in BLENDERS}
            self.assertGreater(len(found), 8, page.name)
            self.assertEqual(sorted(found - claimed), [], f"{page.name} states them, docs/claims.md does not")

    def test_no_table_is_missing(self):
        lines = [line for line in ACCURACY.read_text(encoding="utf-8").splitlines() if line]
        tables = [number for number, line in enumerate(lines) if line.startswith("|---")]
        captions = {lines[number - 2] for number in tables if lines[number - 2].endswith(":")}
        headings = {next(line for line in reversed(lines[:number]) if line.startswith("#")) for number in tables}
        self.assertGreater(len(captions), 5)
        for caption in captions:
            self.assertTrue(f"| {caption} |" in CLAIMS, f"docs/claims.md lacks the table: {caption}")
        for heading in headings:
            anchor = re.sub(r"[^\w\- ]", "", heading.lstrip("# ").lower()).replace(" ", "-")
            self.assertTrue(f"(accuracy.md#{anchor})" in CLAIMS, f"docs/claims.md lacks {heading}")

    def test_tests_and_files_exist(self):
        tests = cpp_tests() | python_tests()
        self.assertGreater(len(tests), 800)
        for cells in rows(CLAIMS):
            shown = QUOTED.findall(cells[2])
            self.assertTrue(shown or cells[2].startswith("none"), cells)
            for name in shown:
                with self.subTest(name):
                    self.assertTrue((ROOT / name).exists() if "/" in name else name in tests, "there is no such test")

    def test_commands_run_them(self):
        usage = (ROOT / "dev").read_text(encoding="utf-8").split("TEXT")[1]
        cpp, others = ctest_names(), other_tests()
        for cells in (cells for cells in rows(CLAIMS) if len(cells) == 4):
            command = QUOTED.findall(cells[3])[0].replace("\\|", "|")
            with self.subTest(command):
                self.assertEqual(command.split()[0], "./dev")
                self.assertRegex(usage, f"(?m)^  {command.split()[1]} ")
                if " -R " in command:
                    pattern = command.split(" -R ")[1].strip("'")
                    self.assertTrue(any(re.search(pattern, name) for name in {*cpp.values(), *others}))
                    for name in QUOTED.findall(cells[2]):
                        if name in cpp:
                            self.assertRegex(cpp[name], pattern)

    def test_scenes_are_those_of_the_runs_that_are_kept(self):
        made = scene_tables.text(scene_accuracy.read(), [*scene_accuracy.OURS, *scene_accuracy.REAL])
        self.assertTrue(accuracy_page.marked("scenes", made) in ACCURACY.read_text(encoding="utf-8"),
                        "docs/accuracy.md is not what is kept: ./dev accuracy scenes --report")


if __name__ == "__main__":
    unittest.main()
