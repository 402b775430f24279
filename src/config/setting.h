// config/setting.h - one setting: its names, its kind, its limits, its field.
#pragma once

#include "config/bake_settings.h"

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace rnmbake {

enum class SettingKind {
  boolean,
  integer,
  real,
  text,
  text_list,
  choice,
  path,       // in a project file: relative to that file; elsewhere: to the working directory
  path_list,  // each as path
  program,    // as path where it holds a slash; otherwise a name to look up in PATH
};

/// A value before it has a place: choices and paths are text.
using SettingValue = std::variant<bool, std::int64_t, double, std::string, std::vector<std::string>>;

/// Leads to a setting's field in BakeSettings; the kind says which of SettingValue's types pass.
struct SettingSlot {
  std::function<SettingValue(const BakeSettings&)> get;
  std::function<void(BakeSettings&, const SettingValue&)> set;
};

/// What a command does with the settings.
enum class Purpose { bake, reference, validate };

struct Setting {
  std::string_view table, key;  // of the project file; keys are unique over all tables
  std::string_view help;        // one line, no full stop
  SettingKind kind = SettingKind::text;
  SettingSlot slot;
  std::int64_t low = 0, high = 0;         // integer, real; both ends belong to the range
  std::vector<std::string_view> choices;  // choice
  std::string_view unit;                  // "texels", "MiB", ...; "" where there is none
  std::string_view empty_means;           // what 0, "" or [] stands for where it has a meaning of its own
  std::string_view no_path;               // path: a word that is none, "" where every text is a path
  bool per_object = false;                // may stand in an [[override]]
  bool has_effect = true;                 // on what comes out; else only on how it is made
  std::vector<Purpose> purposes;          // whose flag it is; none: everybody's

  [[nodiscard]] bool is_list() const {
    return kind == SettingKind::text_list || kind == SettingKind::path_list;
  }
  [[nodiscard]] bool serves(Purpose purpose) const;

  [[nodiscard]] std::string flag() const;         // "--texels-per-unit"
  [[nodiscard]] std::string flag_names() const;   // as CLI11 wants it: "-o,--output", "--repair,!--no-repair"
  [[nodiscard]] std::string environment() const;  // "RNMBAKE_TEXELS_PER_UNIT"
  [[nodiscard]] SettingValue default_value() const;
};

struct SettingTable {
  std::string_view name, help;
};

}  // namespace rnmbake
