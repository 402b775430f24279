"""blender -b --factory-startup --python cloud_case.py -- OUT.blend: a plane under a cloud, which is a volume alone."""
import sys

import bpy


def main(path):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.mesh.primitive_plane_add()
    material = bpy.data.materials.new("smoke")
    material.use_nodes = True
    tree = material.node_tree
    tree.nodes.clear()
    output, smoke = tree.nodes.new("ShaderNodeOutputMaterial"), tree.nodes.new("ShaderNodeVolumePrincipled")
    tree.links.new(smoke.outputs[0], output.inputs["Volume"])
    volume = bpy.data.volumes.new("cloud")
    volume.materials.append(material)
    bpy.context.scene.collection.objects.link(bpy.data.objects.new("cloud", volume))
    bpy.ops.wm.save_as_mainfile(filepath=path)


main(sys.argv[sys.argv.index("--") + 1])
