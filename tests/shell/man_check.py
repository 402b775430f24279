"""Manual pages of every command, by mandoc's and man's own checks.

    RNMBAKE_BINARY=build/release/rnmbake python3 tests/shell/man_check.py
"""
import os
from pathlib import Path
import re
import shutil
import subprocess
import tempfile
import unittest

BINARY = os.environ["RNMBAKE_BINARY"]


class Man(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory(prefix="rnmbake-man-")
        cls.addClassCleanup(folder.cleanup)
        subprocess.run([BINARY, "man", "-o", folder.name], check=True)
        cls.pages = sorted(Path(folder.name).iterdir())

    def test_a_page_for_each_command(self):
        said = subprocess.run([BINARY, "--help"], stdout=subprocess.PIPE, encoding="utf-8", check=True).stdout
        listed = re.findall(r"^  ([a-z]+) +\S", said.split("Subcommands:\n")[1].split("\n\n")[0], re.MULTILINE)
        names = {page.name for page in self.pages}
        self.assertGreater(len(listed), 10)
        self.assertLessEqual({"rnmbake.1", "rnmbake-ssbump-mip.1", *(f"rnmbake-{name}.1" for name in listed)}, names)

    def test_prints_what_it_writes(self):
        for words, name in (([], "rnmbake.1"), (["bake"], "rnmbake-bake.1"), (["ssbump", "info"], "rnmbake-ssbump-info.1")):
            said = subprocess.run([BINARY, "man", *words], stdout=subprocess.PIPE, encoding="utf-8", check=True).stdout
            self.assertEqual(said, next(page for page in self.pages if page.name == name).read_text(encoding="utf-8"))

    def test_man_has_nothing_to_warn_of(self):
        if not shutil.which("man"):
            self.skipTest("SKIPPED: no man on this machine (Debian: man-db)")
        for page in self.pages:
            done = subprocess.run(["man", "--warnings", "-E", "UTF-8", "-l", "-Tutf8", "-Z", str(page)], stdout=subprocess.DEVNULL,
                                  stderr=subprocess.PIPE, encoding="utf-8", env={**os.environ, "LC_ALL": "C.UTF-8", "MANWIDTH": "80"})
            self.assertEqual((done.returncode, done.stderr), (0, ""), page.name)

    def test_mandoc_has_nothing_to_warn_of(self):
        if not shutil.which("mandoc"):
            self.skipTest("SKIPPED: no mandoc on this machine (Debian: mandoc)")
        done = subprocess.run(["mandoc", "-Tlint", "-Wwarning", *map(str, self.pages)], stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, encoding="utf-8")
        said = [line for line in done.stdout.splitlines() if "missing date" not in line]  # a date would differ from build to build
        self.assertEqual(said, [])

    def test_reads_as_the_help_does(self):
        if not shutil.which("mandoc"):
            self.skipTest("SKIPPED: no mandoc on this machine (Debian: mandoc)")
        page = next(page for page in self.pages if page.name == "rnmbake-bake.1")
        text = subprocess.run(["mandoc", "-Tascii", str(page)], stdout=subprocess.PIPE, encoding="utf-8", check=True).stdout
        text = " ".join(re.sub(r".\x08", "", text).split())
        said = subprocess.run([BINARY, "bake", "--help"], stdout=subprocess.PIPE, encoding="utf-8", check=True).stdout
        for name in set(re.findall(r"(?<![\w|])--[a-z][a-z-]+[a-z]", said)):
            self.assertIn(name, text)
        self.assertIn("-o, --output PATH", text)
        self.assertIn("The scene file itself is never changed.", text)


if __name__ == "__main__":
    unittest.main()
