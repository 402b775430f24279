// config/resolve.h - flag over environment over project file over default, object by object.
#pragma once

#include "config/given.h"
#include "config/project_file.h"

#include <string>
#include <string_view>
#include <vector>

namespace rnmbake {

class ResolvedConfig {
 public:
  BakeSettings globals;                // globals.object: what holds where no override matches
  std::filesystem::path project_file;  // "": none

  /// `key` is the object's unique key in the survey; patterns may match it or the name. Overrides apply in
  /// the file's order, so the last one that matches wins. A flag or an environment variable wins over all
  /// overrides: who types --samples 16 wants 16 everywhere. An override that sets resolution and leaves
  /// texels_per_unit alone turns the latter off for its objects.
  /// Throws Error(usage) where the object's limits of resolution contradict each other.
  [[nodiscard]] ObjectSettings for_object(std::string_view name, std::string_view key) const;

  /// Whether [scene] objects and exclude pick the object.
  [[nodiscard]] bool selects(std::string_view name, std::string_view key) const;

  /// Every setting in the order of settings(), with its value and where that came from.
  [[nodiscard]] const std::vector<SettingOverride>& values() const { return values_; }
  /// "flag --samples", "RNMBAKE_SAMPLES", "project.toml:12" or "default".
  [[nodiscard]] const std::string& provenance(std::string_view key) const;
  /// Whether the value holds for several scenes of a project.
  [[nodiscard]] bool is_shared(std::string_view key) const;
  [[nodiscard]] const std::vector<ObjectOverride>& overrides() const { return overrides_; }
  /// Whether a flag or an environment variable takes that setting away from the overrides.
  [[nodiscard]] bool fixed_for_all(const Setting& setting) const;

 private:
  friend ResolvedConfig resolve(const ProjectFile&, const std::vector<SettingOverride>&,
                                const std::vector<SettingOverride>&);
  void take(const SettingOverride& given);
  void let_stronger_resolution_win();
  [[nodiscard]] const SettingOverride& given(std::string_view key) const;
  void apply(const ObjectOverride& override_, BakeSettings& settings) const;
  [[nodiscard]] bool sets_samples(std::string_view name, std::string_view key) const;
  void check_open_end() const;
  void check_together() const;

  std::vector<SettingOverride> values_;
  std::vector<ObjectOverride> overrides_;
};

/// Throws Error(usage) where values do not fit together (min_resolution above max_resolution, a basis that
/// does not exist). `project` may be empty.
[[nodiscard]] ResolvedConfig resolve(const ProjectFile& project,
                                     const std::vector<SettingOverride>& environment,
                                     const std::vector<SettingOverride>& flags);

/// The patterns that match none of the names. Give names and keys of all objects.
[[nodiscard]] std::vector<std::string> unmatched(const std::vector<std::string>& patterns,
                                                 const std::vector<std::string>& names);

/// A pattern that fits no object, and who wrote it.
struct UnmatchedPattern {
  std::string pattern, where;
};
/// Over [scene] objects, exclude and every [[override]]. The default "*" is never in the list, nor what is
/// excluded from or overridden in several scenes.
[[nodiscard]] std::vector<UnmatchedPattern> unmatched_patterns(const ResolvedConfig& config,
                                                               const std::vector<std::string>& names);

[[nodiscard]] bool is_project_path(const std::filesystem::path& path);

/// By its ending: .blend, .glb or .gltf; for a reference also .rnmscene.
[[nodiscard]] bool is_scene_path(const std::filesystem::path& path, Purpose purpose);

/// Throws Error(usage) where no scene was named or its ending is not .blend, .glb or .gltf (for a reference
/// and a bake by embree also .rnmscene), and Error(io) where there is no such file.
void require_scene(const ResolvedConfig& config, Purpose purpose = Purpose::bake);

}  // namespace rnmbake
