"""Two builds of bench_planning against each other, taking turns, on one survey; kept for docs/performance.md.

    python3 bench/compare_planning.py OLD NEW SURVEY.json "what was changed"
"""
import filecmp
import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path

KEPT = Path(__file__).resolve().parent / "results/planning_changes.json"
TURNS = 4


def plan(binary, survey, folder):
    """(answer, peak bytes, processor seconds) of one turn."""
    with subprocess.Popen([binary, survey, folder, "3"], stdout=subprocess.PIPE, text=True) as process:
        answer = json.loads(process.stdout.read())
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode != 0:
        raise SystemExit(f"{binary} ended with {process.returncode}")
    return answer, usage.ru_maxrss * 1024, usage.ru_utime + usage.ru_stime


def fastest(turns):
    steps = {step: min(answer["steps"][step] for answer, _, _ in turns) for step in turns[0][0]["steps"]}
    return {"steps": steps, "triangles": turns[0][0]["triangles"], "peak": max(peak for _, peak, _ in turns), "cpu": min(cpu for _, _, cpu in turns) / 3}


def main(old, new, survey, what):
    turns = {old: [], new: []}
    with tempfile.TemporaryDirectory() as before, tempfile.TemporaryDirectory() as after:
        for _ in range(TURNS):
            turns[old].append(plan(old, survey, before))
            turns[new].append(plan(new, survey, after))
        same = filecmp.cmp(Path(before) / "receivers0.f32", Path(after) / "receivers0.f32", shallow=False)
    changes = json.loads(KEPT.read_text(encoding="utf-8")) if KEPT.exists() else []
    changes = [change for change in changes if change["what"] != what]
    changes.append({"what": what, "before": fastest(turns[old]), "after": fastest(turns[new]), "same_arrays": same})
    KEPT.write_text(json.dumps(changes, indent=1) + "\n", encoding="utf-8")
    print(f"arrays {'are the same' if same else 'DIFFER'}")


main(*sys.argv[1:])
