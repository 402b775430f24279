"""A glTF file as it is: its JSON, and where its buffers lie. Nothing here needs bpy."""
import base64
import binascii
import json
import os
import struct
from urllib.parse import unquote

from core.task import INVALID_INPUT, UNSUPPORTED

GLB_HEADER, CHUNK_HEADER = struct.Struct("<4sII"), struct.Struct("<I4s")
LARGEST_JSON = 1 << 30


class BrokenGltf(Exception):
    """What is wrong with a file and what would mend it, in one line that does not name the file."""

    code = INVALID_INPUT


class UnsupportedGltf(BrokenGltf):
    """A file that is right, but asks for more than can be done."""

    code = UNSUPPORTED


class Gltf:
    def __init__(self, path, document, binary=None):
        self.path = path
        self.json = document
        self.binary = binary  # (offset, length) of a .glb's buffer within the file

    def items(self, name):
        """One of the top-level lists, such as "nodes"."""
        return self.json.get(name, [])

    def extension(self, name):
        return self.json.get("extensions", {}).get(name, {})

    def lights(self):
        return self.extension("KHR_lights_punctual").get("lights", [])

    def buffer_place(self, number):
        """(file, offset, length) of a buffer; (None, 0, bytes) for one that is written in the JSON itself."""
        uri = self.items("buffers")[number].get("uri")
        if uri is None:
            if number == 0 and self.binary:
                return self.path, *self.binary
            raise BrokenGltf(f"buffer {number} has no data: neither a uri nor a .glb's binary chunk; export it again")
        if uri.startswith("data:"):
            data = decode_data_uri(uri, f"buffer {number}")
            return None, 0, data
        path = self.resolve(uri, f"buffer {number}")
        if not os.path.isfile(path):
            raise BrokenGltf(f"its buffer is missing: {path}; put the file beside the scene")
        return path, 0, os.path.getsize(path)

    def files(self):
        """(kind, path) of the buffers and pictures that lie in files of their own."""
        for kind, name in (("buffer", "buffers"), ("picture", "images")):
            for item in self.items(name):
                if item.get("uri") and not item["uri"].startswith("data:"):
                    yield kind, self.resolve(item["uri"], kind)

    def resolve(self, uri, what):
        """The path of a file that the glTF refers to."""
        if "://" in uri:
            raise BrokenGltf(f"{what} lies at {uri}, and nothing is fetched; download it and refer to the file")
        return os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(self.path)), unquote(uri)))

    def read_view(self, number):
        """The bytes of a buffer view."""
        view = self.items("bufferViews")[number]
        path, offset, extent = self.buffer_place(view["buffer"])
        start, length = view.get("byteOffset", 0), view["byteLength"]
        if path is None:
            return extent[start:start + length]
        with open(path, "rb") as stream:
            stream.seek(offset + start)
            return stream.read(length)


def decode_data_uri(uri, what):
    head, _, text = uri.partition(",")
    try:
        return base64.b64decode(text, validate=True) if head.endswith(";base64") else unquote(text).encode("latin-1")
    except (binascii.Error, UnicodeEncodeError) as error:
        raise BrokenGltf(f"{what}: its data: uri is no base64; export it again") from error


def read_gltf(path):
    size = os.path.getsize(path)
    with open(path, "rb") as stream:
        head = stream.read(GLB_HEADER.size)
        if head[:4] == b"glTF":
            return read_glb(path, stream, head, size)
        if size > LARGEST_JSON:
            raise BrokenGltf("no glTF: neither a .glb nor JSON of less than 1 GiB")
        return Gltf(path, parse(head + stream.read()))


def read_glb(path, stream, head, size):
    if len(head) < GLB_HEADER.size:
        raise cut_off(size, GLB_HEADER.size)
    _, version, length = GLB_HEADER.unpack(head)
    if version != 2:
        raise BrokenGltf(f"a .glb of version {version}, and Blender reads version 2 only; convert it")
    if length > size:
        raise cut_off(size, length)
    document, binary, offset = None, None, GLB_HEADER.size
    while offset + CHUNK_HEADER.size <= length:
        stream.seek(offset)
        extent, kind = CHUNK_HEADER.unpack(stream.read(CHUNK_HEADER.size))
        offset += CHUNK_HEADER.size
        if offset + extent > length:
            raise cut_off(size, offset + extent)
        if document is None:
            if kind != b"JSON" or extent > LARGEST_JSON:
                raise BrokenGltf("a .glb whose first chunk is not its JSON; export it again")
            document = parse(stream.read(extent))
        elif kind == b"BIN\0" and binary is None:
            binary = offset, extent
        offset += extent + -extent % 4
    if document is None:
        raise cut_off(size, length)
    return Gltf(path, document, binary)


def cut_off(size, length):
    return BrokenGltf(f"it is cut off: {size} bytes of at least {length}; export or download it again")


def parse(data):
    """JSON as glTF allows it: UTF-8, no NaN, no number that is none."""
    try:
        document = json.loads(data.decode("utf-8-sig"), parse_constant=_refuse_constant, parse_int=_parse_int)
    except RecursionError as error:
        raise BrokenGltf("its JSON is nested deeper than any scene; export it again") from error
    except (UnicodeDecodeError, ValueError) as error:
        raise BrokenGltf(f"no glTF: its JSON is broken ({error}); export or download it again") from error
    if not isinstance(document, dict):
        raise BrokenGltf("no glTF: its JSON is no object")
    return document


def _refuse_constant(text):
    raise ValueError(f"it holds {text}, which is no number")


def _parse_int(text):
    return int(text) if len(text) < 18 else float(text)  # long digits would take time that grows with their square
