"""Self-shadowed bump maps of more directions under a moving sun: a table of docs/ssbump-methods.md.

    ssbump_directions.py [--bench build/release/bench_ssbump_directions] [--heightmaps ../shared/heightmaps]
                         [--measured FILE]

Other arguments go on to the bench. --measured takes what an earlier run printed instead of measuring.
"""
import document
from measure import ROOT
from ssbump_accuracy import measured, table

DOCUMENT = ROOT / "docs/ssbump-methods.md"


def titled(row):
    power = f", power {row['power']:g}" if "power" in row else ""
    return f"{row['set']}: {row['weights']}{power}"


def summary(rows):
    """Over all maps: root of the mean square error, means of the rest; per byte of half floats."""
    count = len(rows)
    rmse = (sum(row["rmse"] ** 2 for row in rows) / count) ** 0.5
    contrast = sum(row["contrast"] for row in rows) / count
    below = sum(row["below"] for row in rows) / count
    noise = f"{sum(row['noise'] for row in rows) / count:.2f}" if "noise" in rows[0] else ""
    size = str(2 * rows[0]["channels"]) if rows[0]["channels"] else ""
    return [size, f"{rmse:.3f}", f"{100 * contrast:.0f} %", f"{100 * below:.0f} %", noise]


def text(rows):
    maps = list(dict.fromkeys(row["map"] for row in rows))
    kinds = list(dict.fromkeys(map(titled, rows)))
    head = ["set: weights", "bytes a texel", "RMSE, all", "contrast", "below 0", "noise", *maps]
    lines = []
    for kind in kinds:
        of_kind = [row for row in rows if titled(row) == kind]
        by_map = {row["map"]: f"{row['rmse']:.3f}" for row in of_kind}
        lines.append([kind, *summary(of_kind), *(by_map[name] for name in maps)])
    return "\n" + table(head, lines)


def main():
    document.renew(DOCUMENT, text(measured(__doc__, "bench_ssbump_directions")), "directions")


if __name__ == "__main__":
    main()
