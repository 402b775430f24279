#!/usr/bin/env python3
"""Tables and sentences of docs/volumes.md, out of figures that are told apart."""

from pathlib import Path
import sys
import unittest

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "bench"))
import volume_accuracy


def figures(rmse, bias=0.01):
    return {"rmse": rmse, "square_error": 1e-5, "bias": bias}


def study(base):
    """One whose errors say where they stand: tenths of the spacing, hundredths of the leak test, thousandths of the encoding."""
    rows = [{"spacing": 0, "probes": 0, "test": "none", "encoding": encoding, "own": figures(base + 0.001 * e)}
            for e, encoding in enumerate(volume_accuracy.COLOURS)]
    for s, spacing in enumerate(volume_accuracy.SPACINGS, start=1):
        for t, test in enumerate(volume_accuracy.TESTS):
            for e, encoding in enumerate(volume_accuracy.COLOURS):
                value = base + 0.1 * s + 0.01 * t + 0.001 * e
                rows.append({"spacing": spacing, "probes": 10 * s, "test": test, "encoding": encoding, "own": figures(value),
                             "seen": figures(value + 1), "occluded": figures(value + 2)})
    return {"points": 9, "rows": rows, "floor": {"seen": figures(3.5), "occluded": figures(4.5)}}


LEAKS = [{"case": case, "spacing": spacing, "test": test, "truth": 0.05, "through": 0.1 * (t + 1), "excess": 0.07}
         for case in ("thin wall", "cupboard", "door") for spacing in volume_accuracy.LEAK_SPACINGS
         for t, test in enumerate(volume_accuracy.TESTS)]


class Tables(unittest.TestCase):
    def test_encodings_are_read_with_the_visibility_test_and_at_the_place_without(self):
        lines = volume_accuracy.encoding_table(study(0)).splitlines()
        self.assertEqual(lines[-1], "| `sh3` | 9 | 12.4 (+1.0) | 22.4 (+1.0) | 32.4 (+1.0) | < 0.6 (+1.0) |")
        self.assertEqual(lines[0].count("|"), lines[-1].count("|"))

    def test_what_is_seen_ends_with_what_no_probes_can_mend(self):
        lines = volume_accuracy.seen_table({"a": study(0), "b": study(0.05)}).splitlines()
        self.assertIn("| 112.4 (+1.0) | 117.4 (+1.0) |", lines[2])
        self.assertIn("| 350.0 (+1.0) | 350.0 (+1.0) |", lines[5])
        self.assertIn("| 450.0 (+1.0) | 450.0 (+1.0) |", lines[9])

    def test_leaks_have_a_column_for_each_test(self):
        lines = volume_accuracy.leak_table(LEAKS).splitlines()
        self.assertEqual(lines[2], "| thin wall | 1.3 | 5.00 | 10.00 | 20.00 | 30.00 | 7.00 |")
        self.assertEqual(len(lines), 2 + 3 * len(volume_accuracy.LEAK_SPACINGS))


class Sentences(unittest.TestCase):
    def test_the_test_costs_what_it_changes_where_nothing_leaks(self):
        studies = {"hall": study(0), "panels": study(0), "two_rooms": study(0.5)}
        text = " ".join(volume_accuracy.findings(studies, study(0.7), study(0), LEAKS).split())
        self.assertIn("changes the RMSE by 2.0 points at most", text)
        self.assertIn("`sh3` is off by 22.4 % in `hall`, 22.4 % in `panels` and 72.4 % in `two_rooms`", text)
        self.assertIn("92.4 % in place of 22.4 %", text)


if __name__ == "__main__":
    unittest.main()
