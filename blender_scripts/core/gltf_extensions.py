"""glTF extensions: which are followed, by whom, and what it means where nobody follows one."""
from core.gltf_file import UnsupportedGltf

# By core/gltf_prepare.py, whatever the importer does.
OURS = {"EXT_mesh_gpu_instancing", "KHR_node_visibility", "EXT_texture_webp", "MSFT_texture_dds", "MSFT_lod"}
# They change neither shape, nor look, nor light.
HARMLESS = {"KHR_xmp", "KHR_xmp_json_ld", "KHR_node_selectability", "KHR_node_hoverability", "KHR_interactivity",
            "KHR_audio_emitter", "KHR_animation_pointer", "KHR_physics_rigid_bodies", "KHR_implicit_shapes",
            "EXT_structural_metadata", "EXT_mesh_features", "EXT_feature_metadata", "OMI_physics_body",
            "OMI_physics_shape", "OMI_collider", "OMI_audio_emitter", "OMI_spawn_point", "MOZ_hubs_components",
            "VRMC_vrm", "VRMC_springBone", "VRMC_node_constraint", "MSFT_packing_normalRoughnessMetallic",
            "MSFT_packing_occlusionRoughnessMetallic", "GOOGLE_texture_basis"}
# Loss without the extension, and its remedy.
LOST = {
    "EXT_lights_image_based": "its environment gives no light; set a world in Blender",
    "EXT_lights_ies": "its lamps shine alike in all directions",
    "EXT_meshopt_compression": "its meshes cannot be read; export it without compression",
    "KHR_meshopt_compression": "its meshes cannot be read; export it without compression",
    "KHR_draco_mesh_compression": "this Blender lacks the Draco library, so its meshes cannot be read; export it "
                                  "without compression, or use a Blender from blender.org",
    "KHR_texture_basisu": "its KTX2 pictures cannot be read; export them as PNG or JPEG",
    "KHR_materials_variants": "its default materials are baked, not the other variants",
    "KHR_materials_diffuse_transmission": "no light shines through",
    "KHR_materials_volume_scatter": "no light scatters inside",
    "KHR_gaussian_splatting": "its splats are left out",
    "MOZ_lightmap": "its old lightmaps are left out",
}


def uses_of(gltf):
    """Extension -> who uses it, such as "material 'Glass'"; those that are declared only, too."""
    uses = {name: [] for name in gltf.json.get("extensionsUsed", []) + gltf.json.get("extensionsRequired", [])}
    work = [(gltf.json, "the file")]
    for kind, entries in gltf.json.items():
        if isinstance(entries, list):
            work += [(entry, owner_of(kind, number, entry)) for number, entry in enumerate(entries)]
    while work:
        value, owner = work.pop()
        if isinstance(value, dict):
            for name in value["extensions"] if isinstance(value.get("extensions"), dict) else ():
                if owner not in uses.setdefault(name, []):
                    uses[name].append(owner)
            if owner == "the file":
                continue
        work += [(entry, owner) for entry in (value.values() if isinstance(value, dict) else value)
                 if isinstance(entry, (dict, list))]
    return uses


def owner_of(kind, number, entry):
    singular = {"meshes": "mesh"}.get(kind, kind[:-1])
    return f"{singular} {entry['name']!r}" if isinstance(entry, dict) and entry.get("name") else f"{singular} {number}"


def followed(name, importer_knows):
    return name in OURS or name in HARMLESS or importer_knows(name)


def refuse_required(gltf, importer_knows):
    for name in gltf.json.get("extensionsRequired", []):
        if not followed(name, importer_knows):
            remedy = LOST.get(name, "export it without, or import it elsewhere and save it as .blend")
            raise UnsupportedGltf(f"it requires the glTF extension {name}, which this Blender does not know: {remedy}")


def notes_of(gltf, importer_knows):
    """One line for each extension that nobody follows."""
    notes = []
    for name, owners in sorted(uses_of(gltf).items()):
        if name == "KHR_texture_basisu":
            continue  # told of the textures that have no other picture: gltf_prepare.py
        if name == "KHR_materials_variants" or not followed(name, importer_knows):
            notes.append(f"glTF extension {name} is not followed{listed(owners)}"
                         + (f": {LOST[name]}" if name in LOST else ""))
    return notes


def listed(owners, most=3):
    """" (a, b, c and 4 more)"; nothing for none, or for the file as a whole."""
    named = sorted(owner for owner in owners if owner != "the file")
    if not named:
        return ""
    more = f" and {len(named) - most} more" if len(named) > most else ""
    return f" ({', '.join(named[:most])}{more})"
