// config/given.h - one value that somebody set, and where.
#pragma once

#include "config/settings.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace rnmbake {

/// In order of precedence: a later source wins over an earlier one.
enum class SettingSource { fallback, project, environment, flag };

struct SettingOverride {
  const Setting* setting = nullptr;
  SettingValue value;
  SettingSource source = SettingSource::fallback;
  std::string where;       // "flag --samples", "RNMBAKE_SAMPLES", "project.toml:12", "default"
  bool is_shared = false;  // by several scenes of a project: a pattern need not match in all of them
};

/// One [[override]]: values for the objects whose name or key matches one of the patterns.
struct ObjectOverride {
  std::vector<std::string> objects;
  std::string where;  // "project.toml:20"
  std::vector<SettingOverride> values;
  bool is_shared = false;  // as above
};

/// SurfaceMaterials a variable up; nullopt where it is not set.
using EnvironmentLookup = std::function<std::optional<std::string>(const std::string& name)>;
[[nodiscard]] EnvironmentLookup process_environment();

/// RNMBAKE_* of every setting; empty ones count as not set. Throws Error(usage) naming the variable.
[[nodiscard]] std::vector<SettingOverride> read_environment(const EnvironmentLookup& environment);

}  // namespace rnmbake
