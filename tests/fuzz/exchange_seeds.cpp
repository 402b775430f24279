// exchange_seeds FOLDER: small .rnmscene files from which fuzzing starts.
#include "scene/test_exchange.h"

#include <cstdio>
#include <filesystem>

namespace {

using namespace rnmbake;

/// The least that is a scene.
DiffuseScene one_object() {
  DiffuseScene scene;
  scene.survey.meshes.push_back(square());
  SceneObject object;
  object.key = object.name = "a";
  object.type = "MESH";
  object.mesh = 0;
  scene.survey.objects = {object};
  scene.materials = {SurfaceMaterial{}};
  scene.object_materials = {{0}};
  return scene;
}

/// A mesh without area, mirrored, and one that is empty.
DiffuseScene degenerate() {
  DiffuseScene scene = one_object();
  scene.survey.meshes.push_back(
      triangle_mesh({{0, 0, 0}, {0, 0, 0}, {1, 0, 0}}, {0, 1, 2}, std::vector<Vec3>(3, Vec3(0, 0, 0))));
  scene.survey.meshes.emplace_back();
  for (int mesh = 1; mesh < 3; ++mesh) {
    scene.survey.objects.push_back(scene.survey.objects[0]);
    scene.survey.objects.back().key += std::to_string(mesh);
    scene.survey.objects.back().mesh = mesh;
    scene.survey.objects.back().to_world[0][0] = -1;
    scene.object_materials.push_back({0});
  }
  return scene;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: exchange_seeds FOLDER\n");
    return 1;
  }
  const std::filesystem::path folder = argv[1];
  std::filesystem::create_directories(folder);
  write_diffuse_scene(folder / "everything.rnmscene", everything());
  write_diffuse_scene(folder / "one_object.rnmscene", one_object());
  write_diffuse_scene(folder / "degenerate.rnmscene", degenerate());
  return 0;
}
