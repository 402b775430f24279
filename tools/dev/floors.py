"""Checks the law of the rooms (src/README.md): includes go strictly down the floors.

Each folder of src/ is a room on a floor. A file may include its own room and rooms on lower floors,
never a sibling; a library named in OWNED may be included by its rooms alone. Neither files nor the folders
of a room include each other in a circle, and none grows too large. In blender_scripts/, core/ must run without
Blender. Prints every offence as file:line: and exits 1 if there is one.
"""

import pathlib
import re
import sys

FLOORS = {
    "base": 0,
    "sampling": 1, "encoding": 1, "image": 1, "scene": 1, "config": 1, "process": 1, "rays": 1,
    "texture": 2, "blender": 2, "bake": 2, "unwrap": 2, "lightmap": 2, "trace": 2, "report": 2,
    "ssbump": 3,
    "pipeline": 4,
    "cli": 5,
}
MOST_FILES, MOST_LINES = 25, 350  # of a folder (a header and its source count as one), of a file
OWNED = {
    "OpenImageIO/": {"image"},
    "OpenEXR/": {"image"},
    "toml++/": {"config", "cli"},
    "CLI/": {"cli"},
    "embree": {"rays"},
    "tbb/": {"trace", "ssbump"},
    "hwy/": {"ssbump"},
    "xxhash.h": {"base"},
    "zlib.h": {"report", "blender"},
    "zstd.h": {"blender"},
}
INCLUDE = re.compile(r'\s*#\s*include\s*([<"])([^>"]+)[>"]')
IMPORT_BPY = re.compile(r"\s*(import|from)\s+(bpy|mathutils|bmesh)\b")


def lines(path):
    return enumerate(path.read_text(encoding="utf-8").splitlines(), start=1)


def include_offence(room, quote, target):
    """Why `room` may not include `target`, or None."""
    if quote == "<":
        for prefix, rooms in OWNED.items():
            if target.startswith(prefix) and room not in rooms:
                return f"<{target}> belongs to {', '.join(sorted(rooms))} alone"
        return None
    other = target.split("/")[0]
    if "/" not in target:
        return f'name the room: "{room}/{target}"'
    if other in FLOORS and other != room and FLOORS[other] >= FLOORS[room]:
        return f"{room} (floor {FLOORS[room]}) may not include {other} (floor {FLOORS[other]})"
    return None


def check_cpp(source):
    for folder in sorted(path for path in source.iterdir() if path.is_dir()):
        if folder.name not in FLOORS:
            yield f"{folder}: a room without a floor: add it to tools/dev/floors.py and src/README.md"
            continue
        for path in sorted(folder.rglob("*")):
            if path.suffix not in (".h", ".cpp"):
                continue
            for number, line in lines(path):
                match = INCLUDE.match(line)
                offence = match and include_offence(folder.name, *match.groups())
                if offence:
                    yield f"{path}:{number}: {offence}"


def included(path):
    """The project's own headers that a file includes."""
    matches = (INCLUDE.match(line) for _, line in lines(path))
    return {match[2] for match in matches if match and match[1] == '"'}


def circle(graph):
    """A circle of a {node: nodes} as a list that ends where it begins, or None."""
    done, way = set(), []

    def visit(node):
        if node in way:
            return way[way.index(node):] + [node]
        if node in done:
            return None
        way.append(node)
        found = next(filter(None, map(visit, sorted(graph.get(node, ())))), None)
        way.pop()
        done.add(node)
        return found
    return next(filter(None, map(visit, sorted(graph))), None)


def check_sizes_and_circles(source):
    units, folders, sizes = {}, {}, {}
    for path in sorted(source.rglob("*")):
        if path.suffix not in (".h", ".cpp"):
            continue
        unit = path.relative_to(source).with_suffix("")
        uses = {pathlib.PurePath(name).with_suffix("") for name in included(path)} - {unit}
        units.setdefault(unit, set()).update(uses)
        folders.setdefault(unit.parent, set()).update({use.parent for use in uses} - {unit.parent})
        sizes.setdefault(path.parent, set()).add(unit)
        count = len(path.read_text(encoding="utf-8").splitlines())
        if count > MOST_LINES:
            yield f"{path}: {count} lines, more than {MOST_LINES}: it holds more than one thing"
    for folder, names in sizes.items():
        if len(names) > MOST_FILES:
            yield f"{folder}: {len(names)} files, more than {MOST_FILES}: a folder for each subject"
    for what, graph in (("files", units), ("folders", folders)):
        found = circle(graph)
        if found:
            yield f"{source}: {what} include each other in a circle: {' -> '.join(map(str, found))}"


def check_python(core):
    for path in sorted(core.rglob("*.py")):
        for number, line in lines(path):
            if IMPORT_BPY.match(line):
                yield f"{path}:{number}: core/ must run without Blender; this belongs in scene_ops/"


def main():
    root = pathlib.Path(__file__).resolve().parents[2]
    offences = [*check_cpp(root / "src"), *check_sizes_and_circles(root / "src"),
                *check_python(root / "blender_scripts" / "core")]
    for offence in offences:
        print(offence.replace(f"{root}/", ""), file=sys.stderr)
    return 1 if offences else 0


if __name__ == "__main__":
    sys.exit(main())
