"""Blender runs this to write the scene survey: survey.json and survey.bin."""
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

from core.task import run  # noqa: E402
from opening.inputs import scene_inputs  # noqa: E402
from opening.load import open_to_measure, refuse_blocked_scripts, scene_warnings  # noqa: E402
from scene_ops import displacement  # noqa: E402
from survey.surveyor import DigestSurveyor, survey_scene, volume_warnings, write_survey  # noqa: E402


def main(task):
    warnings = open_to_measure(task)
    warnings = [*scene_warnings(), *warnings, *displacement.settle()]
    task.progress("evaluate")
    surveyor = DigestSurveyor(task)
    survey = survey_scene(task, surveyor)
    survey["digest"], survey["inputs"] = surveyor.digest.entries(), scene_inputs()
    refuse_blocked_scripts(task)  # drivers are found out only when they are evaluated
    survey["warnings"] = [*warnings, *survey["warnings"], *volume_warnings(survey)]
    return {"survey": write_survey(task, survey)}


run(main)
