"""Checks the law of the rooms (src/README.md): includes go strictly down the floors.

Each folder of src/ is a room on a floor. A file may include its own room and rooms on lower floors,
never a sibling; a library named in OWNED may be included by its rooms alone. Neither files nor the folders
of a room include each other in a circle, and none grows too large. So do the imports of blender_scripts/,
where core/ must run without Blender; they, and those of the tests, name modules that are there. Prints every offence
as file:line: and exits 1 if there is one.
"""

import pathlib
import re
import sys

FLOORS = {
    "base": 0,
    "sampling": 1, "encoding": 1, "shaders": 1, "image": 1, "scene": 1, "config": 1, "process": 1, "rays": 1,
    "texture": 2, "jobs": 2, "blender": 2, "bake": 2, "unwrap": 2, "lightmap": 2, "probes": 2, "trace": 2, "report": 2,
    "ssbump": 3,
    "pipeline": 4,
    "cli": 5,
}
MOST_FILES, MOST_LINES = 25, 350  # of a folder (a header and its source count as one), of a file
SCRIPT_FLOORS = {
    "core": 0, "scene_ops": 1, "nodes": 2, "opening": 2, "survey": 2, "objects": 2,
    "importing": 3, "lambert": 3, "bake": 3, "saved": 3, "export": 4, "render": 4, "deliver": 4,
}
OWNED = {
    "OpenImageIO/": {"image"},
    "OpenEXR/": {"image"},
    "toml++/": {"config", "cli"},
    "CLI/": {"cli"},
    "embree": {"rays"},
    "tbb/": {"trace", "ssbump", "pipeline"},
    "hwy/": {"encoding", "ssbump"},
    "Eigen/": {"encoding"},
    "xxhash.h": {"base"},
    "utf8proc.h": {"base"},
    "stb_rect_pack.h": {"bake"},
    "zlib.h": {"report", "blender"},
    "zstd.h": {"blender", "image"},
}
INCLUDE = re.compile(r'\s*#\s*include\s*([<"])([^>"]+)[>"]')
IMPORT = re.compile(r"\s*from (\w+)(?:\.(\w+))? import ([\w, ]*)")
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


def check_python(scripts):
    for path in sorted(path for path in scripts.rglob("*.py") if path.parent != scripts):
        folder = path.relative_to(scripts).parts[0]
        if folder not in SCRIPT_FLOORS:
            yield f"{path}: a folder without a floor: add it to tools/dev/floors.py and blender_scripts/README.md"
            continue
        for number, line in lines(path):
            if folder == "core" and IMPORT_BPY.match(line):
                yield f"{path}:{number}: core/ must run without Blender; this belongs in scene_ops/"
            match = IMPORT.match(line)
            other = match and match[1]
            if other in SCRIPT_FLOORS and other != folder and SCRIPT_FLOORS[other] >= SCRIPT_FLOORS[folder]:
                yield f"{path}:{number}: {folder} (floor {SCRIPT_FLOORS[folder]}) may not import {other} (floor {SCRIPT_FLOORS[other]})"


def check_imports(root, scripts):
    """A module that has moved away is not found before Blender runs the line."""
    for path in sorted(path for folder in (scripts, root / "tests", root / "bench") for path in folder.rglob("*.py")):
        for number, line in lines(path):
            match = IMPORT.match(line)
            if not match or match[1] not in SCRIPT_FLOORS:
                continue
            modules = [match[2]] if match[2] else [name.split()[0] for name in match[3].split(",") if name.strip()]
            for module in modules:
                if not (scripts / match[1] / f"{module}.py").exists():
                    yield f"{path}:{number}: blender_scripts/{match[1]}/ has no {module}.py"


def main():
    root = pathlib.Path(__file__).resolve().parents[2]
    scripts = root / "blender_scripts"
    offences = [*check_cpp(root / "src"), *check_sizes_and_circles(root / "src"), *check_python(scripts),
                *check_imports(root, scripts)]
    for offence in offences:
        print(offence.replace(f"{root}/", ""), file=sys.stderr)
    return 1 if offences else 0


if __name__ == "__main__":
    sys.exit(main())
