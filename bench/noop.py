"""Milliseconds of a bake in which nothing is to be done: 1,000 objects in several scenes, beside Ninja."""
import os
import shutil
import statistics
import subprocess
import tempfile
import time
from pathlib import Path

from measure import BLENDER, RNMBAKE, WORK, hall, run, say
from tables import table

TITLE = "Nothing to do"
SCENES, OBJECTS, ROUNDS = 4, 250, 20
GOAL_MS = 50
PROJECT = """[bake]
engine = "embree"
resolution = 4
samples = 1
bounces = 0

[output]
dir = "maps"
save_scene = "never"

[run]
blender = "{blender}"
"""
WRAPPER = """#!/bin/sh
echo start >>"{log}"
exec "{blender}" "$@"
"""


def write_project(folder):
    """A project of several halls in the folder, whose Blender notes its starts in the file that is returned."""
    log, wrapper = folder / "starts", folder / "blender"
    wrapper.write_text(WRAPPER.format(blender=shutil.which(BLENDER) or BLENDER, log=log), encoding="utf-8")
    wrapper.chmod(0o755)
    text = PROJECT.format(blender=wrapper)
    for number in range(SCENES):
        shutil.copy(hall(OBJECTS), folder / f"hall{number}.blend")
        text += f'\n[[scenes]]\nfile = "hall{number}.blend"\n'
    (folder / "game.toml").write_text(text, encoding="utf-8")
    return log


def write_ninja(folder, outputs):
    """The same number of files, each made from its scene."""
    lines = ["rule bake", "  command = touch $out"]
    for number, output in enumerate(outputs):
        lines.append(f"build made/{number}{output.suffix}: bake ../{output.parent.name}.blend")
    folder.mkdir()
    (folder / "build.ninja").write_text("\n".join(lines) + "\n", encoding="utf-8")
    run(["ninja", "-C", folder])


def milliseconds(command, folder, environment):
    start = time.perf_counter()
    subprocess.run([str(word) for word in command], cwd=folder, env=environment, check=True, stdin=subprocess.DEVNULL,
                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    return 1000 * (time.perf_counter() - start)


def measure(options):
    del options
    WORK.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(dir=WORK) as name:
        folder = Path(name)
        log = write_project(folder)
        remembers = {key: value for key, value in os.environ.items() if not key.startswith("RNMBAKE_")}
        remembers["XDG_CACHE_HOME"] = str(folder / "cache")
        bake = [RNMBAKE, "bake", "game.toml"]
        say(f"noop: {SCENES} halls of {OBJECTS} objects")
        first = milliseconds(bake, folder, remembers) / 1000
        outputs = sorted(folder.glob("maps/*/*.exr"))
        write_ninja(folder / "ninja", outputs)
        log.write_text("", encoding="utf-8")
        ways = {"remembered": (bake, remembers), "looked up": (bake, {**remembers, "RNMBAKE_CACHE": "none"}),
                "ninja": (["ninja", "-C", "ninja"], remembers)}
        rounds = {way: [] for way in ways}
        for _ in range(ROUNDS):
            for way, (command, environment) in ways.items():
                rounds[way].append(milliseconds(command, folder, environment))
        starts = len(log.read_text(encoding="utf-8").splitlines())
    return {"scenes": SCENES, "outputs": len(outputs), "first_seconds": first, "starts": starts,
            "rounds": ROUNDS, "milliseconds": rounds}


def report(data):
    what = {"remembered": "`rnmbake bake game.toml`, run before on this machine by these words",
            "looked up": "the same where no run is remembered (`RNMBAKE_CACHE=none`): settings are read and Blender is looked for",
            "ninja": "`ninja`, a rule for each of the lightmaps"}
    rows = [[what[way], f"**{statistics.median(times):.1f}**" if way == "remembered" else f"{statistics.median(times):.1f}",
             f"{min(times):.1f}", f"{max(times):.1f}"] for way, times in data["milliseconds"].items()]
    met = statistics.median(data["milliseconds"]["remembered"]) <= GOAL_MS
    return table(["run in which nothing is to be done", "median ms", "least", "most"], rows) + (
        f"\n\nA project of {data['scenes']} scenes with {data['outputs']} lightmaps together, {data['rounds']} rounds of all three in turns, with the start "
        f"of the process. Blender was started {data['starts']} times. The goal is {GOAL_MS} ms: {'met' if met else '**not met**'}.")
