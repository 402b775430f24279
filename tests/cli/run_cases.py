#!/usr/bin/env python3
"""Runs the command-line cases: each folder beside this file holds `command` and `expected`.

    run_cases.py --binary build/release/rnmbake [--update] [CASE ...]

`command` is a shell script; $RNMBAKE is the program. It runs in a private empty folder into which the
case's other files were copied, with none of the caller's RNMBAKE_* variables; its cache is below that folder.

`expected` is what came out:

    the lines of stdout
    -- stderr
    the lines of stderr
    -- exit 1

A line that begins with ~ is a regular expression for the whole of one line; the line ~~ stands for any
number of lines. --update rewrites `expected` where it differs; ~ lines are lost then.
"""

import argparse
import difflib
import os
from pathlib import Path
import re
import shutil
import subprocess
import sys
import tempfile
from typing import List

HERE = Path(__file__).resolve().parent
TIMEOUT_SECONDS = 120


def environment(binary: Path, folder: Path) -> dict:
    env = {key: value for key, value in os.environ.items() if not key.startswith(("RNMBAKE", "XDG_"))}
    env.update(RNMBAKE=str(binary), HOME=str(folder), LC_ALL="C.UTF-8", NO_COLOR="1")
    return env


def run(case: Path, binary: Path) -> List[str]:
    """What the case's command printed, in the form of `expected`."""
    with tempfile.TemporaryDirectory(prefix="rnmbake-case-") as name:
        folder = Path(name)
        for extra in case.iterdir():
            if extra.name in ("command", "expected"):
                continue
            if extra.is_dir():
                shutil.copytree(extra, folder / extra.name)
            else:
                shutil.copy(extra, folder / extra.name)
        done = subprocess.run(
            ["/bin/sh", str(case / "command")], cwd=folder, env=environment(binary, folder),
            stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
            encoding="utf-8", errors="backslashreplace", timeout=TIMEOUT_SECONDS)
    return [*done.stdout.splitlines(), "-- stderr", *done.stderr.splitlines(), f"-- exit {done.returncode}"]


def line_fits(wanted: str, seen: str) -> bool:
    if wanted.startswith("~"):
        return re.fullmatch(wanted[1:], seen) is not None
    return wanted == seen


def fits(wanted: List[str], seen: List[str]) -> bool:
    """As a glob over lines, with ~~ for the star."""
    reachable = {0}  # positions in `seen` up to which the wanted lines so far can reach
    for line in wanted:
        if line == "~~":
            reachable = set(range(min(reachable), len(seen) + 1)) if reachable else set()
        else:
            reachable = {at + 1 for at in reachable if at < len(seen) and line_fits(line, seen[at])}
    return len(seen) in reachable


def check(case: Path, binary: Path, update: bool) -> bool:
    seen = run(case, binary)
    expected = case / "expected"
    wanted = expected.read_text(encoding="utf-8").splitlines() if expected.exists() else []
    if fits(wanted, seen):
        print(f"ok       {case.name}")
        return True
    if update:
        expected.write_text("\n".join(seen) + "\n", encoding="utf-8")
        print(f"updated  {case.name}")
        return True
    print(f"DIFFERS  {case.name}")
    print("\n".join(difflib.unified_diff(wanted, seen, "expected", "seen", lineterm="")))
    return False


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--binary", type=Path, required=True)
    parser.add_argument("--update", action="store_true")
    parser.add_argument("cases", nargs="*", metavar="CASE")
    args = parser.parse_args()
    names = args.cases or sorted(path.parent.name for path in HERE.glob("*/command"))
    results = [check(HERE / name, args.binary.resolve(), args.update) for name in names]
    return 0 if results and all(results) else 1


if __name__ == "__main__":
    sys.exit(main())
