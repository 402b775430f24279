"""Normal mapping shadows against exact ones: the tables of docs/normal-mapping-shadows.md.

    nms_accuracy.py [--bench build/release/bench_nms] [--heightmaps ../shared/heightmaps]
"""
import argparse
import subprocess
from pathlib import Path

import document
from measure import ROOT

DOCUMENT = ROOT / "docs/normal-mapping-shadows.md"


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
    document.renew(DOCUMENT, tables)


if __name__ == "__main__":
    main()
