// pipeline/local/local_targets.h - bake --assume-local: lightmaps that stay as they are because nothing near
// their object changed.
#pragma once

#include "pipeline/lightmaps/earlier_lightmaps.h"
#include "pipeline/lightmaps/last_run.h"
#include "pipeline/scene/make_targets.h"
#include "scene/survey.h"

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace rnmbake {

/// What is baked, and what stays in the manifest.
struct LocalTargets {
  TargetList list;
  EarlierLightmaps earlier;
  std::size_t assumed = 0;  // of `earlier`: assumed to be as they were
};

/// find_earlier() for targets that are to be baked.
using FindEarlier = std::function<EarlierLightmaps(const std::vector<Target>&)>;

class LocalRule {
 public:
  /// `metres`: how far from a change a lightmap is baked again, scene units; none: wherever it is.
  LocalRule(std::optional<double> metres, const LastRun& last, std::filesystem::path dir)
      : metres_(metres), last_(last), dir_(std::move(dir)) {}

  /// Takes out of the targets whose lightmaps may stay. Says why none may, where that is so: other settings,
  /// no record of the last scene, a change that may light everything.
  [[nodiscard]] LocalTargets choose(const SceneSurvey& survey, const TargetList& all,
                                    const FindEarlier& find) const;

  /// The same without looking whether the manifest will hold them: for a plan.
  [[nodiscard]] TargetList preview(const SceneSurvey& survey, const TargetList& all) const;

 private:
  struct Assumption {
    std::set<std::string> keys;  // of targets that may stay
    bool has_changes = false;    // in the scene, somewhere else
  };
  [[nodiscard]] Assumption assume(const SceneSurvey& survey, const TargetList& all) const;

  std::optional<double> metres_;
  const LastRun& last_;
  std::filesystem::path dir_;
};

/// Writes the manifest anew where no target is left to be baked: with these lightmaps alone.
void keep_all(const std::filesystem::path& dir, const SceneSurvey& survey, const EarlierLightmaps& earlier);

}  // namespace rnmbake
