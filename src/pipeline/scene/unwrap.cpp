#include "pipeline/scene/unwrap.h"

#include "base/log.h"
#include "base/object_notes.h"
#include "base/progress.h"
#include "base/text.h"
#include "blender/blender_session.h"
#include "process/stop.h"
#include "unwrap/unwrap_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <tuple>
#include <utility>

namespace rnmbake {
namespace {

constexpr double packing_guess = 0.6;       // share of the square that charts usually fill
constexpr double widest_margin = 1.0 / 16;  // of the square; more would leave small maps no room for charts
constexpr int most_packings = 4;            // for one size

/// Two objects with the same key have the same unwrapping: rotation and place do not matter, scale does.
using Shape = std::array<long, 6>;
using Key = std::tuple<int, Shape, int, int, double, int, int>;

Shape shape_of(const Mat44& to_world) {
  Shape shape{};
  std::size_t at = 0;
  for (int row = 0; row < 3; ++row) {
    for (int other = row; other < 3; ++other) {
      double dot = 0;
      for (int axis = 0; axis < 3; ++axis) dot += to_world[row][axis] * to_world[other][axis];
      shape[at++] = std::lround(dot * 1e4);
    }
  }
  return shape;
}

Key key_of(const SceneObject& object, const ObjectSettings& settings) {
  return {object.mesh,
          shape_of(object.to_world),
          settings.unwrap_margin,
          settings.resolution,
          settings.texels_per_unit,
          settings.min_resolution,
          settings.max_resolution};
}

double world_area(const Mesh& mesh, const Mat44& to_world) {
  std::vector<std::uint32_t> all(mesh.triangles());
  for (std::uint32_t t = 0; t < all.size(); ++t) all[t] = t;
  return areas(mesh, all, std::vector<Vec2>(mesh.loop_vertex.size()), to_world).world;
}

/// Objects whose charts left no room for the margin.
struct Narrowed {
  std::vector<std::string> names;
  double least = 0;  // texels

  void add(const std::string& key, double texels) {
    least = names.empty() ? texels : std::min(least, texels);
    names.push_back(fmt::format("{} ({:.1f})", key, texels));
  }
  void warn() const {
    if (names.empty()) return;
    log::warn(
        "{}: too many charts for the margin asked for, the texels in brackets are left and light may bleed "
        "across ({} objects, at least {:.1f} texels): raise the resolution, or lower --unwrap-margin",
        first_names(names), names.size(), least);
  }
};

/// Packs until size and margin agree: with texels_per_unit the size follows from the packing, the margin's
/// share of the square from the size.
Uvs unwrap_one(const SceneObject& object, const Mesh& mesh, const ObjectSettings& settings,
               Narrowed& narrowed) {
  const double world = world_area(mesh, object.to_world);
  int side = choose_resolution(settings, {world, packing_guess});
  const Charts charts = make_charts(mesh, object.to_world, side);
  Unwrapping made;
  double share = 0;
  for (int i = 0; i < most_packings; ++i) {
    share = std::min(double(settings.unwrap_margin) / side, widest_margin);
    made = unwrap_charts(mesh, charts, share);
    const int needed = choose_resolution(settings, {world, made.uv_area});
    if (needed >= side && needed <= 1.25 * side) break;
    side = needed;
  }
  if (made.margin < share) narrowed.add(object.key, made.margin * side);
  log::debug("{}: {} charts cover {:.0f} % of the square", object.key, charts.charts.size(),
             100 * made.uv_area);
  return std::make_shared<const std::vector<Vec2>>(std::move(made.uv));
}

}  // namespace

std::vector<Uvs> unwrap(const SceneSurvey& survey, const std::vector<UnwrapRequest>& requests) {
  std::map<Key, std::size_t> known;
  std::vector<std::size_t> which;                // [requests] -> meshes
  std::vector<const UnwrapRequest*> first_user;  // [meshes]
  double triangles = 0, done = 0;
  for (const UnwrapRequest& request : requests) {
    const SceneObject& object = survey.objects[request.object];
    const auto [entry, is_new] = known.try_emplace(key_of(object, request.settings), first_user.size());
    which.push_back(entry->second);
    if (!is_new) continue;
    first_user.push_back(&request);
    triangles += static_cast<double>(survey.mesh_of(object).triangles());
  }
  log::info("unwrapping {}", counted(first_user.size(), "mesh"));

  Progress progress("unwrapping", progress_for(log::is_quiet(), log::is_jsonl()));
  Narrowed narrowed;
  std::vector<Uvs> unwrapped;
  for (const UnwrapRequest* request : first_user) {
    if (StopRequest::requested()) throw Interrupted{StopRequest::signal()};
    const SceneObject& object = survey.objects[request->object];
    const Mesh& mesh = survey.mesh_of(object);
    progress.update(done / triangles, object.key);
    unwrapped.push_back(unwrap_one(object, mesh, request->settings, narrowed));
    done += static_cast<double>(mesh.triangles());
  }
  narrowed.warn();
  std::vector<Uvs> result;
  result.reserve(which.size());
  for (const std::size_t mesh : which) result.push_back(unwrapped[mesh]);
  return result;
}

}  // namespace rnmbake
