"""The plain materials that the lambert step made, as numbers, pictures and UVs: looks of docs/rnmscene-format.md."""
import json
from array import array

import bpy

from lambert.materials import UV_ATTRIBUTE, shaders_of
from lambert.notes import NORMAL_IMAGE, NORMAL_STRENGTH, NORMAL_UV, OUTSIDE
from scene_ops.keys import LABEL_PROPERTY

UNLIT = [0.0, 0.0, 0.0]
LARGEST_NORMAL_MAP = 2048


class Looks:
    """Lists without repetition; UVs go straight into the survey's file, pictures wait for write_pictures()."""

    def __init__(self, meshes):
        self._meshes = meshes
        self.looks, self.picture_uvs, self.normal_maps = [], [], []
        self._images, self._sides = [], []
        self._index, self._uv_index = {}, {}

    def add(self, material, mesh, mesh_number):
        """The number of the look that a material gives to an evaluated mesh."""
        key = (material.name_full, mesh_number)
        if key not in self._index:
            look = self._describe(material, mesh, mesh_number)
            if look not in self.looks:
                self.looks.append(look)
            self._index[key] = self.looks.index(look)
        return self._index[key]

    def _describe(self, material, mesh, mesh_number):
        shaders = {node.type: node for node in shaders_of(material)}
        albedo, albedo_image, place = read_color(shaders.get("BSDF_DIFFUSE"))
        emission, emission_image, other = read_color(shaders.get("EMISSION"))
        through, through_image, behind = read_color(shaders.get("BSDF_TRANSPARENT"))
        place = place or other or behind
        return {
            "material": material.get(LABEL_PROPERTY, material.name),
            "albedo": [min(max(value, 0.0), 1.0) for value in albedo],
            "emission": emission,
            "transmittance": [min(max(value, 0.0), 1.0) for value in through],
            "albedo_picture": self._picture(albedo_image),
            "emission_picture": self._picture(emission_image),
            "transmittance_picture": self._picture(through_image),
            "picture_uv": self._uv(place, mesh, mesh_number) if place else -1,
            "normal_map": self._normal_map(material, mesh),
        }

    def _picture(self, image, largest_side=0):
        if image is None:
            return -1
        if image not in self._images:
            self._images.append(image)
            self._sides.append(largest_side)
        return self._images.index(image)

    def _uv(self, place, mesh, mesh_number):
        key = (place, mesh_number)
        if key not in self._uv_index:
            self._uv_index[key] = len(self.picture_uvs)
            self.picture_uvs.append({"count": len(mesh.loops), "offset": self._write_uv(place, mesh)})
        return self._uv_index[key]

    def _write_uv(self, place, mesh):
        kind, name = place
        if kind == "layer":
            return self._meshes.write_uv(mesh.uv_layers[name])
        vectors = array("f", bytes(12 * len(mesh.loops)))
        mesh.attributes[UV_ATTRIBUTE].data.foreach_get("vector", vectors)
        uv = array("f", bytes(8 * len(mesh.loops)))
        uv[0::2], uv[1::2] = vectors[0::3], vectors[1::3]
        return self._meshes.append(uv)

    def _normal_map(self, material, mesh):
        image = material.get(NORMAL_IMAGE)
        layer = material.get(NORMAL_UV, "")
        if image is None or (layer not in mesh.uv_layers if layer else not mesh.uv_layers):
            return -1  # without the UVs Cycles shows the plain normal
        entry = {"picture": self._picture(image, LARGEST_NORMAL_MAP), "uv_layer": layer,
                 "strength": material[NORMAL_STRENGTH]}
        if entry not in self.normal_maps:
            self.normal_maps.append(entry)
        return self.normal_maps.index(entry)

    def write_pictures(self):
        """Entries of all pictures; the pixels go into the survey's file."""
        return [write_picture(self._meshes, image, side) for image, side in zip(self._images, self._sides)]


def read_color(shader):
    """(constant, image, place of its UVs): what feeds the colour of a shader."""
    if shader is None:
        return UNLIT, None, None
    socket = shader.inputs["Color"]
    if not socket.is_linked:
        return list(socket.default_value)[:3], None, None
    texture = socket.links[0].from_node
    if texture.type == "COMBXYZ":  # below 0
        return [component.default_value for component in texture.inputs], None, None
    if texture.type == "VECT_MATH":  # the cut at 1, or what the strength makes up for
        texture = texture.inputs[0].links[0].from_node
    place = texture.inputs["Vector"].links[0].from_node
    return UNLIT, texture.image, ("layer", place.uv_map) if place.type == "UVMAP" else ("attribute", UV_ATTRIBUTE)


def outside_of(material):
    return json.loads(material.get(OUTSIDE, "[]"))


def write_picture(file, image, largest_side):
    """The entry of one picture, row 0 on top."""
    scaled = None
    if largest_side and max(image.size) > largest_side:
        scaled = image.copy()
        share = largest_side / max(image.size)
        scaled.scale(*(max(1, round(side * share)) for side in image.size))
    width, height, offset = write_pixels(file, scaled or image)
    entry = {"width": width, "height": height, "form": "f32", "offset": offset, "name": image.name,
             "srgb": not image.is_float and image.colorspace_settings.name == "sRGB"}
    if scaled:
        bpy.data.images.remove(scaled)
    return entry


def write_pixels(file, image):
    """Width, height and the offset of the pixels in the file."""
    return *image.size, file.append(read_colors(image))


def read_colors(image):
    """RGB, top row first."""
    width, height = image.size
    channels = image.channels
    pixels = array("f", bytes(4 * channels * width * height))
    image.pixels.foreach_get(pixels)
    colors = array("f", bytes(12 * width * height))
    for channel in range(3):
        colors[channel::3] = pixels[min(channel, channels - 1)::channels]
    flipped = array("f")
    for row in reversed(range(height)):
        flipped.extend(colors[3 * width * row:3 * width * (row + 1)])
    return flipped
