#include "pipeline/make_targets.h"

#include "base/error.h"
#include "base/log.h"
#include "pipeline/unwrap.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

namespace rnmbake {
namespace {

constexpr const char* unwrapped_layer = "Lightmap";
constexpr double packing_guess = 0.6;       // share of the square that charts usually fill
constexpr double widest_margin = 1.0 / 16;  // of the square; more would leave small maps no room for charts

Uvs layer_uvs(const Mesh& mesh, int layer) {
  return std::make_shared<const std::vector<Vec2>>(mesh.uv_layers[static_cast<std::size_t>(layer)].uv);
}

/// An object that was selected, on its way to becoming targets.
struct Candidate {
  std::size_t object = 0;
  ObjectSettings settings;
  std::optional<int> lightmap, tangent;
  Uvs uv;
};

class TargetMaker {
 public:
  TargetMaker(Workspace& workspace, const Survey& survey) : workspace_(workspace), survey_(survey) {}

  TargetList make() {
    check_patterns();
    for (std::size_t i = 0; i < survey_.objects.size(); ++i) consider(i);
    if (last_error_) throw Error(*last_error_);
    if (candidates_.empty()) {
      fail(ExitCode::invalid_input, "nothing to bake in {}: none of its {} objects is selected and has faces",
           survey_.scene_file, survey_.objects.size());
    }
    unwrap_those_without_uv();
    for (const Candidate& candidate : candidates_) add_targets(candidate);
    return std::move(list_);
  }

 private:
  void check_patterns() const {
    std::vector<std::string> names;
    for (const SceneObject& object : survey_.objects) {
      names.push_back(object.name);
      names.push_back(object.key);
    }
    const auto unmatched = unmatched_patterns(workspace_.config(), names);
    if (unmatched.empty()) return;
    fail(ExitCode::usage, "'{}' ({}) matches no object of {}; rnmbake inspect lists them",
         unmatched.front().pattern, unmatched.front().where, survey_.scene_file);
  }

  void consider(std::size_t index) {
    const SceneObject& object = survey_.objects[index];
    const Mesh& mesh = survey_.mesh_of(object);
    if (!workspace_.config().selects(object.name, object.key)) return skip(object, "not selected");
    if (mesh.triangles() == 0) return skip(object, "no faces");
    try {
      Candidate candidate;
      candidate.object = index;
      candidate.settings = workspace_.config().for_object(object.name, object.key);
      candidate.lightmap = choose_lightmap_uv(mesh, candidate.settings, object.key).layer;
      candidate.tangent = choose_tangent_uv(mesh, candidate.settings, object.key);
      if (candidate.lightmap) candidate.uv = layer_uvs(mesh, *candidate.lightmap);
      candidates_.push_back(std::move(candidate));
    } catch (const Error& error) {
      if (last_error_) log::error("{}", last_error_->what());
      last_error_ = error;
    }
  }

  void skip(const SceneObject& object, const char* reason) {
    list_.skipped.push_back({object.key, reason});
    log::debug("{}: {}", object.key, reason);
  }

  void unwrap_those_without_uv() {
    std::vector<UnwrapRequest> requests;
    std::vector<Candidate*> waiting;
    for (Candidate& candidate : candidates_) {
      if (candidate.uv) continue;
      requests.push_back({candidate.object, margin_share(candidate)});
      waiting.push_back(&candidate);
    }
    if (requests.empty()) return;
    const std::vector<Uvs> unwrapped = unwrap(workspace_, survey_, requests);
    for (std::size_t i = 0; i < waiting.size(); ++i) waiting[i]->uv = unwrapped[i];
  }

  [[nodiscard]] double margin_share(const Candidate& candidate) const {
    const SceneObject& object = survey_.objects[candidate.object];
    const Mesh& mesh = survey_.mesh_of(object);
    std::vector<std::uint32_t> all(mesh.triangles());
    for (std::uint32_t t = 0; t < all.size(); ++t) all[t] = t;
    const std::vector<Vec2> none(mesh.loop_vertex.size());
    const Areas guess{areas(mesh, all, none, object.to_world).world, packing_guess};
    const double side = choose_resolution(candidate.settings, guess);
    return std::min(candidate.settings.unwrap_margin / side, widest_margin);
  }

  void add_targets(const Candidate& candidate) {
    const SceneObject& object = survey_.objects[candidate.object];
    const Mesh& mesh = survey_.mesh_of(object);
    const auto layer_name = [&](int layer) { return mesh.uv_layers[static_cast<std::size_t>(layer)].name; };
    for (Part& part : split_mesh(mesh, object.slots, candidate.settings.split)) {
      Target target;
      target.object = candidate.object;
      target.key = part.name.empty() ? object.key : object.key + "/" + part.name;
      target.uv = candidate.uv;
      target.unwrapped = !candidate.lightmap;
      target.flip_green = candidate.settings.flip_green;
      target.uv_layer = candidate.lightmap ? layer_name(*candidate.lightmap) : unwrapped_layer;
      target.tangent_uv = candidate.tangent ? layer_uvs(mesh, *candidate.tangent) : candidate.uv;
      target.tangent_layer = candidate.tangent ? layer_name(*candidate.tangent) : target.uv_layer;
      target.width = target.height =
          choose_resolution(candidate.settings, areas(mesh, part.triangles, *target.uv, object.to_world));
      target.glowing = glowing_materials(survey_, candidate.object, part.triangles);
      target.part = std::move(part);
      list_.targets.push_back(std::move(target));
      list_.settings.push_back(candidate.settings);
    }
  }

  Workspace& workspace_;
  const Survey& survey_;
  std::vector<Candidate> candidates_;
  std::optional<Error> last_error_;
  TargetList list_;
};

}  // namespace

TargetList make_targets(Workspace& workspace, const Survey& survey) {
  return TargetMaker(workspace, survey).make();
}

}  // namespace rnmbake
