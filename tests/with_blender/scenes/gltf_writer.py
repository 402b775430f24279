"""Writes small .glb files with nothing but Python's own library, so that they say what no exporter would."""
import json
import struct
import zlib

FLOAT, UNSIGNED_SHORT, SHORT, BYTE, UNSIGNED_BYTE = 5126, 5123, 5122, 5120, 5121
CODES = {FLOAT: "f", UNSIGNED_SHORT: "H", SHORT: "h", BYTE: "b", UNSIGNED_BYTE: "B"}
TYPES = {1: "SCALAR", 2: "VEC2", 3: "VEC3", 4: "VEC4", 16: "MAT4"}


class Writer:
    """Adds entries to the lists of a glTF and answers with their numbers."""

    def __init__(self):
        self.json = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": []}]}
        self.binary = bytearray()

    def add(self, kind, **entry):
        entries = self.json.setdefault(kind, [])
        entries.append(entry)
        return len(entries) - 1

    def view(self, data, **more):
        self.binary += bytes(-len(self.binary) % 4)
        number = self.add("bufferViews", buffer=0, byteOffset=len(self.binary), byteLength=len(data), **more)
        self.binary += data
        return number

    def accessor(self, rows, component=FLOAT, **more):
        """`rows`: tuples of equal length."""
        flat = [value for row in rows for value in row]
        data = struct.pack(f"<{len(flat)}{CODES[component]}", *flat)
        if "min" not in more and component == FLOAT and len(rows[0]) == 3:
            more.update(min=[min(column) for column in zip(*rows)], max=[max(column) for column in zip(*rows)])
        return self.add("accessors", bufferView=self.view(data), componentType=component, count=len(rows),
                        type=TYPES[len(rows[0])], **more)

    def picture(self, pixels, width, name="picture"):
        """A texture of 8-bit RGBA pixels, row by row from the top."""
        image = self.add("images", bufferView=self.view(png(pixels, width)), mimeType="image/png", name=name)
        return self.add("textures", source=image, sampler=self.add("samplers", magFilter=9728, minFilter=9728))

    def node(self, root=True, **entry):
        number = self.add("nodes", **entry)
        if root:
            self.json["scenes"][0]["nodes"].append(number)
        return number

    def extension(self, name, required=False):
        for key in ("extensionsUsed", "extensionsRequired")[:1 + required]:
            if name not in self.json.setdefault(key, []):
                self.json[key].append(name)

    def lamp(self, **entry):
        """The extensions of a node that holds it."""
        self.extension("KHR_lights_punctual")
        lights = self.json.setdefault("extensions", {}).setdefault("KHR_lights_punctual", {"lights": []})["lights"]
        lights.append(entry)
        return {"KHR_lights_punctual": {"light": len(lights) - 1}}

    def mesh(self, name, positions, triangles, material=None, **attributes):
        """`attributes`: rows of numbers, or the number of an accessor."""
        primitive = {"attributes": {"POSITION": self.accessor(positions)},
                     "indices": self.accessor([(index,) for index in triangles], UNSIGNED_SHORT)}
        for key, rows in attributes.items():
            primitive["attributes"][key] = rows if isinstance(rows, int) else self.accessor(rows)
        if material is not None:
            primitive["material"] = material
        return self.add("meshes", name=name, primitives=[primitive])

    def quad(self, name, half, material=None, **attributes):
        """Faces up (+Y in glTF), with UVs that fill the square."""
        positions = [(-half, 0, half), (half, 0, half), (half, 0, -half), (-half, 0, -half)]
        attributes.setdefault("TEXCOORD_0", [(0, 1), (1, 1), (1, 0), (0, 0)])
        return self.mesh(name, positions, (0, 1, 2, 0, 2, 3), material, **attributes)

    def box(self, name, half, material=None, **attributes):
        corners = [(x, y, z) for x in (-half, half) for y in (-half, half) for z in (-half, half)]
        sides = ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3))
        positions = [corners[i] for side in sides for i in side]
        triangles = [first + i for first in range(0, 24, 4) for i in (0, 1, 2, 0, 2, 3)]
        attributes.setdefault("TEXCOORD_0", 6 * [(0, 1), (1, 1), (1, 0), (0, 0)])
        return self.mesh(name, positions, triangles, material, **attributes)

    def glb(self):
        if self.binary:
            self.json["buffers"] = [{"byteLength": len(self.binary)}]
        text = json.dumps(self.json).encode()
        return container(text + b" " * (-len(text) % 4), bytes(self.binary) + bytes(-len(self.binary) % 4))

    def write(self, path):
        with open(path, "wb") as stream:
            stream.write(self.glb())


def container(text, binary=b""):
    """A .glb of one JSON chunk and one binary chunk."""
    chunks = struct.pack("<I4s", len(text), b"JSON") + text
    if binary:
        chunks += struct.pack("<I4s", len(binary), b"BIN\0") + binary
    return struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks


def png(pixels, width):
    """8-bit RGBA."""
    rows = [pixels[i:i + width] for i in range(0, len(pixels), width)]
    data = b"".join(b"\0" + bytes(value for pixel in row for value in pixel) for row in rows)

    def chunk(kind, content):
        return struct.pack(">I", len(content)) + kind + content + struct.pack(">I", zlib.crc32(kind + content))
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, len(rows), 8, 6, 0, 0, 0)) + \
        chunk(b"IDAT", zlib.compress(data)) + chunk(b"IEND", b"")
