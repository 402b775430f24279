"""Checks a glTF file's references and sizes before the importer, whose answer to broken files is a traceback."""
import math

from core.gltf_accessors import COMPONENTS, TYPES, element_bytes, little_endian
from core.gltf_extensions import owner_of, refuse_required
from core.gltf_file import BrokenGltf

EACH = object()  # every entry of a list, every value of an object
TOP_LISTS = ("scenes", "nodes", "meshes", "materials", "textures", "images", "samplers", "accessors", "bufferViews",
             "buffers", "cameras", "skins")
# Indices: the list that they stand in, the way to them, the list that they point into.
REFERENCES = (
    ("scenes", ("nodes", EACH), "nodes"),
    ("nodes", ("children", EACH), "nodes"),
    ("nodes", ("mesh",), "meshes"),
    ("nodes", ("camera",), "cameras"),
    ("nodes", ("skin",), "skins"),
    ("nodes", ("extensions", "KHR_lights_punctual", "light"), "lights"),
    ("nodes", ("extensions", "EXT_mesh_gpu_instancing", "attributes", EACH), "accessors"),
    ("meshes", ("primitives", EACH, "attributes", EACH), "accessors"),
    ("meshes", ("primitives", EACH, "targets", EACH, EACH), "accessors"),
    ("meshes", ("primitives", EACH, "indices"), "accessors"),
    ("meshes", ("primitives", EACH, "material"), "materials"),
    ("meshes", ("primitives", EACH, "extensions", "KHR_draco_mesh_compression", "bufferView"), "bufferViews"),
    ("skins", ("joints", EACH), "nodes"),
    ("skins", ("skeleton",), "nodes"),
    ("skins", ("inverseBindMatrices",), "accessors"),
    ("textures", ("source",), "images"),
    ("textures", ("extensions", EACH, "source"), "images"),
    ("textures", ("sampler",), "samplers"),
    ("images", ("bufferView",), "bufferViews"),
    ("accessors", ("bufferView",), "bufferViews"),
    ("accessors", ("sparse", "indices", "bufferView"), "bufferViews"),
    ("accessors", ("sparse", "values", "bufferView"), "bufferViews"),
    ("bufferViews", ("buffer",), "buffers"),
)
ATTRIBUTES = {"POSITION": ("VEC3",), "NORMAL": ("VEC3",), "TANGENT": ("VEC3", "VEC4"), "TEXCOORD": ("VEC2",),
              "COLOR": ("VEC3", "VEC4"), "JOINTS": ("VEC4",), "WEIGHTS": ("VEC4",)}  # TANGENT: VEC3 in targets
DEEPEST = 1000  # nodes above a node
LARGEST_ZEROS = 1 << 30  # bytes that accessors without data may stand for
PLACE = {"translation": 3, "rotation": 4, "scale": 3, "matrix": 16}


def check(gltf, importer_knows):
    """Raises BrokenGltf for the first thing that is wrong. `importer_knows`: an extension."""
    check_version(gltf.json)
    check_lists(gltf)
    refuse_required(gltf, importer_knows)
    for owner, way, target in REFERENCES:
        check_references(gltf, owner, way, target)
    for number, material in enumerate(gltf.items("materials")):
        check_textures(gltf, material, f"material {number}")
    check_scene(gltf)
    check_images(gltf)
    check_buffers(gltf)
    check_accessors(gltf)
    check_meshes(gltf)
    check_skins(gltf)
    check_tree(gltf.items("nodes"))


def check_version(document):
    version = document.get("asset", {}).get("version") if isinstance(document.get("asset"), dict) else None
    if not isinstance(version, str):
        raise BrokenGltf("no glTF: its JSON does not say which version it is")
    if version.split(".")[0] != "2":
        raise BrokenGltf(f"glTF {version}, and Blender reads glTF 2 only; convert it")


def check_lists(gltf):
    for name in TOP_LISTS:
        entries = gltf.json.get(name, [])
        if not isinstance(entries, list) or not all(isinstance(entry, dict) for entry in entries):
            raise BrokenGltf(f'"{name}" is no list of objects; export it again')
        for number, entry in enumerate(entries):
            if not isinstance(entry.get("name", ""), str):
                raise BrokenGltf(f'"{name}" {number}: its name is no text; export it again')
    for name in ("extensionsUsed", "extensionsRequired"):
        named = gltf.json.get(name, [])
        if not isinstance(named, list) or not all(isinstance(entry, str) for entry in named):
            raise BrokenGltf(f'"{name}" is no list of names; export it again')
    lights = list(follow(gltf.json, ("extensions", "KHR_lights_punctual", "lights", EACH), "the file"))
    if not all(isinstance(light, dict) for _, light in lights):
        raise BrokenGltf("a light is no object; export it again")


def follow(value, way, where):
    """(where, value) of everything that a way of keys leads to."""
    if not way:
        yield where, value
    elif not isinstance(value, (dict, list)) or (isinstance(value, list) and way[0] is not EACH):
        raise BrokenGltf(f"{where} is not what glTF wants there; export it again")
    elif way[0] is EACH:
        for key, entry in value.items() if isinstance(value, dict) else enumerate(value):
            yield from follow(entry, way[1:], f"{where}, {key}")
    elif way[0] in value:
        yield from follow(value[way[0]], way[1:], f"{where}, {way[0]}")


def check_references(gltf, owner, way, target):
    count = len(gltf.lights() if target == "lights" else gltf.items(target))
    for number, entry in enumerate(gltf.items(owner)):
        for where, index in follow(entry, way, f'"{owner}" {number}'):
            if not is_index(index) or index >= count:
                raise BrokenGltf(f'{where}: no entry {index} in "{target}", which has {count}; export it again')


def is_index(value):
    return isinstance(value, int) and not isinstance(value, bool) and value >= 0


def check_textures(gltf, value, where):
    """Their names differ between extensions, but all end in "Texture"."""
    for key, entry in value.items():
        if not isinstance(entry, dict) or key == "extras":
            continue
        if key.endswith("Texture") and not (is_index(entry.get("index")) and
                                            entry["index"] < len(gltf.items("textures"))):
            raise BrokenGltf(f"{where}, {key}: there is no texture {entry.get('index')}; export it again")
        check_textures(gltf, entry, f"{where}, {key}")


def check_scene(gltf):
    scene = gltf.json.get("scene", 0)
    if not is_index(scene) or ("scene" in gltf.json and scene >= len(gltf.items("scenes"))):
        raise BrokenGltf(f"its default scene is number {scene} of {len(gltf.items('scenes'))}; export it again")


def check_images(gltf):
    for number, image in enumerate(gltf.items("images")):
        if isinstance(image.get("uri"), str) == ("bufferView" in image):
            raise BrokenGltf(f"image {number} lies neither in a file nor in a buffer view alone; export it again")


def check_buffers(gltf):
    used = {view.get("buffer") for view in gltf.items("bufferViews")}
    for number, buffer in enumerate(gltf.items("buffers")):
        if number not in used:
            continue
        if not isinstance(buffer.get("uri", ""), str) or not is_index(buffer.get("byteLength")):
            raise BrokenGltf(f"buffer {number}: its uri or length is not what glTF wants; export it again")
        path, _, extent = gltf.buffer_place(number)
        length = len(extent) if path is None else extent
        if length < buffer["byteLength"]:
            raise BrokenGltf(f"buffer {number} is cut off: {length} bytes of {buffer['byteLength']}"
                             f"{f' in {path}' if path else ''}; export or download it again")
    for number, view in enumerate(gltf.items("bufferViews")):
        start, length, stride = view.get("byteOffset", 0), view.get("byteLength"), view.get("byteStride", 4)
        if "buffer" not in view or not all(map(is_index, (start, length, stride))) or stride == 0 or \
                start + length > gltf.items("buffers")[view["buffer"]]["byteLength"]:
            raise BrokenGltf(f"buffer view {number} reaches beyond its buffer; export it again")


def check_accessors(gltf):
    zeros = 0
    for number, accessor in enumerate(gltf.items("accessors")):
        if accessor.get("componentType") not in COMPONENTS or accessor.get("type") not in TYPES or \
                not is_index(accessor.get("count")):
            raise BrokenGltf(f"accessor {number}: its type or count is not what glTF wants; export it again")
        check_range(gltf, accessor, f"accessor {number}")
        if "bufferView" not in accessor:
            zeros += accessor["count"] * element_bytes(accessor)
        sparse = accessor.get("sparse")
        if sparse:
            check_sparse(gltf, accessor, sparse, f"accessor {number}")
    if zeros > LARGEST_ZEROS:
        raise BrokenGltf(f"its accessors ask for {zeros} bytes that no buffer holds; export it again")


def check_sparse(gltf, accessor, sparse, where):
    if not isinstance(sparse, dict) or not is_index(sparse.get("count")) or sparse["count"] > accessor["count"] or \
            not all("bufferView" in sparse.get(part, {}) for part in ("indices", "values")):
        raise BrokenGltf(f"{where}: its sparse part is not what glTF wants; export it again")
    if sparse["indices"].get("componentType") not in (5121, 5123, 5125):
        raise BrokenGltf(f"{where}: its sparse indices are no whole numbers; export it again")
    for part, kind, component in (("indices", "SCALAR", sparse["indices"]["componentType"]),
                                  ("values", accessor["type"], accessor["componentType"])):
        check_range(gltf, {"type": kind, "componentType": component, "count": sparse["count"], **{
            key: sparse[part][key] for key in ("bufferView", "byteOffset") if key in sparse[part]}}, where)


def check_range(gltf, accessor, where):
    if "bufferView" not in accessor or not accessor["count"]:
        return
    view, size, start = gltf.items("bufferViews")[accessor["bufferView"]], element_bytes(accessor), \
        accessor.get("byteOffset", 0)
    end = start + view.get("byteStride", size) * (accessor["count"] - 1) + size if is_index(start) else math.inf
    if end > view["byteLength"]:
        raise BrokenGltf(f"{where}: {accessor['count']} elements do not fit into its buffer view; export it again")


def check_meshes(gltf):
    for number, mesh in enumerate(gltf.items("meshes")):
        primitives = mesh.get("primitives")
        if not isinstance(primitives, list) or not primitives:
            raise BrokenGltf(f"{owner_of('meshes', number, mesh)} has no primitives; export it again")
        for part, primitive in enumerate(primitives):
            check_primitive(gltf, primitive, f"{owner_of('meshes', number, mesh)}, primitive {part}")


def check_primitive(gltf, primitive, where):
    attributes = primitive.get("attributes")
    if not isinstance(attributes, dict) or primitive.get("mode", 4) not in range(7):
        raise BrokenGltf(f"{where} is not what glTF wants; export it again")
    if "POSITION" not in attributes:
        return
    accessors = gltf.items("accessors")
    count = accessors[attributes["POSITION"]]["count"]
    for attribute_set in [attributes, *primitive.get("targets", ())]:
        for name, index in attribute_set.items():
            accessor, types = accessors[index], ATTRIBUTES.get(name.partition("_")[0], TYPES)
            if accessor["count"] != count or accessor["type"] not in types:
                raise BrokenGltf(f"{where}: {accessor['count']} {name}, {accessor['type']}, for {count} vertices; export "
                                 "it again")
    if "indices" in primitive and "KHR_draco_mesh_compression" not in primitive.get("extensions", {}):
        check_indices(gltf, accessors[primitive["indices"]], count, where)


def check_indices(gltf, accessor, count, where):
    code, one = COMPONENTS[accessor["componentType"]]
    if accessor["type"] != "SCALAR" or code not in "BHI":
        raise BrokenGltf(f"{where}: its indices are no whole numbers; export it again")
    if "bufferView" not in accessor or "sparse" in accessor:
        return
    start = accessor.get("byteOffset", 0)
    data = gltf.read_view(accessor["bufferView"])[start:start + element_bytes(accessor) * accessor["count"]]
    largest = max(little_endian(code, data), default=-1)
    if largest >= count:
        raise BrokenGltf(f"{where}: an index of {largest} among {count} vertices; export it again")


def check_skins(gltf):
    for number, skin in enumerate(gltf.items("skins")):
        accessor = gltf.items("accessors")[skin["inverseBindMatrices"]] if "inverseBindMatrices" in skin else None
        joints = skin.get("joints")
        if not joints or accessor and (accessor["count"] < len(joints) or accessor["type"] != "MAT4"):
            raise BrokenGltf(f"{owner_of('skins', number, skin)}: not every joint has its matrix; export it again")


def check_tree(nodes):
    """Every node below one other at most, and none below itself."""
    parents = {}
    for number, node in enumerate(nodes):
        for key, length in PLACE.items():
            if key in node and not are_numbers(node[key], length):
                raise BrokenGltf(f"{owner_of('nodes', number, node)}: its {key} is not {length} numbers; export it "
                                 "again")
        for child in node.get("children", ()):
            if child in parents:
                raise BrokenGltf(f"node {child} lies below two nodes, {parents[child]} and {number}; export it again")
            parents[child] = number
    reached, level = 0, [number for number in range(len(nodes)) if number not in parents]
    for _ in range(DEEPEST):
        reached += len(level)
        level = [child for number in level for child in nodes[number].get("children", ())]
        if not level:
            break
    if level:
        raise BrokenGltf(f"its nodes are nested deeper than {DEEPEST}; flatten its hierarchy")
    if reached < len(nodes):
        raise BrokenGltf("its nodes form a circle: one lies below itself; export it again")


def are_numbers(values, length):
    return isinstance(values, list) and len(values) == length and \
        all(isinstance(value, (int, float)) and not isinstance(value, bool) and math.isfinite(value)
            for value in values)
