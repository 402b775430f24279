"""Figures kept of the reports of `rnmbake validate`, and when a bias counts."""
import json

NEGLIGIBLE = 0.003  # of the mean: a bias that is accepted whatever its interval says
CHANCE = 0.05       # so many of the true 95 % intervals do not hold the truth


def figures(folder):
    """The numbers of one validation: shares of the reference's mean."""
    report = json.loads((folder / "report.json").read_text(encoding="utf-8"))
    parts = {one["subject"]: {basis["basis"]: causes(basis) for basis in one["bases"]}
             for one in report["decompositions"]}
    return {
        "finding": report["finding"],
        "whole": metrics(report["scene"]),
        "whole_recipe": parts.pop("scene", {}),
        "objects": [{"object": one["key"], "texels": one["bases"][0]["texels"], "validity": rounded(one["validity"]),
                     "outside_model": one["outside_model"], "bases": metrics(one["bases"]),
                     "residual": {basis: row["residual"] for basis, row in parts.get(one["key"], {}).items()}}
                    for one in report["objects"]]}


def metrics(bases):
    return {one["basis"]: {"mean": rounded(one["reference_mean"]), "bias": interval(one["relative_bias"]),
                           "rmse": rounded(one["relative_rmse"]["value"])} for one in bases}


def causes(basis):
    """Each cause's bias; of noise its size, for it has none."""
    rows = {row["name"]: rounded(row["relative_rmse"]["value"]) if row["name"] == "noise" else
            interval(row["relative_bias"]) for row in basis["rows"]}
    return {**rows, "total": interval(basis["total"]["relative_bias"])}


def interval(estimate):
    """[value, low, high] of the 95 % interval."""
    return [rounded(estimate[key]) for key in ("value", "low95", "high95")]


def rounded(value):
    return None if value is None else float(f"{value:.5g}")


def known(estimate):
    return None not in estimate


def holds_zero(estimate):
    return estimate[1] <= 0 <= estimate[2]


def holds(estimate):
    """Is a bias nil as far as can be told, or too small to matter?"""
    return holds_zero(estimate) or abs(estimate[0]) <= NEGLIGIBLE


def distance(estimate):
    """Distance from 0, in half widths of the interval."""
    return abs(estimate[0]) / max(1e-12, (estimate[2] - estimate[1]) / 2)


def pairs(run):
    """(object, basis, bias) where the reference is not black."""
    for one in run["objects"]:
        for basis, row in one["bases"].items():
            if row["mean"] and known(row["bias"]):
                yield one["object"], basis, row["bias"]


def residuals(run):
    """(object, basis, residual) where the reference is not black."""
    for one in run["objects"]:
        for basis, residual in one["residual"].items():
            if one["bases"][basis]["mean"] and known(residual):
                yield one["object"], basis, residual
