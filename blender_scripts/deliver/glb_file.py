"""A .glb file: lightmaps added to what an exporter wrote. Nothing here needs bpy.

Khronos, "glTF 2.0 Specification", 4.4 (GLB). MOZ_lightmap: a texture, the UV set and a factor, for each material.
"""
import copy
import json

from core.gltf_file import CHUNK_HEADER, GLB_HEADER, read_gltf

EXTENSION = "MOZ_lightmap"
LIGHTMAP_SET = 1  # TEXCOORD_1
LINEAR, CLAMP = 9729, 33071
DEFAULT_MATERIAL = {"name": "no material", "pbrMetallicRoughness": {"metallicFactor": 0}}


class Glb:
    def __init__(self, document, binary):
        self.json, self.binary = document, binary

    @classmethod
    def read(cls, path):
        gltf = read_gltf(path)
        offset, length = gltf.binary or (0, 0)
        with open(path, "rb") as stream:
            stream.seek(offset)
            return cls(gltf.json, bytearray(stream.read(length)))

    def write(self, path):
        self.json["buffers"] = [{"byteLength": len(self.binary)}]
        text = json.dumps(self.json, separators=(",", ":")).encode()
        text += b" " * (-len(text) % 4)
        binary = bytes(self.binary) + bytes(-len(self.binary) % 4)
        length = GLB_HEADER.size + 2 * CHUNK_HEADER.size + len(text) + len(binary)
        with open(path, "wb") as stream:
            stream.write(GLB_HEADER.pack(b"glTF", 2, length))
            for kind, chunk in ((b"JSON", text), (b"BIN\0", binary)):
                stream.write(CHUNK_HEADER.pack(len(chunk), kind) + chunk)

    def add(self, name, item):
        """Appends to one of the top-level lists; returns its index."""
        items = self.json.setdefault(name, [])
        items.append(item)
        return len(items) - 1

    def add_picture(self, path, name):
        with open(path, "rb") as stream:
            picture = stream.read()
        self.binary += bytes(-len(self.binary) % 4)
        view = self.add("bufferViews", {"buffer": 0, "byteOffset": len(self.binary), "byteLength": len(picture)})
        self.binary += picture
        return self.add("images", {"name": name, "mimeType": "image/png", "bufferView": view})


def add_lightmaps(glb, request, node_property):
    """The pages as textures, and for each node with a lightmap its record and materials of its page. Returns for each
    of the request's objects {"node", "name", "mesh"}, or None where the exporter has left it out."""
    lit = {node.get("mesh") for node in glb.json.get("nodes", []) if node_property in node.get("extras", {})}
    nodes, materials = [None] * len(request["objects"]), PageMaterials(glb, request, materials_of_others(glb, lit))
    for index, node in enumerate(glb.json.get("nodes", [])):
        number = node.get("extras", {}).get(node_property)
        node.pop("extras", None)  # custom properties are the user's own, and Blender's
        if number is None or "mesh" not in node:
            continue
        placed = request["objects"][number]
        node["extras"] = {"rnmbake": {name: placed[name] for name in ("key", "page", "scale", "offset")}}
        materials.give(glb.json["meshes"][node["mesh"]], placed["page"])
        nodes[number] = {"node": index, "name": node["name"], "mesh": node["mesh"]}
    for name in ("meshes", "materials", "scenes", "cameras"):
        for item in glb.json.get(name, []):
            item.pop("extras", None)
    glb.json.setdefault("extras", {})["rnmbake"] = request["record"]
    glb.json["extensionsUsed"] = sorted({*glb.json.get("extensionsUsed", []), EXTENSION})
    return nodes


def materials_of_others(glb, lit):
    """Those that meshes without a lightmap use."""
    others = (mesh for index, mesh in enumerate(glb.json.get("meshes", [])) if index not in lit)
    return {primitive["material"] for mesh in others for primitive in mesh["primitives"] if "material" in primitive}


def make_matt(material):
    """The exporter gives a surface without specular light a black specular colour, and engines still take away from its
    diffuse light what a dielectric reflects at grazing angles."""
    specular = material.get("extensions", {}).get("KHR_materials_specular")
    if specular and specular.get("specularColorFactor") == [0, 0, 0]:
        specular["specularFactor"] = 0


class PageMaterials:
    """Materials with a page's lightmap; one that is used on several pages, or without one (`others`), is copied."""

    def __init__(self, glb, request, others):
        self._glb = glb
        sampler = glb.add("samplers", {"magFilter": LINEAR, "minFilter": LINEAR, "wrapS": CLAMP, "wrapT": CLAMP})
        images = [glb.add_picture(path, f"lightmap {page}") for page, path in enumerate(request["pages"])]
        self._lightmaps = [{"index": glb.add("textures", {"sampler": sampler, "source": image}), "texCoord": LIGHTMAP_SET,
                            "intensity": request["intensity"]} for image in images]
        self._made = {}
        self._plain = [copy.deepcopy(material) for material in glb.json.get("materials", [])]
        self._taken = set(others)

    def give(self, mesh, page):
        for primitive in mesh["primitives"]:
            primitive["material"] = self._of(primitive.get("material"), page)

    def _of(self, material, page):
        key = material, page
        if key not in self._made:
            self._made[key] = self._make(material, page)
        return self._made[key]

    def _make(self, material, page):
        """The material itself for the first page that it is on, unless it is somebody else's, too."""
        lit = copy.deepcopy(DEFAULT_MATERIAL if material is None else self._plain[material])
        make_matt(lit)
        lit.setdefault("extensions", {})[EXTENSION] = self._lightmaps[page]
        if material is None or material in self._taken:
            if material is not None:
                lit["name"] = f"{lit.get('name', 'material')} page {page}"
            return self._glb.add("materials", lit)
        self._taken.add(material)
        self._glb.json["materials"][material] = lit
        return material
