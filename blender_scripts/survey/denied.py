"""Properties that do not concern what Cycles renders, by the type of Blender's that has them.

All others count, those that nobody has heard of, too: a bake too many is better than an old one for a new scene. What is
read-only is derived from something else and counts nowhere.
"""

EVERYWHERE = set("""rna_type id_data animation_data original library library_weak_reference override_library asset_data
    preview grease_pencil tag is_runtime_data use_fake_user use_extra_user select show_expanded is_active""".split())

BY_TYPE = {
    "ID": "name",
    # Where an object stands is in its matrix, what shapes it in its evaluated data, what it places in its instances.
    "Object": """data parent parent_type parent_vertices parent_bone use_camera_lock_parent use_parent_final_indices
        track_axis up_axis material_slots active_material active_material_index location rotation_quaternion
        rotation_axis_angle rotation_euler rotation_mode scale dimensions delta_location delta_rotation_euler
        delta_rotation_quaternion delta_scale lock_location lock_rotation lock_rotation_w lock_rotations_4d lock_scale
        matrix_world matrix_local matrix_basis matrix_parent_inverse modifiers grease_pencil_modifiers shader_effects
        constraints vertex_groups face_maps empty_display_type empty_display_size empty_image_offset image_user
        empty_image_depth show_empty_image_perspective show_empty_image_orthographic
        show_empty_image_only_axis_aligned use_empty_image_alpha empty_image_side add_rest_position_attribute field
        collision soft_body particle_systems rigid_body rigid_body_constraint hide_viewport hide_select hide_render
        show_instancer_for_render show_instancer_for_viewport instance_type use_instance_vertices_rotation
        use_instance_faces_scale instance_faces_scale instance_collection display_type show_bounds display_bounds_type
        show_name show_axis show_texture_space show_wire show_all_edges use_grease_pencil_lights show_transparent
        show_in_front pose_library pose show_only_shape_key use_shape_key_edit_mode active_shape_key
        active_shape_key_index display lineart use_mesh_mirror_x use_mesh_mirror_y use_mesh_mirror_z
        animation_visualization motion_path light_linking active_selection_set selection_sets hide_surface_pick
        hide_probe_volume hide_probe_sphere hide_probe_plane use_simulation_cache""",
    # Arrays are read as such.
    "Mesh": """vertices edges loops polygons vertex_normals polygon_normals corner_normals loop_triangles
        loop_triangle_polygons texture_mesh uv_layers uv_layer_clone uv_layer_clone_index uv_layer_stencil
        uv_layer_stencil_index vertex_colors sculpt_vertex_colors vertex_layers_float vertex_layers_int
        vertex_layers_string polygon_layers_float polygon_layers_int polygon_layers_string face_maps skin_vertices
        vertex_creases edge_creases vertex_paint_masks attributes color_attributes remesh_voxel_size
        remesh_voxel_adaptivity use_remesh_fix_poles use_remesh_preserve_volume use_remesh_preserve_paint_mask
        use_remesh_preserve_sculpt_face_sets use_remesh_preserve_vertex_colors use_remesh_preserve_attributes
        remesh_mode use_mirror_x use_mirror_y use_mirror_z use_mirror_vertex_groups use_auto_smooth auto_smooth_angle
        texco_mesh shape_keys use_mirror_topology use_paint_mask use_paint_mask_vertex use_paint_bone_selection
        use_paint_mask_face materials radial_symmetry radial_symmetry_x radial_symmetry_y radial_symmetry_z""",
    "Curves": "curves points attributes color_attributes position_data curve_offset_data normals materials surface_uv_map "
              "use_mirror_x use_mirror_y use_mirror_z use_sculpt_collision surface_collision_distance",
    "PointCloud": "points attributes color_attributes materials",
    "Volume": "filepath grids materials display velocity_x_grid velocity_y_grid velocity_z_grid packed_file is_sequence "
              "frame_start frame_duration frame_offset sequence_mode",
    # Their surface is an evaluated mesh.
    "Curve": "splines shape_keys materials bevel_object taper_object text_boxes body_format",
    "MetaBall": "elements materials",
    "Material": """blend_method shadow_method alpha_threshold show_transparent_back use_screen_refraction
        use_sss_translucency refraction_depth preview_render_type use_preview_world texture_paint_images
        texture_paint_slots paint_active_slot paint_clone_slot diffuse_color specular_color roughness specular_intensity
        metallic line_color line_priority lineart surface_render_method use_transparency_overlap
        use_raytrace_refraction use_thickness_from_shadow thickness_mode use_backface_culling
        use_backface_culling_shadow use_backface_culling_lightprobe_volume max_vertex_displacement
        is_grease_pencil""",
    "Light": """cutoff_distance use_custom_distance shadow_buffer_size shadow_buffer_clip_start shadow_buffer_bias
        shadow_buffer_samples shadow_color use_contact_shadow contact_shadow_distance contact_shadow_bias
        contact_shadow_thickness specular_factor diffuse_factor transmission_factor volume_factor show_cone distance
        shadow_cascade_max_distance shadow_cascade_count shadow_cascade_exponent shadow_cascade_fade
        shadow_softness_factor shadow_trace_distance shadow_filter_radius
        shadow_maximum_resolution shadow_jitter_overblur use_shadow_jitter use_absolute_resolution falloff_curve
        linear_attenuation quadratic_attenuation constant_coefficient linear_coefficient quadratic_coefficient
        falloff_type""",
    "World": """light_settings mist_settings probe_resolution sun_threshold sun_angle use_sun_shadow
        sun_shadow_maximum_resolution sun_shadow_filter_radius sun_shadow_jitter_overblur use_sun_shadow_jitter
        use_eevee_finite_volume""",
    # What is in a picture is read as such.
    "Image": """filepath filepath_raw file_format packed_file packed_files use_view_as_render use_multiview
        display_aspect render_slots tiles resolution pixels stereo_3d_format views_format generated_type
        generated_width generated_height use_generated_float generated_color source""",
    "ImageUser": "use_auto_refresh frame_current tile",
    "Node": """location location_absolute width width_hidden height dimensions name label inputs outputs internal_links
        parent use_custom_color color color_tag show_options show_preview hide show_texture warning_propagation
        bl_label bl_description bl_icon bl_static_type bl_width_default bl_width_min bl_width_max bl_height_default
        bl_height_min bl_height_max""",
    "NodeSocket": """name label description hide link_limit hide_value node display_shape bl_label pin_gizmo
        is_inactive is_icon_visible inferred_structure_type bl_subtype_label""",
    "NodeTree": """nodes links inputs outputs active_input active_output interface view_center bl_label bl_description
        bl_icon annotation default_group_node_width color_tag use_fake_user color_management""",
    "CurveMapping": "tone",
    "Modifier": "name show_viewport show_in_editmode show_on_cage use_pin_to_last persistent_uid execution_time",
    "NodesModifier": """panels bakes bake_directory bake_target node_warnings show_group_selector show_manage_panel
        open_output_attributes_panel open_manage_panel open_bake_panel open_named_attributes_panel
        open_bake_data_blocks_panel open_warnings_panel""",
    "PointCache": "filepath name index",
    "ParticleSystem": "particles child_particles parent cloth",
    "ParticleSettings": "display_color display_method display_percentage display_size display_step color_maximum "
                        "show_guide_hairs show_hair_grid show_health show_number show_size show_unborn show_velocity",
    "Texture": "use_preview_alpha",
    "Camera": "passepartout_alpha display_size stereo background_images",
}

CACHED = {}


def denied(struct):
    """Names of what does not count of a struct; `struct`: a bl_rna, whose bases are asked, too."""
    key = struct.identifier
    if key not in CACHED:
        names, kind = set(EVERYWHERE), struct
        while kind is not None:
            names.update(BY_TYPE.get(kind.identifier, "").split())
            kind = kind.base
        CACHED[key] = names
    return CACHED[key]
