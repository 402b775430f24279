"""EXT_mesh_gpu_instancing: every instance becomes a node of its own, called NODE#0, NODE#1, ..."""
from core.gltf_accessors import read_elements
from core.gltf_file import BrokenGltf, UnsupportedGltf

INSTANCES = "EXT_mesh_gpu_instancing"
PLACES = {"TRANSLATION": ("translation", "VEC3"), "ROTATION": ("rotation", "VEC4"), "SCALE": ("scale", "VEC3")}
LONGEST_NAME = 63  # bytes, in Blender
MOST = 1 << 20  # objects that one node may become


def place_instances(gltf):
    """Returns what the user should be warned of."""
    nodes, others = gltf.items("nodes"), set()
    for number, node in enumerate(list(nodes)):
        found = node.get("extensions", {}).pop(INSTANCES, None)
        if found is None or "mesh" not in node:
            continue
        attributes = found.get("attributes", {})
        others |= attributes.keys() - PLACES.keys()
        mesh = gltf.items("meshes")[node["mesh"]]
        name = node.get("name") or mesh.get("name") or f"Node_{number}"
        content = {key: node.pop(key) for key in ("mesh", "weights") if key in node}
        first = len(nodes)
        for index, place in enumerate(places_of(gltf, attributes, name)):
            nodes.append({"name": numbered(name, index), **content, **place})
        node.setdefault("children", []).extend(range(first, len(nodes)))
    return [f"attributes of instances are not followed: {', '.join(sorted(others))}"] if others else []


def places_of(gltf, attributes, name):
    """One {"translation": ..., ...} for each instance."""
    columns = {}
    for attribute, (key, kind) in PLACES.items():
        if attribute in attributes:
            if gltf.items("accessors")[attributes[attribute]]["type"] != kind:
                raise BrokenGltf(f"the {attribute} of the instances of {name!r} is no {kind}; export it again")
            if gltf.items("accessors")[attributes[attribute]]["count"] > MOST:
                raise UnsupportedGltf(f"{name!r} has more instances than {MOST}, and each becomes an object; split it")
            columns[key] = read_elements(gltf, attributes[attribute])
    if len({len(column) for column in columns.values()}) > 1:
        raise BrokenGltf(f"the instances of {name!r} differ in number between their attributes; export it again")
    return [dict(zip(columns, place)) for place in zip(*columns.values())]


def numbered(name, index):
    suffix = f"#{index}"
    return name.encode()[:LONGEST_NAME - len(suffix)].decode(errors="ignore") + suffix
