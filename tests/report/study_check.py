"""Opens a study's page in headless Chromium: plots, table and pictures are there, and choices change the plots.

    RNMBAKE_BINARY=build/release/rnmbake python3 tests/report/study_check.py
"""
import os
from pathlib import Path
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, str(Path(__file__).resolve().parent))
import browser  # noqa: E402

SECTION = "document.querySelectorAll('main > section')[{}]"
DOTS = SECTION.format(0) + ".querySelectorAll('circle').length"
HEIGHTS = "[..." + SECTION.format(0) + ".querySelectorAll('circle')].map(dot => dot.getAttribute('cy')).join()"
LINES = SECTION.format(1) + ".querySelectorAll('polyline').length"


setUpModule = browser.require


class StudyPage(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory(prefix="rnmbake-study-")
        cls.addClassCleanup(folder.cleanup)
        cls.out = Path(folder.name)
        # A sky that is bright above; sixteen rows of a Radiance picture without run lengths.
        rows = b"".join(bytes((200 - 10 * y, 200 - 10 * y, 220, 128)) * 32 for y in range(16))
        (cls.out / "<sky>.hdr").write_bytes(b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 16 +X 32\n" + rows)
        subprocess.run([os.environ["RNMBAKE_BINARY"], "-q", "study", "encodings", "<sky>.hdr", "--count", "20", "-o", "study"],
                       check=True, timeout=120, cwd=cls.out, stdout=subprocess.DEVNULL)
        cls.browser = browser.Browser()
        cls.addClassCleanup(cls.browser.close)

    def setUp(self):
        self.browser.look_like(1280, 900)
        self.browser.open(self.out / "study" / "encodings.html")

    def tearDown(self):
        self.assertEqual(self.browser.problems, [])

    def test_shows_plots_tables_and_spheres(self):
        self.assertEqual(self.browser.run("document.querySelector('h1').textContent"), "20 surfaces in the light of <sky>.hdr")
        self.assertIn("RNM", self.browser.run("document.querySelector('.finding').textContent"))
        fit = self.browser.run("document.querySelectorAll('main > section:last-child tbody tr').length")
        self.assertGreater(fit, 20)
        self.assertEqual(self.browser.run(DOTS), fit)
        files = list((self.out / "study" / "spheres").iterdir())
        self.browser.wait("[...document.images].every(one => one.complete && one.naturalWidth === 176)")
        self.assertEqual(self.browser.run("document.images.length"), len(files))
        self.assertIn("Probulator", self.browser.run("document.querySelector('table.numbers').textContent"))

    def test_choices_change_the_plots(self):
        before = self.browser.run(HEIGHTS)
        self.browser.run("{ const list = document.querySelector('select'); list.value = '3'; list.dispatchEvent(new Event('change')); }")
        self.assertNotEqual(self.browser.run(HEIGHTS), before)
        lines = self.browser.run(LINES)
        self.browser.run("document.querySelector('input[type=checkbox]:checked').click()")
        self.assertEqual(self.browser.run(LINES), lines - 1)

    def test_fits_a_phone(self):
        self.browser.look_like(390, 800)
        self.browser.open(self.out / "study" / "encodings.html")
        self.assertLessEqual(self.browser.run("document.documentElement.scrollWidth"), 390)


if __name__ == "__main__":
    unittest.main()
