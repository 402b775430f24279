"""Opens reports in headless Chromium: they render, sort, filter, slide, say nothing on the console and load nothing.

    SAMPLE_REPORT=build/release/tests/sample_report python3 tests/report/page_check.py

RNMBAKE_SCREENSHOTS=FOLDER keeps pictures to look at.
"""
import os
from pathlib import Path
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, str(Path(__file__).resolve().parent))
import browser  # noqa: E402

MOST_BYTES = 30_000_000
MOST_SECONDS = 2.0

ROWS = "[...document.querySelectorAll('.objects > tbody > tr:not(.detail)')]"
SHOWN_KEYS = ROWS + ".filter(row => !row.hidden).map(row => row.querySelector('.key').firstChild.textContent)"
HEAD = "[...document.querySelectorAll('.objects > thead button')].find(one => one.textContent === '{}')"
# Reading a canvas that is drawn on often earns a warning, so a copy is read.
PIXELS = ("(canvas => { const copy = document.createElement('canvas'); copy.width = canvas.width; copy.height = canvas.height;"
          " const context = copy.getContext('2d', {willReadFrequently: true}); context.drawImage(canvas, 0, 0);"
          " return context.getImageData(0, 0, copy.width, copy.height).data; })")


setUpModule = browser.require


class Page(unittest.TestCase):
    kind = None

    @classmethod
    def setUpClass(cls):
        if cls.kind is None:
            raise unittest.SkipTest("only for derived classes")
        folder = tempfile.TemporaryDirectory(prefix="rnmbake-report-")
        cls.addClassCleanup(folder.cleanup)
        cls.page = Path(folder.name) / "report.html"
        subprocess.run([os.environ["SAMPLE_REPORT"], folder.name, cls.kind], check=True, timeout=120)
        cls.browser = browser.Browser()
        cls.addClassCleanup(cls.browser.close)
        cls.browser.look_like(1280, 900)
        cls.browser.open(cls.page)

    def tearDown(self):
        self.assertEqual(self.browser.problems, [])

    def run_js(self, script):
        return self.browser.run(script)

    def picture(self, name):
        folder = os.environ.get("RNMBAKE_SCREENSHOTS")
        if folder:
            self.browser.screenshot(Path(folder) / f"{self.kind}-{name}.png")

    def open_first(self):
        self.run_js("if (!document.querySelector('.detail')) document.querySelector('button.open').click()")
        self.browser.wait("document.querySelector('.detail .viewer') !== null")


class SmallPage(Page):
    kind = "small"

    def setUp(self):
        self.browser.open(self.page)

    def test_shows_every_section(self):
        found = self.run_js("[...document.querySelectorAll('main > section')].map(one => one.id)")
        self.assertEqual(found, ["scene", "causes", "study", "views", "objects", "settings"])
        self.assertIn("3 objects", self.run_js("document.querySelector('.finding').textContent"))
        self.assertIn("--fail-above", self.run_js("document.querySelector('.command code').textContent"))

    def test_names_are_text(self):
        keys = self.run_js(SHOWN_KEYS)
        self.assertIn("</script><script>alert(1)</script>", keys)
        self.assertIn("<b>lamp</b>", self.run_js("document.querySelector('#objects').textContent"))
        self.assertEqual(self.run_js("document.querySelectorAll('#objects b').length"), 0)
        scripts = self.run_js("[...document.scripts].filter(one => one.textContent.includes('alert(1)') && !one.type).length")
        self.assertEqual(scripts, 0)

    def test_sorts_by_any_column(self):
        def rmse():
            return self.run_js(ROWS + ".map(row => parseFloat(row.children[4].textContent))")
        self.assertEqual(rmse(), sorted(rmse(), reverse=True))  # worst first
        self.run_js(HEAD.format("RMSE") + ".click()")
        self.assertEqual(rmse(), sorted(rmse()))
        self.assertEqual(self.run_js(HEAD.format("RMSE") + ".parentElement.getAttribute('aria-sort')"), "ascending")
        self.run_js(HEAD.format("object") + ".click()")
        self.assertEqual(self.run_js(SHOWN_KEYS), sorted(self.run_js(SHOWN_KEYS)))
        self.assertEqual(self.run_js("document.querySelectorAll('[aria-sort=ascending]').length"), 1)

    def test_an_open_object_follows_its_row(self):
        self.open_first()
        key = self.run_js("document.querySelector('.detail').previousElementSibling.querySelector('.key').textContent")
        self.run_js(HEAD.format("RMSE") + ".click()")
        self.assertEqual(key, self.run_js("document.querySelector('.detail').previousElementSibling.querySelector('.key').textContent"))
        self.run_js("document.querySelector('[aria-expanded=true]').click()")
        self.assertEqual(self.run_js("document.querySelectorAll('.detail').length"), 0)

    def test_filters(self):
        self.run_js("(() => { const box = document.querySelector('input[type=search]'); box.value = 'WAL';"
                    " box.dispatchEvent(new Event('input')); })()")
        self.assertEqual(self.run_js(SHOWN_KEYS), ["wall"])
        self.assertEqual(self.run_js("document.querySelector('.count').textContent"), "1 of 3 objects")

    def test_maps_hold_the_numbers(self):
        self.open_first()
        labels = self.run_js("[...document.querySelectorAll('.detail .maps figcaption')].map(one => one.textContent)")
        self.assertEqual(labels[:3], ["Cycles 4.3.2", "reference", "relative error"])
        self.assertEqual(len(labels), 5)
        pixels = self.run_js(
            f"[...document.querySelectorAll('.detail .maps canvas')].map(canvas => {{ const data = {PIXELS}(canvas);"
            " const at = (x, y) => [...data.slice(4 * (y * canvas.width + x), 4 * (y * canvas.width + x) + 4)];"
            " return [canvas.width, at(0, 0), at(26, 29)]; })")
        for width, outside, inside in pixels:
            self.assertEqual(width, 64)
            self.assertEqual(outside[3], 0)  # not covered: nothing is drawn
            self.assertEqual(inside[3], 255)
        self.assertGreater(sum(pixels[0][2][:3]), 400)  # the lamp's bright spot

    def test_values_follow_the_keyboard(self):
        self.open_first()
        self.run_js("(() => { const canvas = document.querySelector('.detail canvas'); canvas.focus(); canvas.dispatchEvent("
                    "new KeyboardEvent('keydown', {key: 'ArrowRight', bubbles: true})); })()")
        read = self.run_js("document.querySelector('.detail .readout').textContent")
        self.assertIn("texel 33, 32", read)
        self.assertRegex(read, r"relative error [+−]\d")

    def test_values_follow_the_pointer(self):
        self.open_first()
        box = self.run_js("(() => { const canvas = document.querySelector('.detail canvas'); canvas.scrollIntoView();"
                          " const box = canvas.getBoundingClientRect(); return [box.x, box.y, box.width]; })()")
        x, y, size = box
        self.browser.call("Input.dispatchMouseEvent", type="mouseMoved", x=x + size * 20.5 / 64, y=y + size * 10.5 / 64)
        self.assertIn("texel 20, 10", self.run_js("document.querySelector('.detail .readout').textContent"))

    def test_slider_moves(self):
        self.open_first()
        clip = "document.querySelector('.detail .over').style.clipPath"
        self.assertIn("50%", self.run_js(clip))
        self.run_js("(() => { const range = document.querySelector('.detail .slider input'); range.value = 250;"
                    " range.dispatchEvent(new Event('input')); })()")
        self.assertIn("75%", self.run_js(clip))
        self.assertEqual(self.run_js("document.querySelector('.detail .handle').style.left"), "25%")
        x, y, width = self.run_js(
            "(() => { const stage = document.querySelector('.detail .slide'); stage.scrollIntoView();"
            " const box = stage.getBoundingClientRect(); return [box.x, box.y, box.width]; })()")
        self.browser.call("Input.dispatchMouseEvent", type="mousePressed", button="left", buttons=1, x=x + width * 0.8, y=y + 20)
        self.browser.call("Input.dispatchMouseEvent", type="mouseReleased", button="left", x=x + width * 0.8, y=y + 20)
        self.assertEqual(self.run_js("document.querySelector('.detail .handle').style.left"), "80%")

    def test_exposure_brightens_and_scale_is_printed(self):
        self.open_first()
        mean = (f"(() => {{ const data = {PIXELS}(document.querySelector('.detail .maps canvas'));"
                " return data.reduce((a, b) => a + b) / data.length; })()")
        before = self.run_js(mean)
        self.run_js("(() => { const range = document.querySelector('.tools input[type=range]'); range.value = 3;"
                    " range.dispatchEvent(new Event('input')); })()")
        self.assertGreater(self.run_js(mean), before)
        self.run_js("(() => { const list = document.querySelectorAll('.tools select')[1]; list.value = '0.05';"
                    " list.dispatchEvent(new Event('change')); })()")
        self.assertIn("+5.00\u00a0%", self.run_js("document.querySelector('.detail .legend').textContent"))

    def test_everything_has_a_name(self):
        nameless = self.run_js(
            "[...document.querySelectorAll('button, input, select, svg[role=img], canvas[tabindex]')].filter(one =>"
            " !(one.textContent.trim() || one.closest('label') || one.getAttribute('aria-label'))).length")
        self.assertEqual(nameless, 0)

    def test_fits_a_phone_light_and_dark(self):
        self.addCleanup(self.browser.look_like, 1280, 900)
        self.open_first()
        backgrounds = set()
        for scheme in ("light", "dark"):
            for width, phone in ((1280, False), (390, True)):
                self.browser.look_like(width, 844, scheme, phone)
                self.assertLessEqual(self.run_js("document.documentElement.scrollWidth"), width)
                self.run_js("document.querySelector('#views').scrollIntoView()")
                self.browser.wait("document.querySelector('#views canvas') !== null")
                self.picture(f"{scheme}-{width}")
                backgrounds.add(self.run_js("getComputedStyle(document.body).backgroundColor"))
        self.assertEqual(len(backgrounds), 2)


class ManyObjects(Page):
    kind = "many"

    def test_stays_small_and_opens_fast(self):
        self.assertLess(self.page.stat().st_size, MOST_BYTES)
        best = min(self.browser.open(self.page) for _ in range(3))  # other programs may be busy
        self.assertLess(best, MOST_SECONDS)
        self.assertEqual(self.run_js(ROWS + ".length"), 200)
        self.browser.wait("document.querySelectorAll('.thumbs canvas').length > 0")
        self.assertLess(self.run_js("document.querySelectorAll('canvas').length"), 100)  # only what is in sight
        self.picture("light")


class LargeMaps(Page):
    kind = "large"

    def test_maps_are_scaled_down(self):
        self.assertLess(self.page.stat().st_size, MOST_BYTES)
        self.open_first()
        width = self.run_js("document.querySelector('.detail .maps canvas').width")
        self.assertLessEqual(width, 256)
        self.assertIn("shown as means of", self.run_js("document.querySelector('.detail').textContent"))
        self.run_js("[...document.querySelectorAll('.detail button')].find(one => one.textContent.startsWith('worst')).click()")
        self.assertRegex(self.run_js("document.querySelector('.detail .readout').textContent"), r"^texels \d+–\d+")


if __name__ == "__main__":
    unittest.main()
