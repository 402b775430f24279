"""Holds report.json against docs/report.schema.json, and report.csv against report.json.

    SAMPLE_REPORT=build/release/tests/sample_report python3 tests/report/schema_check.py
"""
import copy
import csv
import json
import os
from pathlib import Path
import subprocess
import tempfile
import unittest

import jsonschema

SCHEMA = json.loads((Path(__file__).resolve().parents[2] / "docs" / "report.schema.json").read_text(encoding="utf-8"))


def is_valid(report):
    return jsonschema.Draft202012Validator(SCHEMA).is_valid(report)


class Twins(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        jsonschema.Draft202012Validator.check_schema(SCHEMA)
        folder = tempfile.TemporaryDirectory(prefix="rnmbake-report-")
        cls.addClassCleanup(folder.cleanup)
        subprocess.run([os.environ["SAMPLE_REPORT"], folder.name, "small"], check=True, timeout=120)
        cls.report = json.loads((Path(folder.name) / "report.json").read_text(encoding="utf-8"))
        with open(Path(folder.name) / "report.csv", encoding="utf-8", newline="") as file:
            cls.lines = list(csv.DictReader(file))

    def test_fits_the_schema(self):
        errors = [f"{error.json_path}: {error.message}"
                  for error in jsonschema.Draft202012Validator(SCHEMA).iter_errors(self.report)]
        self.assertEqual(errors, [])

    def test_schema_is_strict(self):
        for path in ((), ("scene", 0), ("scene", 0, "bias"), ("scene", 0, "noise"), ("objects", 0), ("objects", 0, "bases", 0),
                     ("settings", 0), ("decompositions", 0), ("decompositions", 0, "bases", 0),
                     ("decompositions", 0, "bases", 0, "rows", 0), ("study", 0), ("views", 0), ("thresholds",),
                     ("thresholds", "limits", 0), ("thresholds", "exceeded", 0)):
            spoilt = copy.deepcopy(self.report)
            place = spoilt
            for step in path:
                place = place[step]
            for key in list(place):
                value = place.pop(key)
                self.assertFalse(is_valid(spoilt), f"{path} without {key}")
                place[key] = value
            place["surprise"] = 1
            self.assertFalse(is_valid(spoilt), f"{path} with more")

    def test_csv_says_the_same(self):
        wanted = [(one["key"], basis) for one in self.report["objects"] for basis in one["bases"]]
        wanted += [("(scene)", basis) for basis in self.report["scene"]]
        self.assertEqual(len(self.lines), len(wanted))
        for line, (key, basis) in zip(self.lines, wanted):
            self.assertEqual((line["object"], line["basis"], int(line["texels"])), (key, basis["basis"], basis["texels"]))
            for name in ("bias", "relative_bias", "rmse", "relative_rmse"):
                self.assertAlmostEqual(float(line[name]), basis[name]["value"], places=7)
                self.assertAlmostEqual(float(line[name + "_high95"]), basis[name]["high95"], places=7)
            self.assertEqual(int(line["max_x"]), basis["max"]["x"])

    def test_thresholds_are_those_asked_for(self):
        self.assertEqual([one["metric"] for one in self.report["thresholds"]["limits"]], ["rmse", "bias"])
        self.assertEqual(self.report["thresholds"]["passed"], not self.report["thresholds"]["exceeded"])


if __name__ == "__main__":
    unittest.main()
