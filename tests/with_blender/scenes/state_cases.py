"""One scene twice: as it is made (clean.blend), and with every setting that says nothing of its light at an extreme.

    blender -b --factory-startup --python state_cases.py -- FOLDER

hostile.blend must be baked to the texels of clean.blend: docs/scene-state.md. state_sweep.py tries settings one by one.
overridden.blend: a view layer's material override. displaced.blend: true displacement.
"""
import math
import os
import sys

import bpy

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [HERE, os.path.join(HERE, "../../../blender_scripts")]

from opening import untrusted  # noqa: E402
from scene_ops import cycles, neutral  # noqa: E402

# What says how light travels in a scene, and is followed: docs/scene-state.md.
FOLLOWED = {
    "cycles": {"caustics_reflective", "caustics_refractive", "volume_bounces", "volume_step_rate", "volume_max_steps",
               "volume_unbiased", "volume_biased", "transparent_max_bounces"},
    "render": {"engine", "hair_type", "hair_subdiv", "frame_map_old", "frame_map_new", "fps", "fps_base"},
    "view_layer": {"use", "use_sky", "use_strand", "use_volumes"},
}


def new_material(name, shader, **inputs):
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    tree = material.node_tree
    tree.nodes.clear()
    node, output = tree.nodes.new(shader), tree.nodes.new("ShaderNodeOutputMaterial")
    for socket, value in inputs.items():
        node.inputs[socket.replace("_", " ")].default_value = value
    tree.links.new(node.outputs[0], output.inputs["Volume" if "Volume" in shader else "Surface"])
    return material


def new_sky(value):
    world = bpy.data.worlds.new("sky")
    world.use_nodes = True
    background = next(node for node in world.node_tree.nodes if node.type == "BACKGROUND")
    background.inputs["Color"].default_value = (value, value, value, 1)
    return world


def add(make, material, **options):
    make(**options)
    ob = bpy.context.object
    ob.data.materials.append(material)
    return ob


def build():
    """Something for every kind of setting: gloss, glass, leaves, fog, hair, a glowing face and lamps of all types."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    mesh, grey = bpy.ops.mesh, new_material("grey", "ShaderNodeBsdfDiffuse", Color=(.7, .6, .5, 1))
    add(mesh.primitive_plane_add, grey, size=4)
    wall = add(mesh.primitive_plane_add, new_material("textured", "ShaderNodeBsdfDiffuse"), size=3, location=(0, 2, 1),
               rotation=(math.pi / 2, 0, 0))
    paint(wall.data.materials[0], "Color")
    add(mesh.primitive_uv_sphere_add, new_material("gloss", "ShaderNodeBsdfGlossy", Roughness=.1), radius=.4,
        location=(-1, 0, .5))
    add(mesh.primitive_uv_sphere_add, new_material("glass", "ShaderNodeBsdfGlass", Roughness=0), radius=.3,
        location=(1, 0, .5))
    add(mesh.primitive_plane_add, new_material("glow", "ShaderNodeEmission", Strength=3), size=.5, location=(0, 0, 2),
        rotation=(math.pi, .3, 0))
    add(mesh.primitive_plane_add, new_material("leaf", "ShaderNodeBsdfTransparent", Color=(.5, .9, .5, 1)), size=1,
        location=(.5, -.5, .4))
    add(mesh.primitive_cube_add, new_material("fog", "ShaderNodeVolumeScatter", Density=.4), size=1,
        location=(-.5, -1, .6))
    rock = add(mesh.primitive_cube_add, grey, size=.5, location=(1.2, 1, .3))
    rock.modifiers.new("levels", "SUBSURF").render_levels = 2
    hairy = add(mesh.primitive_uv_sphere_add, grey, radius=.2, location=(-1, 1, .3))
    hairy.modifiers.new("hair", "PARTICLE_SYSTEM")
    hairy.particle_systems[0].settings.type, hairy.particle_systems[0].settings.count = "HAIR", 50
    hairy.particle_systems[0].settings.child_type = "SIMPLE"
    for kind, place, energy in (("POINT", (1, 1, 1.5), 20), ("SPOT", (-1, -1, 2), 30), ("AREA", (0, 1.5, 2), 20),
                                ("SUN", (0, 0, 5), .5)):
        bpy.ops.object.light_add(type=kind, location=place)
        bpy.context.object.data.energy = energy
    bpy.ops.object.camera_add(location=(0, -5, 2), rotation=(1.2, 0, 0))
    scene.camera = bpy.context.object
    scene.world = new_sky(1)
    background = next(node for node in scene.world.node_tree.nodes if node.type == "BACKGROUND")
    sky = scene.world.node_tree.nodes.new("ShaderNodeTexChecker")
    scene.world.node_tree.links.new(sky.outputs[0], background.inputs[0])
    for ob in scene.objects:  # these do nothing before a switch of the scene is on
        ob.cycles.use_camera_cull = ob.cycles.use_distance_cull = True
    subdivide_for_camera(rock)
    rock.keyframe_insert("location", frame=0)
    rock.location.x += 2
    rock.keyframe_insert("location", frame=2)
    scene.frame_set(1)
    return scene


def subdivide_for_camera(ob):
    for owner in (ob.cycles, ob.modifiers[0]):
        if hasattr(owner, "use_adaptive_subdivision"):
            owner.use_adaptive_subdivision = True


def paint(material, socket):
    tree = material.node_tree
    image = bpy.data.images.new("paint", 512, 512)
    image.generated_type = "COLOR_GRID"
    texture = tree.nodes.new("ShaderNodeTexImage")
    texture.image = image
    tree.links.new(texture.outputs[0], tree.nodes[0].inputs[socket])


def owners(scene):
    layer = bpy.context.view_layer
    return {"cycles": scene.cycles, "render": scene.render, "render.bake": scene.render.bake, "view_layer": layer,
            "view_layer.cycles": layer.cycles, "unit_settings": scene.unit_settings,
            "world.light_settings": scene.world.light_settings}


def extremes(owner, prop):
    now = getattr(owner, prop.identifier)
    if prop.type == "BOOLEAN":
        return [not now]
    if prop.type == "ENUM":
        return [] if prop.is_enum_flag else [item.identifier for item in prop.enum_items if item.identifier != now]
    if prop.type in ("INT", "FLOAT"):
        ends = [0.05 if prop.type == "FLOAT" else 2, max(prop.soft_min, -1000), min(prop.soft_max, 1000)]
        return [type(now)(end) for end in ends if prop.hard_min <= end <= prop.hard_max and end != now]
    return []


def properties(name, owner):
    """Of an owner: those that can be set and are not followed."""
    for prop in owner.bl_rna.properties:
        if not prop.is_readonly and not getattr(prop, "is_array", False) and \
                prop.identifier not in FOLLOWED.get(name, ()):
            yield prop


def make_hostile(scene):
    """One extreme of every setting. Returns how many there were."""
    count = 0
    for name, owner in owners(scene).items():
        for prop in properties(name, owner):
            for value in extremes(owner, prop)[:1]:
                try:
                    setattr(owner, prop.identifier, value)
                    count += 1
                except (TypeError, AttributeError):  # a choice that this build does not have
                    pass
    return count


def measured(scene):
    """Cycles' settings as a bake has them: some need more samples than a test takes before a texel shows them."""
    untrusted.settle_programs(None, scene)
    neutral.neutralise(scene)
    cycles.apply_settings(scene, {"samples": 4, "bounces": 6, "seed": 0, "clamp": 0, "device": "CPU"})
    return {prop.identifier: getattr(scene.cycles, prop.identifier) for prop in properties("cycles", scene.cycles)
            if not prop.identifier.startswith("preview_")}


def overridden():
    """A floor under a sun at 75 degrees, nothing else: E/pi is cos 75, whatever the floor is made of. The override is
    rough and Principled, which is not Lambertian in every Blender. The world is overridden, too."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    layer = bpy.context.view_layer
    bpy.context.scene.world = new_sky(0)
    if hasattr(layer, "world_override"):  # newer Blenders
        bpy.context.scene.world, layer.world_override = new_sky(1), new_sky(0)
    bpy.ops.mesh.primitive_plane_add()
    bpy.ops.object.light_add(type="SUN", rotation=(0, math.radians(75), 0))
    bpy.context.object.data.energy, bpy.context.object.data.angle = math.pi, 0
    layer.material_override = new_material("clay", "ShaderNodeBsdfPrincipled", Roughness=1)


def displaced():
    """A plane that Cycles raises, made of two squares by a modifier, under a sky of 1: E/pi is 1 all over it."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.context.scene.world = new_sky(1)
    material = new_material("raised", "ShaderNodeBsdfDiffuse", Color=(.5, .5, .5, 1))
    owner = material if hasattr(material, "displacement_method") else material.cycles  # before 4.1
    owner.displacement_method = "BOTH"
    tree = material.node_tree
    raised = tree.nodes.new("ShaderNodeDisplacement")
    for name, value in (("Height", 0.1), ("Midlevel", 0), ("Scale", 1)):  # whose defaults are others since 5.2
        raised.inputs[name].default_value = value
    tree.links.new(raised.outputs[0], tree.get_output_node("CYCLES").inputs["Displacement"])
    plane = add(bpy.ops.mesh.primitive_plane_add, material, rotation=(.4, 0, 0))
    plane.modifiers.new("two", "ARRAY").relative_offset_displace = (2, 0, 0)
    plane.scale.z = 3


def save(folder, name):
    bpy.ops.wm.save_as_mainfile(filepath=os.path.join(folder, name))


def main(folder):
    scene = build()
    save(folder, "clean.blend")
    clean = measured(scene)
    subdivide_for_camera(scene.objects["Cube.001"])  # measuring took it away
    if make_hostile(scene) < 100:
        raise RuntimeError("hardly any setting was found")
    save(folder, "hostile.blend")
    hostile = measured(scene)
    leaks = [name for name, value in hostile.items() if value != clean[name]]
    if leaks:
        raise RuntimeError(f"settings of Cycles that reach a bake: {leaks}")
    overridden()
    save(folder, "overridden.blend")
    displaced()
    save(folder, "displaced.blend")


if __name__ == "__main__":
    main(sys.argv[sys.argv.index("--") + 1])
