"""`./dev accuracy scenes`: validates scenes with each Blender, keeps the figures and writes its part of docs/accuracy.md.

What is kept already is not measured again, unless --again says so; --report measures nothing at all.
"""
import argparse
import json
import subprocess
import tempfile
import time
from pathlib import Path

import accuracy_page
import measure
import other_renderer
from scene_figures import figures

RESULTS = Path(__file__).resolve().parent / "results/scene_accuracy.json"
SHARED = measure.ROOT / "../shared/scenes"

# Texels a side and paths for each texel, basis and recipe: about a minute of two cores each.
OURS = {"cornell": (16, 64), "cave": (32, 64), "hall": (16, 32), "panels": (16, 64)}
REAL = {"cornell_box": (16, 64), "living_room": (32, 64), "staircase2": (32, 64)}
# Of large scenes the published recipe bakes only some objects: each of its calls loads the whole scene.
# Its walls reflect so much that a bake's 32 bounces lose 7 % of the light: the reference stops there, too.
BOUNCES = {"living_room": 32}
DECOMPOSED = {"living_room": "Mesh00[013],Mesh040", "staircase2": "Mesh00*"}


def arguments():
    parser = argparse.ArgumentParser(prog="./dev accuracy scenes", description=__doc__)
    parser.add_argument("--blender", action="append", metavar="NAME=PATH", help="may be repeated; real scenes take the first")
    parser.add_argument("--scenes", nargs="+", choices=[*OURS, *REAL], default=[*OURS, *REAL], help="only these")
    parser.add_argument("--resolution", type=int, help="texels a side, for every scene")
    parser.add_argument("--samples", type=int, help="paths for each texel and basis, for every scene")
    parser.add_argument("--again", action="store_true", help="measure what is kept already, too")
    parser.add_argument("--report", action="store_true", help="only write the document")
    parser.add_argument("--closed-forms", type=Path, help="a new text for that part of the document")
    return parser.parse_args()


def blenders(options):
    """(version, path) of each that is there."""
    for word in options.blender or [f"here={measure.BLENDER}"]:
        path = word.split("=", 1)[-1]
        said = subprocess.run([path, "--version"], capture_output=True, text=True, check=False).stdout.split()
        if len(said) > 1:
            yield said[1], path
        else:
            measure.say(f"accuracy: {path} does not run, skipped")


def wanted(options):
    """(scene's name, file, version, Blender) of all that is to be measured."""
    found = list(blenders(options))
    for version, path in found:
        for name in OURS:
            yield name, measure.ROOT / f"scenes/built/{name}.blend", version, path
    for version, path in found[:1]:
        for name in REAL:
            yield name, SHARED / name / f"{name}.blend", version, path


def validate(name, scene, path, resolution, samples):
    measure.WORK.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(dir=measure.WORK) as folder:
        cost = measure.run([measure.RNMBAKE, "validate", scene, "-o", folder, "--blender", path, "--view", 0,
                            "--resolution", resolution, "--samples", samples,
                            "--decompose", DECOMPOSED.get(name, "*"),
                            *(["--bounces", BOUNCES[name]] if name in BOUNCES else [])])
        return {"wall": round(cost["wall"], 1), **figures(Path(folder))}


def machine():
    """The machine without the Blender of the other benchmarks."""
    return measure.machine().rpartition(", ")[0]


def measured(options, name, scene, version, path):
    """One run; with the error in place of figures where it failed."""
    resolution, samples = {**OURS, **REAL}[name]
    head = {"scene": name, "blender": version, "resolution": options.resolution or resolution,
            "samples": options.samples or samples, "date": time.strftime("%Y-%m-%d"), "machine": machine()}
    try:
        return {**head, **validate(name, scene, path, head["resolution"], head["samples"])}
    except SystemExit as stop:
        measure.say(f"accuracy: {name}: {stop}")
        return {**head, "failed": str(stop).strip().splitlines()[-1]}


def read():
    if RESULTS.exists():
        return json.loads(RESULTS.read_text(encoding="utf-8"))
    return {"runs": [], "other_renderer": None}


def write(results):
    """JSON with one line for each object, so that changes can be read."""
    runs = ",\n".join(run_text(run) for run in results["runs"])
    text = f'{{"other_renderer": {json.dumps(results["other_renderer"])},\n"runs": [\n{runs}\n]}}\n'
    RESULTS.write_text(text, encoding="utf-8")


def run_text(run):
    head = json.dumps({key: value for key, value in run.items() if key != "objects"})
    objects = ",\n  ".join(json.dumps(one) for one in run.get("objects", []))
    return f'{head[:-1]}, "objects": [\n  {objects}]}}'


def keep(run):
    """Replace an older run of the same; reads the file again, for another process may have added to it."""
    def key(one):
        return one["scene"], one["blender"]
    results = read()
    results["runs"] = sorted([one for one in results["runs"] if key(one) != key(run)] + [run],
                             key=lambda one: ([*OURS, *REAL].index(one["scene"]), one["blender"]))
    write(results)


def measure_all(options, results):
    have = {(run["scene"], run["blender"]) for run in results["runs"] if "failed" not in run}
    for name, scene, version, path in wanted(options):
        if name not in options.scenes or ((name, version) in have and not options.again):
            continue
        if not scene.exists():
            measure.say(f"accuracy: {scene} is not there, skipped")
            continue
        measure.say(f"accuracy: {name} with Blender {version}")
        keep(measured(options, name, scene, version, path))


def measure_picture(options, results):
    scene = SHARED / "cornell_box/cornell_box.blend"
    version, path = next(blenders(options), (None, None))
    if path and scene.exists() and "cornell_box" in options.scenes and (options.again or not results["other_renderer"]):
        measure.say("accuracy: cornell_box against another renderer's picture")
        results["other_renderer"] = {"blender": version, **other_renderer.compare(scene, path)}
        write(results)


def main():
    options = arguments()
    results = read()
    if not options.report:
        measure_picture(options, results)
        measure_all(options, results)
    accuracy_page.write(read(), [*OURS, *REAL], options.closed_forms)


if __name__ == "__main__":
    main()
