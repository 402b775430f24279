#include "pipeline/scene/make_targets.h"

#include "bake/uv_problems.h"
#include "base/error.h"
#include "base/log.h"
#include "base/object_notes.h"
#include "base/text.h"
#include "pipeline/scene/unwrap.h"
#include "scene/lighting.h"

#include <algorithm>
#include <map>
#include <memory>
#include <optional>
#include <tuple>
#include <utility>

namespace rnmbake {
namespace {

constexpr const char* unwrapped_layer = "Lightmap";
constexpr const char* no_area = "no area";
constexpr std::size_t most_uv_layers = 8;  // of a mesh, in every Blender (MAX_MTFACE)

/// Selected object with its settings and UV layers.
struct Candidate {
  std::size_t object = 0;
  ObjectSettings settings;
  std::optional<int> lightmap, tangent;
  Uvs uv;
};

/// Warns in one line of each kind of harmful problem.
void warn_of_uv_problems(const std::vector<Target>& targets) {
  struct Group {
    std::size_t count = 0;
    std::vector<std::string> names;
  };
  std::map<UvProblem::Kind, Group> groups;
  for (const Target& target : targets) {
    for (const UvProblem& problem : uv_problems(target.uv_report, target.width, target.wanted_side)) {
      Group& group = groups[problem.kind];
      const bool is_size = problem.kind == UvProblem::Kind::capped;
      group.count = is_size ? std::max(group.count, problem.count) : group.count + problem.count;
      group.names.push_back(target.key);
    }
  }
  for (const auto& [kind, group] : groups) {
    const std::string what = spoken({kind, group.count});
    if (*remedy(kind) != 0)
      log::warn("{}: {}; {}", first_names(group.names), what, remedy(kind));
    else
      log::debug("{}: {}", first_names(group.names), what);
  }
}

class TargetMaker {
 public:
  TargetMaker(const ResolvedConfig& config, const SceneSurvey& survey) : config_(config), survey_(survey) {}

  TargetList make() {
    check_patterns();
    for (std::size_t i = 0; i < survey_.objects.size(); ++i) consider(i);
    if (last_error_) throw Error(*last_error_);
    warn_of_skipped();
    if (candidates_.empty()) {
      fail(ExitCode::invalid_input,
           "nothing to bake in {}: of its {} none is selected and has faces with an area", survey_.scene_file,
           counted(survey_.objects.size(), "object"));
    }
    unwrap_those_without_uv();
    for (const Candidate& candidate : candidates_) add_targets(candidate);
    warn_of_uv_problems(list_.targets);
    return std::move(list_);
  }

 private:
  void check_patterns() const {
    std::vector<std::string> names;
    for (const SceneObject& object : survey_.objects) {
      names.push_back(object.name);
      names.push_back(object.key);
    }
    const auto unmatched = unmatched_patterns(config_, names);
    if (unmatched.empty()) return;
    fail(ExitCode::usage, "'{}' ({}) matches no object of {}; rnmbake inspect lists them",
         unmatched.front().pattern, unmatched.front().where, survey_.scene_file);
  }

  void consider(std::size_t index) {
    const SceneObject& object = survey_.objects[index];
    const Mesh& mesh = survey_.mesh_of(object);
    if (!config_.selects(object.name, object.key)) return skip(object.key, "not selected");
    if (mesh.triangles() == 0) return skip(object.key, "no faces");
    if (!has_surface(mesh, mesh.all_triangles(), object.to_world)) return skip(object.key, no_area);
    try {
      Candidate candidate;
      candidate.object = index;
      candidate.settings = config_.for_object(object.name, object.key);
      candidate.lightmap = choose_lightmap_uv(mesh, candidate.settings, object.key).layer;
      candidate.tangent = choose_tangent_uv(mesh, candidate.settings, object.key);
      if (candidate.lightmap)
        candidate.uv = layer_uvs(object.mesh, *candidate.lightmap);
      else
        check_room_for_layer(mesh, object.key);
      candidates_.push_back(std::move(candidate));
    } catch (const Error& error) {
      if (last_error_) log::error("{}", last_error_->what());
      last_error_ = error;
    }
  }

  /// Throws Error(invalid_input) where the mesh has no room for the layer of unwrapped UVs in the saved
  /// scene.
  void check_room_for_layer(const Mesh& mesh, const std::string& key) const {
    if (config_.globals.output.save_scene == OutputSettings::SaveScene::never) return;
    const bool is_there =
        std::ranges::find(mesh.uv_layers, unwrapped_layer, &UvLayer::name) != mesh.uv_layers.end();
    if (is_there || mesh.uv_layers.size() < most_uv_layers) return;
    fail(ExitCode::invalid_input,
         "object '{}': it has {} UV layers, the most that Blender holds, and none is left for its lightmap; "
         "remove one, name one with --uv, or pass --save-scene never",
         key, mesh.uv_layers.size());
  }

  void skip(const std::string& key, const char* reason) {
    list_.skipped.push_back({key, reason});
    log::debug("{}: {}", key, reason);
  }

  void warn_of_skipped() const {
    std::vector<std::string> names;
    for (const Skipped& skipped : list_.skipped) {
      if (skipped.reason == no_area) names.push_back(skipped.key);
    }
    if (names.empty()) return;
    log::warn("{}: {} whose faces have no area; left out", first_names(names),
              counted(names.size(), "object"));
  }

  void unwrap_those_without_uv() {
    std::vector<UnwrapRequest> requests;
    std::vector<Candidate*> waiting;
    for (Candidate& candidate : candidates_) {
      if (candidate.uv) continue;
      requests.push_back({candidate.object, candidate.settings});
      waiting.push_back(&candidate);
    }
    if (requests.empty()) return;
    const std::vector<Uvs> unwrapped = unwrap(survey_, requests);
    for (std::size_t i = 0; i < waiting.size(); ++i) waiting[i]->uv = unwrapped[i];
  }

  /// A layer's UVs; instances of a mesh share them.
  Uvs layer_uvs(int mesh, int layer) {
    Uvs& uvs = layers_[{mesh, layer}];
    const Mesh& of = survey_.meshes[static_cast<std::size_t>(mesh)];
    if (!uvs)
      uvs = std::make_shared<const std::vector<Vec2>>(of.uv_layers[static_cast<std::size_t>(layer)].uv);
    return uvs;
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
      target.tangent_uv = candidate.tangent ? layer_uvs(object.mesh, *candidate.tangent) : candidate.uv;
      target.tangent_layer = candidate.tangent ? layer_name(*candidate.tangent) : target.uv_layer;
      if (!has_surface(mesh, part.triangles, object.to_world)) {
        skip(target.key, no_area);
        continue;
      }
      const Areas sizes = areas(mesh, part.triangles, *target.uv, object.to_world);
      target.width = target.height = choose_resolution(candidate.settings, sizes);
      target.wanted_side = wanted_resolution(candidate.settings, sizes);
      target.uv_report = report_of(target, part);
      target.part = std::move(part);
      list_.targets.push_back(std::move(target));
      list_.settings.push_back(candidate.settings);
    }
  }

  /// Instances that share UVs and size share the report, whose counts are then the same.
  UvReport report_of(const Target& target, const Part& part) {
    const SceneObject& object = survey_.objects[target.object];
    const auto [entry, is_new] =
        reports_.try_emplace({object.mesh, target.uv.get(), part.name, target.width});
    if (is_new) {
      entry->second = report_uv(survey_.mesh_of(object), part.triangles, *target.uv, object.to_world,
                                target.width, target.height);
    }
    return entry->second;
  }

  const ResolvedConfig& config_;
  const SceneSurvey& survey_;
  std::vector<Candidate> candidates_;
  std::map<std::pair<int, int>, Uvs> layers_;  // by mesh and layer
  std::map<std::tuple<int, const void*, std::string, int>, UvReport> reports_;
  std::optional<Error> last_error_;
  TargetList list_;
};

}  // namespace

void check_light(const ResolvedConfig& config, const SceneSurvey& survey) {
  if (config.globals.scene.allow_dark || may_be_lit(survey)) return;
  fail(
      ExitCode::invalid_input,
      "nothing lights {}: no lamp, no sky and no material that emits is rendered, so all would be black; add "
      "light (--sky 1, --sun 135,45,3), or pass --allow-dark",
      survey.scene_file);
}

TargetList make_targets(const ResolvedConfig& config, const SceneSurvey& survey) {
  return TargetMaker(config, survey).make();
}

}  // namespace rnmbake
