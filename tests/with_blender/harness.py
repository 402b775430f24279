"""The real rnmbake ($RNMBAKE_BINARY) and the real Blender ($RNMBAKE_BLENDER, or the one on PATH), as the checks of this
folder run them."""
import os
from pathlib import Path
import shutil
import subprocess
import unittest

SCENES = Path(__file__).resolve().parent / "scenes"
LIMIT_SECONDS = 900

# docs/exit-codes.md
OK, USAGE, IO, INVALID_INPUT, ENVIRONMENT, UNSUPPORTED, TASKS_FAILED = range(7)
INTERRUPTED = 130


def blender():
    found = os.environ.get("RNMBAKE_BLENDER") or shutil.which("blender")
    if not found:
        raise unittest.SkipTest("SKIPPED: no Blender to test with")
    return found


def run_blender(script, *arguments, scene=None, **more):
    """Runs a script, with the scene open; where it fails, AssertionError with what Blender said."""
    opened = [str(scene)] if scene else []
    done = subprocess.run(
        [blender(), "-b", "--factory-startup", "-noaudio", "--python-exit-code", "86", *opened, "--python", str(script),
         "--", *map(str, arguments)],
        env={**os.environ, "PATH": f"{Path(blender()).parent}:{os.environ['PATH']}", **more}, stdin=subprocess.DEVNULL, capture_output=True, timeout=LIMIT_SECONDS)
    if done.returncode != OK:
        said = (done.stdout + done.stderr).decode(errors="replace")
        raise AssertionError(f"Blender ended with {done.returncode}: {said[-4000:]}")


def environment(**more):
    """Without settings of the caller's; a variable that is empty is not set."""
    env = {key: value for key, value in os.environ.items() if not key.startswith("RNMBAKE")}
    env.update(RNMBAKE_BLENDER=blender(), RNMBAKE_CACHE="none", NO_COLOR="1", **more)
    return {key: value for key, value in env.items() if value}


def binary():
    return os.environ["RNMBAKE_BINARY"]


def rnmbake(*arguments):
    """How it ended, with what it said as text."""
    return subprocess.run([binary(), *map(str, arguments)], env=environment(), stdin=subprocess.DEVNULL,
                          capture_output=True, encoding="utf-8", timeout=LIMIT_SECONDS)


def run_program(*words, code=OK, cwd=None, **more):
    """How it ended; AssertionError with what it said where that is not with this exit code."""
    done = subprocess.run([str(word) for word in words], env=environment(**more), cwd=cwd, stdin=subprocess.DEVNULL,
                          capture_output=True, encoding="utf-8", timeout=LIMIT_SECONDS)
    if done.returncode != code:
        raise AssertionError(f"{' '.join(map(str, words[:2]))} ended with {done.returncode}: {done.stdout}{done.stderr}")
    return done
