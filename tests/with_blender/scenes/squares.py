"""What scenes of black squares have in common."""
import bpy


def empty_dark_scene():
    for ob in list(bpy.data.objects):
        bpy.data.objects.remove(ob)
    world = bpy.context.scene.world = bpy.data.worlds.new("black")
    world.use_nodes = True
    world.node_tree.nodes["Background"].inputs["Strength"].default_value = 0


def mesh_of(name, quads):
    """Quads side by side in the UV square; each starts at its lower left corner and runs anti-clockwise."""
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata([corner for quad in quads for corner in quad], [],
                     [tuple(range(4 * i, 4 * i + 4)) for i in range(len(quads))])
    share = 1 / len(quads)
    uvs = [value for i in range(len(quads)) for u, v in ((0, 0), (1, 0), (1, 1), (0, 1))
           for value in ((i + u) * share, v)]
    mesh.uv_layers.new(name="Lightmap").data.foreach_set("uv", uvs)
    return mesh
