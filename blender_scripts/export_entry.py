"""Blender runs this on the file that lambert_entry.py made: survey.json with the key "exchange", and survey.bin.

docs/rnmscene-format.md says what "exchange" holds.
"""
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

from core.task import run  # noqa: E402
from export.surveyor import ExportSurveyor  # noqa: E402
from opening.load import open_to_measure  # noqa: E402
from survey.surveyor import survey_scene, write_survey  # noqa: E402


def main(task):
    warnings = open_to_measure(task)
    task.progress("evaluate")
    surveyor = ExportSurveyor(task)
    survey = survey_scene(task, surveyor)
    survey["warnings"] = warnings + survey["warnings"]
    survey["exchange"] = surveyor.exchange
    return {"survey": write_survey(task, survey)}


run(main)
