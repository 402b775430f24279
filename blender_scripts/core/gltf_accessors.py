"""Numbers out of glTF buffers: enough for what is placed or checked here. Meshes are the importer's business."""
import sys
from array import array

# componentType -> (code of array and struct, what 1 is where integers are normalized)
COMPONENTS = {5120: ("b", 127), 5121: ("B", 255), 5122: ("h", 32767), 5123: ("H", 65535), 5125: ("I", None),
              5126: ("f", None)}
TYPES = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT2": 4, "MAT3": 9, "MAT4": 16}


def element_bytes(accessor):
    """Columns of matrices start at multiples of 4 bytes."""
    size = array(COMPONENTS[accessor["componentType"]][0]).itemsize
    columns = {"MAT2": 2, "MAT3": 3, "MAT4": 4}.get(accessor["type"], 0)
    return columns * (columns * size + -columns * size % 4) if columns else TYPES[accessor["type"]] * size


def read_elements(gltf, number):
    """Tuples of numbers, normalized where the accessor says so. No matrices."""
    accessor = gltf.items("accessors")[number]
    width = TYPES[accessor["type"]]
    values = read_dense(gltf, accessor)
    if "sparse" in accessor:
        put_sparse(gltf, accessor, values)
    one = COMPONENTS[accessor["componentType"]][1] if accessor.get("normalized") else None
    if one:
        values = [max(value / one, -1.0) for value in values]
    return list(zip(*(values[i::width] for i in range(width))))


def read_dense(gltf, accessor):
    """An array of all components in a row; zeros where there is no buffer view."""
    code, size = COMPONENTS[accessor["componentType"]][0], element_bytes(accessor)
    if "bufferView" not in accessor:
        return array(code, bytes(size * accessor["count"]))
    data = gltf.read_view(accessor["bufferView"])
    stride = gltf.items("bufferViews")[accessor["bufferView"]].get("byteStride", size)
    start = accessor.get("byteOffset", 0)
    if stride == size:
        return little_endian(code, data[start:start + size * accessor["count"]])
    at = range(start, start + stride * accessor["count"], stride)
    return little_endian(code, b"".join(data[i:i + size] for i in at))


def put_sparse(gltf, accessor, values):
    sparse, width = accessor["sparse"], TYPES[accessor["type"]]
    indices = read_dense(gltf, {"type": "SCALAR", "count": sparse["count"], **sparse["indices"]})
    given = read_dense(gltf, {"type": accessor["type"], "componentType": accessor["componentType"],
                              "count": sparse["count"], **sparse["values"]})
    for place, index in enumerate(indices):
        values[index * width:index * width + width] = given[place * width:place * width + width]


def little_endian(code, data):
    values = array(code, data)
    if sys.byteorder == "big":
        values.byteswap()
    return values
