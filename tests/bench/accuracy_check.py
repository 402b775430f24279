#!/usr/bin/env python3
"""How the figures of docs/accuracy.md are counted, and that its parts can be renewed one at a time."""

from pathlib import Path
import sys
import tempfile
import unittest

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "bench"))
import accuracy_page
import other_renderer
import scene_accuracy
import scene_figures
import scene_tables


def run_of(*biases):
    """A run with one object for each bias, the same for its one map."""
    objects = [{"object": f"o{i}", "bases": {"flat": {"mean": 1.0, "bias": bias, "rmse": 0.0}}, "residual": {"flat": bias}}
               for i, bias in enumerate(biases)]
    return {"scene": "cornell", "blender": "3.4.1", "objects": objects}


class Counting(unittest.TestCase):
    def test_a_bias_holds_within_its_interval_or_when_negligible(self):
        self.assertTrue(scene_figures.holds([0.1, -0.1, 0.3]))
        self.assertTrue(scene_figures.holds([-0.003, -0.0035, -0.0025]))
        self.assertFalse(scene_figures.holds([-0.0031, -0.0035, -0.0025]))

    def test_black_references_do_not_count(self):
        run = run_of([None, None, None], [0, 0, 0], [0, -1, 1])
        run["objects"][1]["bases"]["flat"]["mean"] = 0.0
        self.assertEqual([name for name, _, _ in scene_figures.pairs(run)], ["o2"])
        self.assertEqual([name for name, _, _ in scene_figures.residuals(run)], ["o2"])

    def test_the_farthest_comes_first(self):
        missed = scene_tables.outside(run_of([0.2, 0.1, 0.3], [0.1, 0.09, 0.11], [0, -1, 1]))
        self.assertEqual([name for name, _, _ in missed], ["o1", "o0"])

    def test_chance_counts_only_intervals_wider_than_what_is_negligible(self):
        pairs = list(scene_figures.pairs(run_of(*[[0, -0.01, 0.01]] * 20, [0, -0.001, 0.001])))
        self.assertAlmostEqual(scene_tables.chance(pairs), 1.0)


class Kept(unittest.TestCase):
    def test_a_run_replaces_the_older_one_of_the_same_scene_and_blender(self):
        with tempfile.TemporaryDirectory() as folder:
            scene_accuracy.RESULTS = Path(folder) / "results.json"
            for run in (run_of([0, 0, 0]), {**run_of(), "scene": "cave"}, run_of([1, 0, 2])):
                scene_accuracy.keep(run)
            results = scene_accuracy.read()
        self.assertEqual([run["scene"] for run in results["runs"]], ["cornell", "cave"])
        self.assertEqual(results["runs"][0], run_of([1, 0, 2]))


class Page(unittest.TestCase):
    def test_one_part_is_renewed_and_the_other_kept(self):
        page = accuracy_page.marked("scenes", "old") + "\n" + accuracy_page.marked("closed forms", "## Closed forms\n\nkept")
        self.assertEqual(accuracy_page.part(page, "closed forms"), "## Closed forms\n\nkept\n")
        self.assertIn("Not measured", accuracy_page.part("", "closed forms"))


class OtherRenderer(unittest.TestCase):
    def test_only_diffuse_pixels_count(self):
        grey, red = [0.5] * 3 + [1.0] + [0.5] * 3, [0.5, 0, 0, 1.0, 0.5, 0, 0]
        lamp, border = [5.0] * 3 + [1.0] + [0.5] * 3, [0.5] * 3 + [0.5] + [0.5] * 3
        ours = [[value] * 3 for value in (2.0, 9.0, 9.0, 9.0)]
        found = other_renderer.ratios(ours, [grey, red, lamp, border], [[1.0] * 3] * 4)
        self.assertEqual((found["pixels"], found["median"], found["mean"]), (1, 2.0, 2.0))


if __name__ == "__main__":
    unittest.main()
