#include "pipeline/lightmaps/earlier_lightmaps.h"

#include "base/error.h"
#include "base/files.h"
#include "base/json.h"
#include "base/log.h"
#include "base/read_file.h"
#include "base/text.h"
#include "lightmap/metadata.h"
#include "pipeline/lightmaps/manifest_file.h"
#include "pipeline/lightmaps/target_facts.h"
#include "pipeline/scene/scene_survey.h"

#include <algorithm>
#include <optional>
#include <set>
#include <utility>

#include <spdlog/fmt/ranges.h>

namespace rnmbake {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// A lightmap that an earlier manifest lists and this run does not replace.
struct Candidate {
  json entry;
  std::string key, object_key;
};

const SceneObject* find_object(const SceneSurvey& survey, const std::string& key) {
  const auto found = std::ranges::find(survey.objects, key, &SceneObject::key);
  return found == survey.objects.end() ? nullptr : &*found;
}

const std::vector<Vec2>* find_layer(const Mesh& mesh, const std::string& name) {
  const auto found = std::ranges::find(mesh.uv_layers, name, &UvLayer::name);
  return found == mesh.uv_layers.end() ? nullptr : &found->uv;
}

/// Entries of the manifest that describe a whole run; kept for each earlier lightmap, since the new run has
/// others.
json facts_of_run(const json& manifest) {
  json facts;
  for (const char* name :
       {"rnmbake", "blender", "engine", "recipe", "materials", "bounces", "model", "faults", "error"}) {
    if (manifest.contains(name)) facts[name] = manifest[name];
  }
  facts["footprint"] = manifest.at("conventions").at("footprint");
  return facts;
}

std::string names_in(const json& bases) {
  std::vector<std::string> names;
  for (const json& basis : bases) names.push_back(basis.at("name").get<std::string>());
  return fmt::format("{}", fmt::join(names, ","));
}

class Search {
 public:
  Search(BlenderSession& session, const RunKind& run, const SceneSurvey& survey,
         const std::vector<Target>& targets)
      : session_(session),
        run_(run),
        survey_(survey),
        file_(session.settings().output.dir / "manifest.json") {
    for (const Target& target : targets) {
      keys_.insert(target.key);
      objects_.insert(survey.objects[target.object].key);
    }
  }

  EarlierLightmaps find() {
    if (!fs::is_regular_file(file_)) return {};
    try {
      manifest_ = json_or_null(read_text(file_));
      return keep(candidates());
    } catch (const json::exception&) {
      log::warn("{}: is no manifest of rnmbake; the lightmaps that it may have listed are not in the new one",
                file_.string());
      return {};
    }
  }

 private:
  void drop(const std::string& key, const std::string& why) const {
    log::warn("{}: its earlier lightmap is left out of {}: {}", key, file_.string(), why);
  }

  [[nodiscard]] fs::path beside(const std::string& name) const { return file_.parent_path() / name; }

  [[nodiscard]] std::vector<Candidate> candidates() const {
    std::vector<Candidate> found;
    for (const json& entry : manifest_.at("objects")) {
      Candidate candidate{entry, entry.at("key").get<std::string>(), object_key_of(entry)};
      if (entry.at("status") != "baked" || keys_.contains(candidate.key)) continue;
      if (objects_.contains(candidate.object_key)) {
        drop(candidate.key, fmt::format("'{}' is split in another way now", candidate.object_key));
      } else if (const auto gone = missing_file(entry)) {
        drop(candidate.key, fmt::format("{} is gone", *gone));
      } else {
        found.push_back(std::move(candidate));
      }
    }
    return found;
  }

  [[nodiscard]] std::optional<std::string> missing_file(const json& entry) const {
    for (const json& file : entry.at("files")) {
      const auto name = file.get<std::string>();
      const auto inside = file_inside(file_.parent_path(), name);
      if (!inside || !fs::is_regular_file(*inside)) return name;
    }
    return std::nullopt;
  }

  EarlierLightmaps keep(const std::vector<Candidate>& candidates) {
    EarlierLightmaps earlier;
    if (candidates.empty()) return earlier;
    refuse_conflicts(candidates);
    const auto saved = manifest_.at("scene_with_uvs").get<std::string>();
    const auto inside = file_inside(file_.parent_path(), saved);
    if (inside && fs::is_regular_file(*inside)) earlier.scene_with_uvs = saved;
    const json facts = facts_of_run(manifest_);
    for (const Candidate& candidate : candidates) {
      EarlierLightmap one{0, candidate.entry, nullptr};
      if (const std::string why = misfit(candidate, earlier.scene_with_uvs, one); !why.empty()) {
        drop(candidate.key, why);
        continue;
      }
      if (!one.entry.contains("earlier")) one.entry["earlier"] = facts;
      earlier.kept.push_back(std::move(one));
    }
    if (!earlier.kept.empty())
      log::info("{} of earlier runs: kept in {}", counted(earlier.kept.size(), "lightmap"), file_.string());
    return earlier;
  }

  void refuse_conflicts(const std::vector<Candidate>& candidates) const {
    const auto differ = [&](const char* what, const json& there, const json& now) {
      if (there == now) return;
      const bool numbers = there.is_array();  // of bases: nobody reads vectors in a message
      fail(ExitCode::usage,
           "{} lists {} lightmaps of other objects ('{}', ...) with another {}: {} there, {} now, and one "
           "folder "
           "holds one kind; pass another -o, or delete that manifest to start anew",
           file_.string(), candidates.size(), candidates.front().key, what,
           numbers ? names_in(there) : brief(there), numbers ? names_in(now) : brief(now));
    };
    differ("schema_version", manifest_.at("schema_version"), manifest_schema_version);
    differ("scene", manifest_.at("scene"), session_.settings().scene.file.filename().string());
    differ("kind", manifest_.at("kind"), run_.kind);
    differ("normalisation", manifest_.at("conventions").at("normalize"),
           name_of(session_.settings().output.normalize));
    differ("list of bases", manifest_.at("bases"), to_json(run_.bases));
  }

  /// Reason why a lightmap no longer belongs to the scene; "" where it does. Fills `one` then.
  std::string misfit(const Candidate& candidate, const std::string& saved, EarlierLightmap& one) {
    const SceneObject* object = find_object(survey_, candidate.object_key);
    if (object == nullptr) return "the scene has no such object any more";
    const Mesh& mesh = survey_.mesh_of(*object);
    if (candidate.entry.at("mesh_hash") != mesh_hash(mesh))
      return "its faces are others since it was baked; bake it again";
    one.object = static_cast<std::size_t>(object - survey_.objects.data());
    const auto layer = candidate.entry.at("uv_layer").get<std::string>();
    const auto& hash = candidate.entry.at("uv_hash");
    if (!candidate.entry.at("unwrapped").get<bool>()) {
      const std::vector<Vec2>* uv = find_layer(mesh, layer);
      return uv != nullptr && hash == uv_hash(*uv) ? ""
                                                   : "its UVs are others since it was baked; bake it again";
    }
    if (candidate.entry.at("object_in_scene").get<std::string>().empty())
      return "";  // the user kept the UVs, or nobody did
    if (saved.empty())
      return fmt::format("its UVs were in {}, which is gone", brief(manifest_.at("scene_with_uvs")));
    const SceneSurvey& there = saved_survey(saved);
    const SceneObject* holder = find_object(there, candidate.object_key);
    const std::vector<Vec2>* uv = holder == nullptr ? nullptr : find_layer(there.mesh_of(*holder), layer);
    if (uv == nullptr || hash != uv_hash(*uv)) return fmt::format("its UVs are no longer in {}", saved);
    one.uv = shared(*uv);
    return "";
  }

  /// The scene that the earlier run saved, read once.
  const SceneSurvey& saved_survey(const std::string& name) {
    if (!saved_) {
      log::info("reading the UVs of earlier lightmaps from {}", beside(name).string());
      saved_ = survey_file(session_, beside(name));
    }
    return *saved_;
  }

  /// The same pointer for the same UVs, so that objects that share a mesh go on sharing it.
  Uvs shared(const std::vector<Vec2>& uv) {
    Uvs& known = by_hash_[uv_hash(uv)];
    if (!known) known = std::make_shared<const std::vector<Vec2>>(uv);
    return known;
  }

  BlenderSession& session_;
  const RunKind& run_;
  const SceneSurvey& survey_;
  fs::path file_;
  std::set<std::string> keys_, objects_;  // of this run
  json manifest_;
  std::optional<SceneSurvey> saved_;
  std::map<std::string, Uvs> by_hash_;
};

/// "floor" of floor.exr, and of floor.flat.exr, floor.rnm0.exr and so on.
std::string stem_of(const json& files) {
  std::string stem = fs::path(files.at(0).get<std::string>()).stem().string();
  return files.size() > 1 ? fs::path(stem).stem().string() : stem;
}

}  // namespace

std::vector<std::string> EarlierLightmaps::stems() const {
  std::vector<std::string> all;
  for (const EarlierLightmap& one : kept) all.push_back(stem_of(one.entry.at("files")));
  return all;
}

std::vector<SavedUvs> EarlierLightmaps::add_to(std::vector<SavedUvs> of_targets) const {
  std::set<std::size_t> done;  // parts of one object share their UVs
  for (const EarlierLightmap& one : kept) {
    const bool nowhere = one.entry.at("unwrapped").get<bool>() && one.uv == nullptr;
    if (!nowhere && done.insert(one.object).second)
      of_targets.push_back({one.object, one.entry.at("uv_layer").get<std::string>(), one.uv});
  }
  return of_targets;
}

EarlierLightmaps find_earlier(BlenderSession& session, const RunKind& run, const SceneSurvey& survey,
                              const std::vector<Target>& targets) {
  return Search(session, run, survey, targets).find();
}

}  // namespace rnmbake
