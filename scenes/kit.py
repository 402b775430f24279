"""What the generators share: a clean file, meshes with two UV layers, materials, lights, camera, saving.

Works on Blender 3.4 to 5.2 without numpy. Sockets are addressed by name, never by position.

Every mesh gets two UV layers:
  UVMap     the layer that textures and normal maps use (active, active for rendering); lengths in
            metres divided by the tile size, so that a texture keeps its scale from object to object;
  Lightmap  charts that never overlap, packed into [0,1] with a gap between them.
"""

import math
import os
from array import array

import bpy
from mathutils import Matrix, Vector

DETAIL_UV = "UVMap"
LIGHTMAP_UV = "Lightmap"
BESIDE = "rnmbake beside"  # on pictures: where they lie, from the .blend's folder


# ---- the file ------------------------------------------------------------------------------------


def start(exposure=0.0, look="None"):
    """An empty file, set up for an unbiased Cycles render. Returns its scene."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.context.preferences.filepaths.save_version = 0  # no .blend1 beside the file
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    cycles = scene.cycles
    cycles.samples = 64
    cycles.use_denoising = False  # some builds have no denoiser and then render black
    cycles.use_adaptive_sampling = False
    cycles.sample_clamp_indirect = 0.0
    cycles.blur_glossy = 0.0
    cycles.max_bounces = 12
    cycles.diffuse_bounces = 12
    cycles.glossy_bounces = 4
    scene.render.resolution_x = 640
    scene.render.resolution_y = 400
    scene.view_settings.view_transform = "Filmic"
    scene.view_settings.look = look
    scene.view_settings.exposure = exposure
    return scene


def save(path):
    """The .blend, and beside it the pictures that it finds by relative paths."""
    for image in bpy.data.images:
        if BESIDE in image:
            _write_beside(image, os.path.dirname(path))
    bpy.ops.wm.save_as_mainfile(filepath=str(path), compress=True, check_existing=False, relative_remap=False)


def picture_beside(folder, name, size, colors):
    """A square sRGB picture that becomes FOLDER/NAME.png beside the .blend when that is saved."""
    image = bpy.data.images.new(name, size, size, alpha=False)
    image.pixels.foreach_set(array("f", [value for color in colors for value in (*color, 1.0)]))
    image[BESIDE] = f"{folder}/{name}.png"
    return image


def _write_beside(image, folder):
    image.filepath_raw, image.file_format = os.path.join(folder, image[BESIDE]), "PNG"
    image.save()
    image.filepath_raw = "//" + image[BESIDE]


# ---- meshes --------------------------------------------------------------------------------------


class Chart:
    """A rectangle of the lightmap, `width` x `height` metres, and the corners that lie in it."""

    def __init__(self, width, height):
        self.width, self.height = width, height
        self.first_face = 0
        self.corners = []  # for each face, for each corner: (s, t) in [0,1] of the rectangle


class Builder:
    """Collects patches and turns them into one object.

    `tile` is the size of one texture repeat in metres, `margin` the empty rim around each chart as a
    share of the lightmap's side.
    """

    def __init__(self, tile=1.0, margin=0.012):
        self.tile, self.margin = tile, margin
        self.vertices, self.faces, self.detail = [], [], []
        self.slots, self.smooth, self.charts = [], [], []

    def grid(self, point, columns, rows, size, slot=0, smooth=True, wrap=False, tiles=None):
        """A patch `point(s, t)`, s and t in [0,1]; it faces along dP/ds x dP/dt. One chart.

        `size`: its width and height in metres; `wrap`: column 0 follows the last one; `tiles`: how
        often the texture repeats, default size / tile.
        """
        tiles = tiles or (size[0] / self.tile, size[1] / self.tile)
        base, stride = len(self.vertices), columns if wrap else columns + 1
        for row in range(rows + 1):
            for column in range(stride):
                self.vertices.append(Vector(point(column / columns, row / rows)))
        chart = Chart(*size)
        chart.first_face = len(self.faces)
        for row in range(rows):
            for column in range(columns):
                ring = [(column, row), (column + 1, row), (column + 1, row + 1), (column, row + 1)]
                self.faces.append([base + r * stride + c % stride for c, r in ring])
                corners = [(c / columns, r / rows) for c, r in ring]
                chart.corners.append(corners)
                self.detail.append([(s * tiles[0], t * tiles[1]) for s, t in corners])
                self.slots.append(slot)
                self.smooth.append(smooth)
        self.charts.append(chart)

    def quad(self, corner, along_u, along_v, slot=0, cells=(1, 1), tiles=None):
        """A flat rectangle from `corner`; it faces along_u x along_v."""
        corner, along_u, along_v = Vector(corner), Vector(along_u), Vector(along_v)
        self.grid(lambda s, t: corner + along_u * s + along_v * t, cells[0], cells[1],
                  (along_u.length, along_v.length), slot, False, tiles=tiles)

    def box(self, low, high, slot=0, turn=0.0, inward=False, skip=""):
        """An upright box, turned by `turn` degrees about its own vertical axis.

        `skip` names sides to leave out: any of "x X y Y z Z" (low and high side of each axis).
        """
        low, high = Vector(low), Vector(high)
        centre, half = (low + high) / 2, (high - low) / 2
        rotation = Matrix.Rotation(math.radians(turn), 3, "Z")
        for side, normal, along_u in (("x", (-1, 0, 0), (0, -1, 0)), ("X", (1, 0, 0), (0, 1, 0)),
                                      ("y", (0, -1, 0), (1, 0, 0)), ("Y", (0, 1, 0), (-1, 0, 0)),
                                      ("z", (0, 0, -1), (1, 0, 0)), ("Z", (0, 0, 1), (1, 0, 0))):
            if side in skip:
                continue
            n, u = Vector(normal), Vector(along_u)
            v = n.cross(u)
            if inward:
                u = -u
            scaled = [Vector(a * b for a, b in zip(axis, half)) for axis in (n, u, v)]
            corner = centre + rotation @ (scaled[0] - scaled[1] - scaled[2])
            self.quad(corner, rotation @ (2 * scaled[1]), rotation @ (2 * scaled[2]), slot)

    def lathe(self, profile, segments, centre=(0, 0, 0), slot=0, smooth=True, shape=None, tiles=None):
        """Turns `profile`, a list of (radius, height) from bottom to top, about the vertical axis.

        `shape(angle, share)`, share in [0,1] along the profile, scales the radius (flutes, folds).
        """
        centre = Vector(centre)
        length = sum(math.dist(a, b) for a, b in zip(profile, profile[1:]))
        girth = 2 * math.pi * sum(r for r, _ in profile) / len(profile)

        def point(s, t):
            radius, height = profile[round(t * (len(profile) - 1))]
            angle = 2 * math.pi * s
            radius *= shape(angle, t) if shape else 1.0
            return centre + Vector((radius * math.cos(angle), radius * math.sin(angle), height))

        self.grid(point, segments, len(profile) - 1, (girth, length), slot, smooth, True, tiles)

    def object(self, name, materials, matrix=None):
        """The object, linked to the scene."""
        mesh = bpy.data.meshes.new(name)
        mesh.from_pydata([tuple(v) for v in self.vertices], [], self.faces)
        mesh.polygons.foreach_set("material_index", self.slots)
        mesh.polygons.foreach_set("use_smooth", self.smooth)
        add_uv(mesh, DETAIL_UV, [uv for face in self.detail for uv in face])
        add_uv(mesh, LIGHTMAP_UV, self._lightmap())
        activate_uv(mesh)
        return add_object(name, mesh, materials, matrix)

    def _lightmap(self):
        places = pack([(c.width, c.height) for c in self.charts], self.margin)
        layer = [None] * len(self.faces)
        for chart, (x, y, width, height) in zip(self.charts, places):
            for offset, corners in enumerate(chart.corners):
                layer[chart.first_face + offset] = [(x + s * width, y + t * height) for s, t in corners]
        return [uv for face in layer for uv in face]


def pack(sizes, margin):
    """Places rectangles in the unit square: shelves, tallest first, all at the largest common scale that fits.

    Returns (x, y, width, height) for each, the rim of `margin` left out; what is used is then
    stretched to the whole square.
    """
    order = sorted(range(len(sizes)), key=lambda i: -sizes[i][1])

    def shelves(scale):
        x = y = row = right = 0.0
        places = {}
        for i in order:
            width, height = (side * scale + 2 * margin for side in sizes[i])
            if x > 0 and x + width > 1:
                x, y, row = 0.0, y + row, 0.0
            places[i] = (x, y, width, height)
            x, row = x + width, max(row, height)
            right = max(right, x)
        return places, right, y + row

    low, high = 0.0, 1.0 / min(max(side) for side in sizes)
    for _ in range(40):
        middle = (low + high) / 2
        _, right, top = shelves(middle)
        low, high = (middle, high) if right <= 1 and top <= 1 else (low, middle)
    places, right, top = shelves(low)
    stretched = []
    for i in range(len(sizes)):
        x, y, width, height = places[i]
        stretched.append((x / right + margin, y / top + margin, width / right - 2 * margin, height / top - 2 * margin))
    return stretched


def add_uv(mesh, name, corners):
    layer = mesh.uv_layers.new(name=name, do_init=False)
    layer.data.foreach_set("uv", [value for uv in corners for value in uv])


def activate_uv(mesh):
    """Textures use UVMap unless a node names another layer."""
    layer = mesh.uv_layers[DETAIL_UV]
    layer.active_render = True
    mesh.uv_layers.active = layer


def add_object(name, mesh, materials, matrix=None):
    mesh.validate()
    mesh.update()
    for material in materials:
        mesh.materials.append(material)
    thing = bpy.data.objects.new(name, mesh)
    if matrix is not None:
        thing.matrix_world = matrix
    bpy.context.scene.collection.objects.link(thing)
    return thing


# ---- materials -----------------------------------------------------------------------------------


def _empty_tree(owner):
    if owner.node_tree is None:  # Blender 5 makes it by itself and warns about use_nodes
        owner.use_nodes = True
    owner.node_tree.nodes.clear()
    return owner.node_tree


class Nodes:
    """A node tree under construction: `add` a node, `wire` an output socket to an input, by name."""

    def __init__(self, owner):
        self.tree = _empty_tree(owner)

    def add(self, kind, **inputs):
        """A node of type `kind`; keyword "Base_Color" sets the socket "Base Color" if it exists."""
        node = self.tree.nodes.new(kind)
        for name, value in inputs.items():
            socket = node.inputs.get(name.replace("_", " "))
            if socket is not None:
                socket.default_value = value
        return node

    def wire(self, source, output, target, socket):
        self.tree.links.new(source.outputs[output], target.inputs[socket])


def rgba(color):
    return (*color, 1.0) if len(color) == 3 else tuple(color)


def diffuse(name, color, emission=None):
    """A Lambertian material; `emission` is the radiance (r, g, b) that it adds on both sides."""
    material = bpy.data.materials.new(name)
    nodes = Nodes(material)
    output = nodes.add("ShaderNodeOutputMaterial")
    surface = nodes.add("ShaderNodeBsdfDiffuse", Color=rgba(color), Roughness=0.0)
    if emission is None:
        nodes.wire(surface, "BSDF", output, "Surface")
        return material
    glow = nodes.add("ShaderNodeEmission", Color=rgba(emission), Strength=1.0)
    both = nodes.tree.nodes.new("ShaderNodeAddShader")
    nodes.tree.links.new(surface.outputs["BSDF"], both.inputs[0])  # two sockets of one name
    nodes.tree.links.new(glow.outputs["Emission"], both.inputs[1])
    nodes.wire(both, "Shader", output, "Surface")
    return material


def emitter(name, color, strength=1.0):
    """Pure emission: reflects nothing."""
    material = bpy.data.materials.new(name)
    nodes = Nodes(material)
    glow = nodes.add("ShaderNodeEmission", Color=rgba(color), Strength=strength)
    nodes.wire(glow, "Emission", nodes.add("ShaderNodeOutputMaterial"), "Surface")
    return material


# ---- light ---------------------------------------------------------------------------------------


def direction(angle, azimuth):
    """Unit vector `angle` degrees off +Z, `azimuth` degrees from +X towards +Y."""
    a, b = math.radians(angle), math.radians(azimuth)
    return Vector((math.sin(a) * math.cos(b), math.sin(a) * math.sin(b), math.cos(a)))


def aim(thing, position, towards):
    """Places a light or camera at `position`, looking along `towards` (its local -Z)."""
    thing.location = position
    thing.rotation_euler = Vector(towards).to_track_quat("-Z", "Y").to_euler()


def sun(towards_sun, strength, color=(1, 1, 1), size=0.0):
    """A sun; `size` is its disk's angle in degrees. E/pi on a surface that faces it is strength / pi."""
    data = bpy.data.lights.new("sun", "SUN")
    data.energy, data.color, data.angle = strength, color, math.radians(size)
    return _add_light(data, Vector(towards_sun) * 10, -Vector(towards_sun))


def area(name, position, towards, size, power, color=(1, 1, 1)):
    """A one-sided rectangular lamp, `size` = (width, height) in metres, `power` in watts."""
    data = bpy.data.lights.new(name, "AREA")
    data.shape, data.size, data.size_y = "RECTANGLE", size[0], size[1]
    data.energy, data.color = power, color
    return _add_light(data, position, towards)


def _add_light(data, position, towards):
    thing = bpy.data.objects.new(data.name, data)
    aim(thing, position, towards)
    bpy.context.scene.collection.objects.link(thing)
    return thing


def world(color=(0, 0, 0), strength=1.0):
    """A sky of one colour."""
    sky = bpy.data.worlds.new("sky")
    nodes = Nodes(sky)
    background = nodes.add("ShaderNodeBackground", Color=rgba(color), Strength=strength)
    nodes.wire(background, "Background", nodes.add("ShaderNodeOutputWorld"), "Surface")
    bpy.context.scene.world = sky


def camera(position, target, lens=35.0):
    data = bpy.data.cameras.new("camera")
    data.lens, data.clip_start, data.clip_end = lens, 0.01, 3000.0
    thing = bpy.data.objects.new("camera", data)
    aim(thing, position, Vector(target) - Vector(position))
    bpy.context.scene.collection.objects.link(thing)
    bpy.context.scene.camera = thing
