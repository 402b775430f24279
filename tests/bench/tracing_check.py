#!/usr/bin/env python3
"""Measuring the tracer on some scenes keeps what is known of the others."""

from pathlib import Path
import sys
import unittest

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "bench"))
import tracing


def result(date, **figures):
    return {"date": date, "machine": "m", "data": {"rows": [{"scene": name, "figure": it} for name, it in figures.items()]}}


class SomeScenes(unittest.TestCase):
    def test_rows_keep_their_place_and_date(self):
        joined = tracing.renewed(result("1 May", cornell=1, hall=2, cave=3), result("3 May", panels=5, hall=4))
        self.assertEqual([(row["scene"], row["figure"], row["date"]) for row in joined["data"]["rows"]],
                         [("cornell", 1, "1 May"), ("hall", 4, "3 May"), ("cave", 3, "1 May"), ("panels", 5, "3 May")])
        again = tracing.renewed(joined, result("4 May", cornell=6))
        self.assertEqual(again["date"], "4 May")
        self.assertEqual([row["date"] for row in again["data"]["rows"]], ["4 May", "3 May", "1 May", "3 May"])

    def test_days_are_told_apart_only_where_there_are_several(self):
        rows = tracing.renewed(result("1 May", cornell=1, hall=2), result("3 May", hall=4))["data"]["rows"]
        self.assertIn("1 May: cornell; 3 May: hall.", tracing.measured_on(rows))
        self.assertEqual(tracing.measured_on(result("1 May", cornell=1, hall=2)["data"]["rows"]), "")


if __name__ == "__main__":
    unittest.main()
