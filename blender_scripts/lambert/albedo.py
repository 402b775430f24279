"""Takes albedo, emission and transmittance of every material from Cycles itself, and puts plain materials in place.

Uniform materials share one tiny bake, a square for each: that gives in every version exactly the colour of Cycles'
diffuse pass, and no socket has to be understood here. The others are baked object by object.
"""
import math
from array import array
from contextlib import contextmanager

import bpy
from mathutils import Vector

from core.task import Refusal
from lambert import albedo_uv
from lambert.materials import BLACK, Source, picture, stand_in
from lambert.pixels import brightness, cut, farthest_from_black, keep_if_bright, left_beside, read_pixels
from objects.instance_values import RANDOM
from scene_ops.bench import bench, new_image

CELL = 4  # texels across the square of a uniform material
MARGIN = 8  # texels around charts: they also colour triangles that hold no texel's centre
TEXELS_ACROSS = 1024  # of the diagonal of all that is shown
SMALLEST, LARGEST = 32, 1024
BUDGET = 16 << 20  # texels of all pictures together
FILLED = 0.6  # share of the square that charts usually fill
UNSEEN = (0.8, 0.8, 0.8)  # of a slot that no face uses


class Group:
    """Surfaces that look alike: the same mesh and materials, and nothing in these that depends on the place."""

    def __init__(self, surface, sources):
        self.mesh, self.sources, self.surfaces = surface.data, sources, []
        used = used_slots(self.mesh, len(sources))
        self.varying = [source for slot, source in enumerate(sources) if slot in used and not source.uniform]
        self.layer = self.uv = None
        self.area = 0.0

    @property
    def first(self):
        return self.surfaces[0]

    @property
    def mesh_bound(self):
        return all(source.mesh_bound for source in self.varying)


def replace_materials(task, surfaces):
    """Every slot of every surface gets a lambert material. Returns what the user should be warned of."""
    sources, warnings = {}, []
    groups = make_groups(surfaces, sources)
    with bench() as stand:
        warnings += settle_uniform(stand, [source for source in sources.values() if source.uniform])
        to_bake = [group for group in groups if group.varying]
        density, unwrapped = choose_density(to_bake, surfaces) if to_bake else 0, {}
        for number, group in enumerate(to_bake):
            task.progress("albedo", group.first.name, number, len(to_bake))
            side = choose_uv(stand, group, density, unwrapped)
            warnings += settle_by_bake(stand, group, side)
        for group in groups:
            if not group.varying:
                assign(group, {})
    warnings += lost_warnings(groups)
    for source in sources.values():
        source.remove_copies()
    return warnings


def make_groups(surfaces, sources):
    groups = {}
    for surface in surfaces:
        mesh, materials = surface.data, surface.materials or [None]
        kinds = [(material, RANDOM in surface.values) for material in materials]
        for kind in kinds:
            if kind not in sources:
                sources[kind] = Source(*kind)
        while len(mesh.materials) < len(materials):
            mesh.materials.append(None)
        group = Group(surface, [sources[kind] for kind in kinds])
        look = (mesh.name, tuple(kinds), None if group.mesh_bound else surface.name)
        groups.setdefault(look, group).surfaces.append(surface)
    return list(groups.values())


def used_slots(mesh, slots):
    """Indices past the last slot mean the last slot."""
    indices = array("i", bytes(4 * len(mesh.polygons)))
    mesh.polygons.foreach_get("material_index", indices)
    return {min(index, slots - 1) for index in set(indices)}


# ---- uniform materials ---------------------------------------------------------------------------


def settle_uniform(stand, sources):
    """Give each its plain material, from two or three bakes of one mesh."""
    if not sources:
        return []
    across = math.ceil(math.sqrt(len(sources)))
    image = new_image("rnmbake squares", across * CELL)
    mesh = squares(len(sources), across)
    for source in sources:
        source.write_to(image)
        mesh.materials.append(source.bakeable)
    ob = bpy.data.objects.new("rnmbake squares", mesh)
    transmittance = [BLACK] * len(sources)
    with stand.holding(ob):
        stand.bake(ob, "DIFFUSE", margin=0)
        albedo = centres(image, len(sources), across)
        stand.bake(ob, "EMIT", margin=0)
        emission = centres(image, len(sources), across)
        if any(source.see_through for source in sources):
            show_windows(mesh.materials, sources, image)
            stand.bake(ob, "EMIT", margin=0)
            transmittance = centres(image, len(sources), across)
    for source, color, glow, through in zip(sources, albedo, emission, transmittance):
        through = [left_beside(one, other) for one, other in zip(through, color)]
        source.plain = stand_in(source, tuple(min(value, 1.0) for value in color), glow, through)
    bpy.data.meshes.remove(mesh)
    bpy.data.images.remove(image)
    return [above_one(source.name) for source, color in zip(sources, albedo) if max(color) > 1.0001]


def show_windows(materials, sources, image):
    for slot, source in enumerate(sources):
        materials[slot] = source.window
        source.write_to(image)


def squares(count, across):
    corners, uv = [], []
    for number in range(count):
        x, y = number % across, number // across
        for dx, dy in ((0, 0), (1, 0), (1, 1), (0, 1)):
            corners.append((x + dx, y + dy, 0))
            uv += [(x + dx) / across, (y + dy) / across]
    mesh = bpy.data.meshes.new("rnmbake squares")
    mesh.from_pydata(corners, [], [range(4 * number, 4 * number + 4) for number in range(count)])
    mesh.polygons.foreach_set("material_index", range(count))
    mesh.uv_layers.new(name="squares").data.foreach_set("uv", uv)
    return mesh


def centres(image, count, across):
    pixels = read_pixels(image)
    texels = [(number // across * CELL + CELL // 2) * across * CELL + number % across * CELL + CELL // 2
              for number in range(count)]
    return [tuple(pixels[4 * texel:4 * texel + 3]) for texel in texels]


# ---- materials that vary over the surface --------------------------------------------------------


def choose_density(groups, surfaces):
    """Texels per unit: the same for all, and less where the budget asks for it."""
    density = TEXELS_ACROSS / max(diagonal(surfaces), 1e-9)
    for group in groups:
        group.area = albedo_uv.world_area(group.mesh, group.first.matrix)
    for _ in range(64):
        if sum(choose_side(group, density, FILLED) ** 2 for group in groups) <= BUDGET:
            break
        density *= 0.8
    return density


def choose_side(group, density, filled):
    room_for_charts = min(256.0, 2 * math.sqrt(len(group.mesh.polygons)))
    wanted = math.sqrt(group.area / filled) * density if math.isfinite(group.area) else 0
    return 4 * math.ceil(min(max(wanted, room_for_charts, SMALLEST), LARGEST) / 4)


def diagonal(surfaces):
    corners = [surface.matrix @ Vector(corner) for surface in surfaces for corner in surface.object.bound_box]
    return math.dist([min(axis) for axis in zip(*corners)], [max(axis) for axis in zip(*corners)])


def choose_uv(stand, group, density, unwrapped):
    """Find or make UVs; meshes that several groups share are unwrapped once. Returns the picture's size."""
    mesh = group.mesh
    group.layer = albedo_uv.own_layer(mesh)
    if group.layer is None:
        if mesh not in unwrapped:
            side = choose_side(group, density, FILLED)
            unwrapped[mesh] = albedo_uv.unwrap(stand, mesh, group.first.matrix, side)
        group.uv = unwrapped[mesh]
    uv = group.uv or albedo_uv.read_uv(mesh.uv_layers[group.layer])
    filled = min(max(albedo_uv.filled(mesh, uv), FILLED / 4), 1)  # at most twice the guess
    return choose_side(group, density, filled)


def settle_by_bake(stand, group, side):
    """Bake the group's first surface and give all of them the result."""
    name = group.first.name
    albedo, emission, transmittance = new_image(f"{name} albedo", side), None, None
    with prepared(group) as ob, stand.holding(ob):
        bake_into(stand, ob, group, "DIFFUSE", albedo)
        if any(source.emissive for source in group.varying):
            emission = new_image(f"{name} emission", side)
            bake_into(stand, ob, group, "EMIT", emission)
        if any(source.see_through for source in group.varying):
            transmittance = new_image(f"{name} transmittance", side)
            give_materials(ob, [source.window for source in group.sources])
            bake_into(stand, ob, group, "EMIT", transmittance)
    pixels = read_pixels(albedo)
    if max(pixels[3::4]) == 0 and not any(source.opaque_now or source.see_through for source in group.varying):
        raise Refusal(f"object '{name}': the bake of its albedo covered nothing; give it other lightmap UVs",
                      object_name=name)
    brightest = brightness(pixels)
    if transmittance:
        cut(transmittance, pixels)
    emission, transmittance = keep_if_bright(emission), keep_if_bright(transmittance)
    for image in filter(None, (albedo, emission, transmittance)):
        image.alpha_mode = "NONE"
        image.pack()
    if group.uv:
        albedo_uv.keep_uv(group.mesh, group.uv)
    color = picture(albedo, group.layer, brightest > 1.0001)
    peak = farthest_from_black(read_pixels(emission)) if emission else 1.0
    glow = picture(emission, group.layer, peak=peak) if emission else BLACK
    through = picture(transmittance, group.layer) if transmittance else BLACK
    assign(group, {source: stand_in(source, color, glow if source.emissive else BLACK,
                                    through if source.see_through else BLACK, peak)
                   for source in set(group.varying)})
    return [above_one(name)] if brightest > 1.0001 else []


@contextmanager
def prepared(group):
    """The group's first object, with its own materials, a mesh to bake to, and shown to the camera."""
    ob = group.first.object
    mesh = albedo_uv.mesh_to_bake(group.mesh, group.layer, group.uv)
    ob.data = mesh
    give_materials(ob, [source.bakeable for source in group.sources])
    shown = {"visible_camera": True, "is_holdout": False, "is_shadow_catcher": False}
    before = {flag: getattr(ob, flag) for flag in shown}
    for flag, value in shown.items():
        setattr(ob, flag, value)
    yield ob
    for flag, value in before.items():
        setattr(ob, flag, value)
    ob.data = group.mesh
    bpy.data.meshes.remove(mesh)


def bake_into(stand, ob, group, kind, image):
    for source in group.sources:
        source.write_to(image)
    stand.bake(ob, kind, MARGIN)


# ---- results -------------------------------------------------------------------------------------


def assign(group, by_bake):
    """The uniform slots get plain materials, the others what was baked."""
    for source in group.sources:
        if not source.uniform and source not in by_bake:
            by_bake[source] = stand_in(source, UNSEEN, BLACK)
    materials = [source.plain if source.uniform else by_bake[source] for source in group.sources]
    for surface in group.surfaces:
        give_materials(surface.object, materials)
    for slot in range(len(group.mesh.materials)):
        group.mesh.materials[slot] = None  # the objects' own slots count


def give_materials(ob, materials):
    for slot, material in zip(ob.material_slots, materials):
        slot.link = "OBJECT"
        slot.material = material


def above_one(name):
    return f"{name or 'empty slot'}: Cycles' diffuse colour is above 1 there; cut to 1, since no surface " \
           "reflects more than it gets"


def lost_warnings(groups):
    """One line for each material that lets light through and no longer does, or had a volume."""
    shown = {}
    for group in groups:
        used = used_slots(group.mesh, len(group.sources))
        for source in {source for slot, source in enumerate(group.sources) if slot in used and source.lost()}:
            shown.setdefault(source, []).extend(surface.name for surface in group.surfaces)
    for source, names in shown.items():
        more = f" and {len(names) - 3} more" if len(names) > 3 else ""
        yield f"{', '.join(names[:3])}{more}: material '{source.name}' {source.lost()}"
