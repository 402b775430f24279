"""Serves the files that `--to threejs` writes and lets three.js, in headless Chromium, light spheres with them.

    SAMPLE_FORMATS=build/release/tests/sample_formats python3 tests/probes/formats/threejs_check.py

RNMBAKE_NODE_MODULES names a node_modules folder that holds three; without it npm fetches three into a temporary folder.
Left out, with a word, where there is no Chromium, npm or network.
"""
from pathlib import Path
import sys
import tempfile
import unittest

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parents[1] / "report")]
import browser  # noqa: E402
import known_light as known  # noqa: E402
import served  # noqa: E402

PAGE = """<!doctype html><meta charset=utf-8><script type=importmap>
{"imports": {"three": "./node_modules/three/build/three.module.js", "three/addons/": "./node_modules/three/examples/jsm/"}}
</script><script type=module>
import * as THREE from 'three';
import { loadProbes } from './probes.js';
import { LightProbeGridWebGL } from 'three/addons/lighting/LightProbeGridWebGL.js';
const volumes = Object.fromEntries((await loadProbes(THREE, 'light_probes.json')).map((one) => [one.name, one]));
const renderer = new THREE.WebGLRenderer();
const target = new THREE.WebGLRenderTarget(1, 1, { type: THREE.FloatType });
// What a camera in front of a small sphere at `place` sees in the middle, where the sphere's normal is `normal`.
window.seen = (name, way, place, normal, reach) => {
  const volume = volumes[name], scene = new THREE.Scene();
  const at = new THREE.Vector3(...place), towards = new THREE.Vector3(...normal);
  let material = new THREE.MeshLambertMaterial();
  if (way === 'grid') scene.add(volume.lightProbeGrid(LightProbeGridWebGL));
  if (way === 'probe') scene.add(volume.lightProbe(at));
  if (way === 'material') material = volume.material();
  const sphere = new THREE.Mesh(new THREE.SphereGeometry(reach, 256, 128), material);
  sphere.position.copy(at);
  scene.add(sphere);
  const camera = new THREE.OrthographicCamera(-reach / 500, reach / 500, reach / 500, -reach / 500, 0, 4 * reach);
  if (Math.abs(towards.y) > 0.9) camera.up.set(1, 0, 0);
  camera.position.copy(at).addScaledVector(towards, 2 * reach);
  camera.lookAt(at);
  renderer.setRenderTarget(target);
  renderer.render(scene, camera);
  const pixel = new Float32Array(4);
  renderer.readRenderTargetPixels(target, 0, 0, 1, 1, pixel);
  return [...pixel.subarray(0, 3)];
};
window.refusal = (name) => {
  try { volumes[name].lightProbeGrid(LightProbeGridWebGL); } catch (problem) { return problem.message; }
};
document.documentElement.dataset.ready = 'yes';
</script>"""


setUpModule = browser.require


class Page(served.Served):
    HARMLESS = served.Served.HARMLESS + ("404",)  # the page asks for a file that a three.js may lack

    @classmethod
    def setUpClass(cls):
        temporary = tempfile.TemporaryDirectory(prefix="rnmbake-threejs-")
        cls.addClassCleanup(temporary.cleanup)
        root = Path(temporary.name)
        cls.folder = root / "page"
        known.write(cls.folder, "threejs", "all")
        (cls.folder / "seen.html").write_text(PAGE, encoding="utf-8")
        (cls.folder / "node_modules").symlink_to(served.node_modules(root, served.THREE))
        cls.serve(cls.folder, 512, 384)

    def seen(self, name, way, place, normal, reach=.01):
        return self.browser.run(f"seen('{name}', '{way}', {list(known.y_up(place))}, {list(known.y_up(normal))}, {reach})")

    def assert_light(self, found, expected, tolerance, message):
        for channel in range(3):
            self.assertLessEqual(abs(found[channel] - expected[channel]), tolerance, f"{message}: {found}, expected {expected}")

    # Nine rounded coefficients (formats_check.py); a pixel that is 1/500 of the radius off the sphere's middle.
    TOLERANCE = 2.5 * known.HALF_STEP + 2e-3

    def test_walls_are_where_they_belong(self):
        self.open("seen.html")
        for way in ("grid", "material", "probe"):
            for axis, normal in known.AXES.items():
                self.assert_light(self.seen("room", way, (.3, -.2, .1), normal), known.WALLS[axis], self.TOLERANCE, f"{way} {axis}")
        self.assertEqual(self.problems(), [])

    def test_probes_are_where_they_belong(self):
        self.open("seen.html")
        diagonal = (.6, .8, 0)
        for name, index in (("hall", (0, 0, 0)), ("hall", (1, 0, 0)), ("hall", (0, 2, 0)), ("hall", (0, 0, 3)), ("hall", (.5, 1.5, 2.5)), ("single", (0, 0, 0)),
                            ("turned", (2, 0, 0)), ("turned", (0, 1, 0)), ("turned", (0, 0, 1)), ("turned", (1.5, .5, .5))):
            share = known.share(name, *index)
            for way in ("material", "probe") if name == "turned" else ("grid", "material", "probe"):
                place = known.place(name, *index)
                if way == "grid":  # it looks half a step off the surface, along the normal
                    steps = [max(map(abs, step)) for step in known.BOXES[name][2]]
                    place = tuple(place[c] - diagonal[c] * steps[c] / 2 for c in range(3))
                # Light at most doubles from one probe to the next. A texture filter has eight bits for each of three axes; the
                # sphere's radius is a thousandth of a step.
                found = self.seen(name, way, place, diagonal, .0005)
                self.assert_light(found, [share * v for v in known.light(diagonal)],
                                  share * (self.TOLERANCE + 3 / 256 + .001), f"{name} {way} {index}")
        self.assertEqual(self.problems(), [])

    def test_turned_boxes_are_refused_by_light_probe_grid(self):
        self.open("seen.html")
        self.assertIn("'turned' is turned", self.browser.run("refusal('turned')"))

    def test_the_page_shows_every_volume_in_every_way(self):
        self.open("index.html")
        self.assertEqual(self.browser.run("[...document.querySelectorAll('#volume option')].map(one => one.text).join()"),
                         "room,hall,turned,single,two points")
        for volume, name in enumerate((*known.BOXES, 'two points')):
            for way in ("material", "grid", "probe"):
                self.browser.run(f"""{{ document.getElementById('volume').value = {volume};
const way = document.getElementById('way'); way.value = '{way}'; way.dispatchEvent(new Event('change'));
document.documentElement.dataset.ready = ''; }}""")
                self.browser.wait("document.documentElement.dataset.ready === 'yes'")
                said = self.browser.run("document.getElementById('said').textContent")
                self.assertEqual(bool(said), way == "grid" and name in ("turned", "two points"), f"{name} {way}: {said}")
        self.assertEqual(self.problems(), [])


if __name__ == "__main__":
    unittest.main()
