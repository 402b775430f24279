"""Runs a program and says what it cost: wall clock, processor time, memory, and how busy the machine was."""
import contextlib
import json
import os
import shutil
import subprocess
import sys
import tempfile
import threading
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
RNMBAKE = Path(os.environ.get("RNMBAKE", ROOT / "build/release/rnmbake"))
BLENDER = os.environ.get("RNMBAKE_BLENDER") or shutil.which("blender") or "blender"
WORK = ROOT / "out/bench"
LIVING_ROOM = Path(os.environ.get("LIVING_ROOM", ROOT / "../shared/scenes/living_room/living_room.blend"))
HEADLESS = ["-b", "--factory-startup", "-noaudio", "-Y", "--python-exit-code", "86"]
QUIET = 0.75  # of the cores may be busy with other things for a wall clock to be worth reading


def machine():
    """Cores, architecture, system and Blender, on which the figures depend, in words."""
    system = dict(line.rstrip().split("=", 1) for line in open("/etc/os-release", encoding="utf-8") if "=" in line)
    version = subprocess.run([BLENDER, "--version"], capture_output=True, text=True, check=True).stdout.split("\n")[0]
    words = system["PRETTY_NAME"].strip('"').split()
    name = f"{words[0]} {system['VERSION_ID'].strip(chr(34))}" if "VERSION_ID" in system else words[0]
    return f"{os.cpu_count()} cores, {os.uname().machine.replace('_', '-')}, {name}, {version}"


def machine_ticks():
    """(busy, all) processor seconds of the whole machine since it started."""
    fields = [int(n) for n in open("/proc/stat", encoding="ascii").readline().split()[1:9]]
    rate = os.sysconf("SC_CLK_TCK")
    return (sum(fields) - fields[3] - fields[4]) / rate, sum(fields) / rate  # but idle, iowait


def busy_cores(seconds=1.0):
    """Cores that are busy now, over `seconds`, with anything."""
    busy, total = machine_ticks()
    time.sleep(seconds)
    busy2, total2 = machine_ticks()
    return os.cpu_count() * (busy2 - busy) / max(1e-3, total2 - total)


def await_quiet(patience):
    """Waits until the machine does little else, `patience` seconds at most."""
    end = time.monotonic() + patience
    while busy_cores() > QUIET and time.monotonic() < end:
        time.sleep(4)


class Peak(threading.Thread):
    """The largest resident size of one process, children not counted (wait4 mixes them in)."""

    def __init__(self, pid):
        super().__init__(daemon=True)
        self.status, self.kibibytes, self.over = f"/proc/{pid}/status", 0, threading.Event()

    def run(self):
        while not self.over.wait(0.05):
            with contextlib.suppress(OSError, ValueError, IndexError):
                for line in open(self.status, encoding="ascii"):
                    if line.startswith("VmHWM:"):
                        self.kibibytes = max(self.kibibytes, int(line.split()[1]))


def run(argv, environment=None):
    """Runs to the end; stops the benchmark with the program's own words if it fails."""
    start, busy, ticks_before = time.monotonic(), machine_ticks()[0], os.times()
    with tempfile.TemporaryFile("w+") as output:
        process = subprocess.Popen([str(a) for a in argv], stdout=output, stderr=subprocess.STDOUT, cwd=ROOT,
                                   env={**os.environ, **(environment or {})})
        peak = Peak(process.pid)
        peak.start()
        code = process.wait()
        wall, busy = time.monotonic() - start, machine_ticks()[0] - busy
        peak.over.set()
        peak.join()
        output.seek(0)
        text = output.read()
    if code != 0:
        raise SystemExit(f"bench: {' '.join(map(str, argv))} ended with {code}:\n{text[-2000:]}")
    ticks = os.times()
    cpu = ticks.children_user + ticks.children_system - ticks_before.children_user - ticks_before.children_system
    return {"wall": wall, "cpu": cpu, "peak": peak.kibibytes * 1024, "others": max(0.0, busy - cpu) / wall, "output": text}


def bake(scene, *flags, environment=None, rnmbake=RNMBAKE):
    """rnmbake bake into a folder that is thrown away; adds its timings."""
    WORK.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(dir=WORK) as folder:
        cost = run([rnmbake, "bake", scene, "-o", folder, "--save-scene", "never", *flags], environment)
        manifest, timings = (json.loads((Path(folder) / f"{name}.json").read_text(encoding="utf-8"))
                             for name in ("manifest", "timings"))
    del cost["output"]
    sizes = [o["triangles"] for o in manifest["objects"]]
    return {**cost, **timings, "objects": len(sizes), "triangles": sum(sizes)}


def blender(script, *arguments, scene=None):
    """Runs a script of bench/in_blender and returns the JSON that it writes to the path given last."""
    WORK.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(dir=WORK) as folder:
        answer = Path(folder) / "answer.json"
        opened = [str(scene)] if scene else []
        cost = run([BLENDER, *HEADLESS, *opened, "--python", ROOT / "bench/in_blender" / script, "--",
                    *arguments, answer])
        return {**json.loads(answer.read_text(encoding="utf-8")), "cost": {k: cost[k] for k in ("wall", "cpu")}}


def hall(objects):
    """The hall with so many objects, made when it is missing or older than its generator."""
    path = WORK / f"hall_{objects}.blend"
    newest = max(file.stat().st_mtime for file in (ROOT / "scenes").glob("*.py"))
    if not path.exists() or path.stat().st_mtime < newest:
        WORK.mkdir(parents=True, exist_ok=True)
        run([BLENDER, *HEADLESS, "--python", ROOT / "scenes/make.py", "--", "hall", path, f"objects={objects}"])
    return path


def say(text):
    print(text, file=sys.stderr, flush=True)
