// config/setting_row.h - one line of the table of settings; what a field's place and type tell is not said
// again.
#pragma once

#include "config/recipe_names.h"
#include "config/setting.h"

#include <algorithm>
#include <initializer_list>
#include <limits>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace rnmbake {

using Spelling = std::vector<std::string_view>;

// How each choice is written, in the order of its enum.
inline Spelling spelling(ObjectSettings::Unwrap) {
  return {"auto", "never", "always"};
}
inline Spelling spelling(ObjectSettings::Horizon) {
  return {"identity", "clamp"};
}
inline Spelling spelling(ObjectSettings::Split) {
  return {"none", "material", "loose"};
}
inline Spelling spelling(SceneSettings::Materials) {
  return {"full", "lambert"};
}
inline Spelling spelling(BakingSettings::Engine) {
  return {name_of(BakingSettings::Engine::cycles), name_of(BakingSettings::Engine::embree)};
}
inline Spelling spelling(BakingSettings::Recipe) {
  return {recipe_names.begin(), recipe_names.end()};
}
inline Spelling spelling(BakingSettings::DirectionSet) {
  return {direction_set_names.begin(), direction_set_names.end()};
}
inline Spelling spelling(BakingSettings::Dispatch) {
  return {"auto", "basis", "object", "scene"};
}
inline Spelling spelling(BakingSettings::Device) {
  return {"CPU", "CUDA", "OPTIX", "HIP", "METAL", "ONEAPI"};
}
inline Spelling spelling(ReferenceSettings::Footprint) {
  return {"auto", "centre", "half", "full"};
}
inline Spelling spelling(ReferenceSettings::Model) {
  return {name_of(ReferenceSettings::Model::truth), name_of(ReferenceSettings::Model::flat_normal_map)};
}
inline Spelling spelling(OutputSettings::Layout) {
  return {"layers", "files"};
}
inline Spelling spelling(Depth) {
  return {"half", "float"};
}
inline Spelling spelling(Normalize) {
  return {"none", "flat"};
}
inline Spelling spelling(OutputSettings::StandardErrors) {
  return {"auto", "never", "always"};
}
inline Spelling spelling(OutputSettings::SaveScene) {
  return {"auto", "never", "always"};
}

template <typename T>
SettingKind kind_of() {
  if constexpr (std::is_same_v<T, bool>) return SettingKind::boolean;
  if constexpr (std::is_same_v<T, int>) return SettingKind::integer;
  if constexpr (std::is_same_v<T, double>) return SettingKind::real;
  if constexpr (std::is_same_v<T, std::string>) return SettingKind::text;
  if constexpr (std::is_same_v<T, std::vector<std::string>>) return SettingKind::text_list;
  if constexpr (std::is_same_v<T, std::filesystem::path>) return SettingKind::path;
  if constexpr (std::is_same_v<T, std::vector<std::filesystem::path>>) return SettingKind::path_list;
  if constexpr (std::is_enum_v<T>) return SettingKind::choice;
}

template <typename T>
SettingValue to_value(const T& field) {
  if constexpr (std::is_enum_v<T>) {
    return std::string(spelling(field).at(static_cast<std::size_t>(field)));
  } else if constexpr (std::is_same_v<T, int>) {
    return std::int64_t{field};
  } else if constexpr (std::is_same_v<T, std::filesystem::path>) {
    return field.string();
  } else if constexpr (std::is_same_v<T, std::vector<std::filesystem::path>>) {
    return std::vector<std::string>(field.begin(), field.end());
  } else {
    return field;
  }
}

template <typename T>
void from_value(T& field, const SettingValue& value) {
  if constexpr (std::is_enum_v<T>) {
    const Spelling names = spelling(field);
    field =
        static_cast<T>(std::find(names.begin(), names.end(), std::get<std::string>(value)) - names.begin());
  } else if constexpr (std::is_same_v<T, int>) {
    field = static_cast<int>(std::get<std::int64_t>(value));
  } else if constexpr (std::is_same_v<T, std::filesystem::path>) {
    field = std::get<std::string>(value);
  } else if constexpr (std::is_same_v<T, std::vector<std::filesystem::path>>) {
    const auto& texts = std::get<std::vector<std::string>>(value);
    field = T(texts.begin(), texts.end());
  } else {
    field = std::get<T>(value);
  }
}

/// One line of the table. What the field's place and type tell is not said again: kind, choices, per object.
class Row {
 public:
  template <typename Part, typename T>
  Row(std::string_view table, std::string_view key, Part BakeSettings::*part, T Part::*field,
      std::string_view help) {
    setting_.table = table;
    setting_.key = key;
    setting_.help = help;
    setting_.kind = kind_of<T>();
    setting_.per_object = std::is_same_v<Part, ObjectSettings>;
    setting_.slot.get = [=](const BakeSettings& s) { return to_value(s.*part.*field); };
    setting_.slot.set = [=](BakeSettings& s, const SettingValue& v) { from_value(s.*part.*field, v); };
    if constexpr (std::is_enum_v<T>) setting_.choices = spelling(T{});
    if constexpr (std::is_same_v<T, int>) setting_.high = std::numeric_limits<int>::max();
    if constexpr (std::is_same_v<T, double>) setting_.high = 1'000'000'000;
  }

  Row range(std::int64_t low, std::int64_t high) {
    setting_.low = low;
    setting_.high = high;
    return *this;
  }
  Row unit(std::string_view unit) {
    setting_.unit = unit;
    return *this;
  }
  Row empty_means(std::string_view meaning) {
    setting_.empty_means = meaning;
    return *this;
  }
  Row only(std::initializer_list<Purpose> purposes) {
    setting_.purposes = purposes;
    return *this;
  }
  Row no_path(std::string_view word) {
    setting_.no_path = word;
    return *this;
  }
  /// Whatever its value, the same comes out.
  Row without_effect() {
    setting_.has_effect = false;
    return *this;
  }
  Row program() {
    setting_.kind = SettingKind::program;
    return *this;
  }
  operator Setting() const { return setting_; }  // NOLINT(google-explicit-constructor)

 private:
  Setting setting_;
};

}  // namespace rnmbake
