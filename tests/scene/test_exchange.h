// tests/scene/test_exchange.h - a small scene with something of everything that a .rnmscene file holds.
#pragma once

#include "scene/diffuse_scene.h"
#include "scene/test_meshes.h"

namespace rnmbake {

inline DiffuseScene everything() {
  DiffuseScene scene;
  scene.survey.scene_file = "room.blend";
  scene.survey.scene_name = "Scene";
  scene.survey.blender_version = "3.4.1";
  scene.survey.meshes.push_back(square());
  scene.survey.meshes[0].uv_layers = {{"UVMap", square_uv()}, {"Lightmap", square_uv()}};
  scene.survey.meshes[0].active_uv = scene.survey.meshes[0].render_uv = 0;
  SceneObject wall;
  wall.key = wall.name = "Wall/柱";
  wall.type = "MESH";
  wall.mesh = 0;
  wall.slots = {"brick", "lamp"};
  wall.to_world = Mat44(1, 0, 0, 0, 0, 2, 0, 0, 0, 0, 3, 0, 5, 6, 7, 1);
  SceneObject ghost = wall;
  ghost.key = "ghost";
  ghost.visible_to_camera = false;
  scene.survey.objects = {wall, ghost};
  scene.survey.materials["brick"] = {"brick", true, false, {"glossy"}};
  LightInfo lamp;
  lamp.name = "lamp";
  lamp.type = "AREA";
  lamp.shape = "DISK";
  lamp.energy = 12.5;
  lamp.max_bounces = 3;
  lamp.color = {1, 0.5, 0.25};
  lamp.sizes = {{"size", 0.1}, {"size_y", 0.2}};
  scene.survey.lights = {lamp};
  scene.survey.probe_places = {{"volume", Mat44(), {4, 3, 2}}};
  scene.survey.world = "picture";
  scene.survey.warnings = {"picture missing"};

  scene.pictures.push_back({2, 1, {Vec3(0, 51 * (1.0F / 255), 1), Vec3(1, 1, 0)}, "bytes"});
  scene.pictures.push_back({1, 2, {Vec3(0.25F, 1024, 0), Vec3(0.5F, 2, 8)}, "halves"});
  scene.pictures.push_back({1, 1, {Vec3(0.1F, 70000, 0)}, "floats"});
  scene.picture_uvs = {square_uv()};
  scene.normal_maps = {{0, "UVMap", 0.5F}, {0, "", 1}};
  SurfaceMaterial brick{"brick", Vec3(0), Vec3(0), 0, 1, 0, 0, Vec3(0), 0};
  SurfaceMaterial glow{"lamp", Vec3(0.5F, 0.25F, 0.125F), Vec3(4, 2, 1), -1, -1, -1,
                       1,      Vec3(0.25F, 0.5F, 0.75F)};
  scene.materials = {brick, glow};
  scene.object_materials = {{0, 1}, {1}};
  scene.unlit = {0, 1};
  scene.world.picture = 2;
  scene.camera = Camera{};
  scene.camera->name = "view";
  scene.camera->to_world = wall.to_world;
  scene.camera->shift_x = 0.125;
  scene.outside = {{"object 'Wall'", {"glossy", "bump"}}, {"world", {"volume"}, {"volume"}}};
  return scene;
}

}  // namespace rnmbake
