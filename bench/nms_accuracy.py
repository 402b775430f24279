"""Normal mapping shadows against exact ones: the tables of docs/normal-mapping-shadows.md.

    nms_accuracy.py [--bench build/release/bench_nms] [--heightmaps ../shared/heightmaps]
"""
import argparse
import re
import subprocess
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
DOCUMENT = ROOT / "docs/normal-mapping-shadows.md"
BEGIN, END = "<!-- figures: begin -->\n", "<!-- figures: end -->"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--bench", type=Path, default=ROOT / "build/release/bench_nms")
    parser.add_argument("--heightmaps", type=Path, default=ROOT / "../shared/heightmaps")
    options = parser.parse_args()
    command = [options.bench]
    if options.heightmaps.is_dir():
        command += ["--heightmaps", options.heightmaps]
    else:
        print(f"{options.heightmaps} is not there: generated surfaces only")
    tables = subprocess.run(command, check=True, stdout=subprocess.PIPE, encoding="utf-8").stdout
    old = DOCUMENT.read_text(encoding="utf-8")
    new, found = re.subn(f"{BEGIN}.*{END}", lambda _: BEGIN + tables + END, old, flags=re.DOTALL)
    if found != 1:
        raise SystemExit(f"{DOCUMENT} has no place for the figures")
    DOCUMENT.write_text(new, encoding="utf-8")
    print(f"wrote {DOCUMENT.relative_to(ROOT)}")


if __name__ == "__main__":
    main()
