"""Kills bakes at random moments, goes on with them, and holds the result against that of a run that nobody disturbed.

    python3 bench/reliability.py BINARY ROUNDS [--page FILE]

Each round kills rnmbake or its Blender (in turns, SIGKILL) at a moment drawn evenly over the time of a whole run, then runs the
same command again until it succeeds. Every round is added to the file RESULTS, so that rounds of several calls count
together.
"""
import hashlib
import json
from pathlib import Path
import random
import shutil
import subprocess
import sys
import tempfile
import time

ROOT = Path(__file__).resolve().parents[1]
RESULTS = ROOT / "bench" / "results" / "reliability.json"
SCENE = ROOT / "tests" / "with_blender" / "scenes" / "reuse_scene.py"
FLAGS = ("--resolution", "16", "--samples", "128", "--bounces", "0", "--save-scene", "never", "-q")


class Bench:
    def __init__(self, binary, folder):
        self.binary, self.folder = Path(binary).resolve(), Path(folder)
        self.scene = self.folder / "room.blend"
        subprocess.run(["blender", "-b", "--factory-startup", "-noaudio", "--python", SCENE, "--", self.scene], check=True,
                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        began = time.monotonic()
        self.start("whole", "none").wait()
        self.seconds = time.monotonic() - began
        self.whole = self.pictures("whole")

    def start(self, out, cache):
        return subprocess.Popen([self.binary, "bake", self.scene, "-o", self.folder / out, "--cache", cache, *FLAGS],
                                stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)

    def pictures(self, out):
        return {file.name: hashlib.sha256(file.read_bytes()).hexdigest() for file in (self.folder / out).glob("*.exr")}

    def round(self, victim):
        for name in ("out", "cache"):
            shutil.rmtree(self.folder / name, ignore_errors=True)
        process = self.start("out", self.folder / "cache")
        moment = random.uniform(0, self.seconds)
        time.sleep(moment)
        was_running = process.poll() is None
        if victim == "rnmbake":
            process.kill()
        else:
            subprocess.run(["pkill", "-KILL", "-P", str(process.pid)], check=False)
        first = process.wait()
        code = self.start("out", self.folder / "cache").wait()
        equal = code == 0 and self.pictures("out") == self.whole
        leftovers = subprocess.run(["pgrep", "-f", f"{self.folder}/room.blend"], stdout=subprocess.DEVNULL).returncode == 0
        return {"victim": victim, "share": moment / self.seconds, "was_running": was_running, "first": first, "second": code,
                "equal": equal, "leftovers": leftovers}


def page(rounds):
    lines = ["| killed | rounds | while it ran | result equal to the last byte | a process left behind |", "|---|---|---|---|---|"]
    for victim in ("rnmbake", "blender"):
        some = [one for one in rounds if one["victim"] == victim]
        lines.append(f"| {victim} | {len(some)} | {sum(one['was_running'] for one in some)} | {sum(one['equal'] for one in some)} | "
                     f"{sum(one['leftovers'] for one in some)} |")
    return "\n".join(lines)


def main(binary, count, *page_flag):
    rounds = json.loads(RESULTS.read_text(encoding="utf-8")) if RESULTS.exists() else []
    with tempfile.TemporaryDirectory(prefix="rnmbake-killed-") as folder:
        bench = Bench(binary, folder) if int(count) else None
        for number in range(int(count)):
            rounds.append(bench.round(("rnmbake", "blender")[number % 2]))
            RESULTS.parent.mkdir(exist_ok=True)
            RESULTS.write_text(json.dumps(rounds, indent=0) + "\n", encoding="utf-8")
    print(page(rounds))
    if page_flag:
        file = Path(page_flag[1])
        text = file.read_text(encoding="utf-8")
        begin, end = "<!-- rounds -->\n", "<!-- end of rounds -->"
        head, tail = text[:text.index(begin) + len(begin)], text[text.index(end):]
        file.write_text(head + page(rounds) + "\n" + tail, encoding="utf-8")


main(*sys.argv[1:])
