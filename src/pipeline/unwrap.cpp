#include "pipeline/unwrap.h"

#include "base/error.h"
#include "base/log.h"

#include <array>
#include <fstream>
#include <map>
#include <utility>

namespace rnmbake {
namespace {

/// Two objects with the same key have the same unwrapping: rotation and place do not matter, scale does.
using Key = std::pair<int, std::array<long, 7>>;

Key key_of(const SceneObject& object, double margin) {
  std::array<long, 7> shape{};
  std::size_t at = 0;
  for (int row = 0; row < 3; ++row) {
    for (int other = row; other < 3; ++other) {
      double dot = 0;
      for (int axis = 0; axis < 3; ++axis) dot += object.to_world[row][axis] * object.to_world[other][axis];
      shape[at++] = std::lround(dot * 1e4);
    }
  }
  shape[at] = std::lround(margin * 1e6);
  return {object.mesh, shape};
}

template <typename T>
void append(std::ofstream& out, const std::vector<T>& values) {
  out.write(reinterpret_cast<const char*>(values.data()),
            static_cast<std::streamsize>(values.size() * sizeof(T)));
}

void write_mesh(std::ofstream& out, const Mesh& mesh, const Mat44& to_world) {
  std::vector<Vec3> positions;
  positions.reserve(mesh.positions.size());
  for (const Vec3& position : mesh.positions) {
    Vec3d scaled;
    to_world.multDirMatrix(Vec3d(position), scaled);
    positions.emplace_back(scaled);
  }
  append(out, positions);
  append(out, mesh.loop_vertex);
  append(out, mesh.polygon_start);
  append(out, mesh.polygon_size);
}

Uvs read_uvs(std::ifstream& in, std::size_t loops) {
  std::vector<Vec2> uv(loops);
  in.read(reinterpret_cast<char*>(uv.data()), static_cast<std::streamsize>(loops * sizeof(Vec2)));
  if (!in)
    fail(ExitCode::tasks_failed, "Blender unwrapped fewer corners than it was given: is the disk full?");
  return std::make_shared<const std::vector<Vec2>>(std::move(uv));
}

}  // namespace

std::vector<Uvs> unwrap(Workspace& workspace, const Survey& survey,
                        const std::vector<UnwrapRequest>& requests) {
  Launch launch;
  launch.entry = "unwrap_entry.py";
  launch.folder = workspace.new_folder("unwrap");
  launch.request["meshes"] = nlohmann::json::array();
  std::ofstream out(launch.folder / "unwrap.bin", std::ios::binary);
  std::map<Key, std::size_t> known;
  std::vector<std::size_t> which;  // [requests] -> meshes sent
  std::vector<std::size_t> loops;  // [meshes sent]
  for (const UnwrapRequest& request : requests) {
    const SceneObject& object = survey.objects[request.object];
    const Mesh& mesh = survey.mesh_of(object);
    const auto [entry, is_new] = known.try_emplace(key_of(object, request.margin), loops.size());
    which.push_back(entry->second);
    if (!is_new) continue;
    loops.push_back(mesh.loop_vertex.size());
    write_mesh(out, mesh, object.to_world);
    launch.request["meshes"].push_back({{"label", object.key},
                                        {"vertices", mesh.positions.size()},
                                        {"loops", mesh.loop_vertex.size()},
                                        {"polygons", mesh.polygon_start.size()},
                                        {"margin", request.margin}});
  }
  out.close();
  if (!out) fail(ExitCode::io, "cannot write {}: is the disk full?", (launch.folder / "unwrap.bin").string());
  log::info("unwrapping {} mesh{}", loops.size(), loops.size() == 1 ? "" : "es");

  const auto folder = launch.folder;
  const auto answer = workspace.run(std::move(launch));
  std::ifstream in(folder / answer.at("file").get<std::string>(), std::ios::binary);
  std::vector<Uvs> unwrapped;
  unwrapped.reserve(loops.size());
  for (const std::size_t count : loops) unwrapped.push_back(read_uvs(in, count));
  std::vector<Uvs> result;
  result.reserve(which.size());
  for (const std::size_t index : which) result.push_back(unwrapped[index]);
  return result;
}

}  // namespace rnmbake
