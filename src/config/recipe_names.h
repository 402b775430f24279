// config/recipe_names.h - engines, recipes, reference models and sets of directions as text: in settings,
// manifests, headers, folders, reports.
#pragma once

#include "config/bake_settings.h"

#include <array>
#include <cstddef>

namespace rnmbake {

inline constexpr const char* flat_normal_map_name =
    "flat-normal-map";                                // the published recipe, baked or traced
inline constexpr const char* traced_name = "traced";  // as a recipe: a bake by the tracer

/// In the order of BakingSettings::Recipe.
inline constexpr std::array recipe_names{"auto", "receiver", "gather", flat_normal_map_name};

[[nodiscard]] constexpr const char* name_of(BakingSettings::Recipe recipe) {
  return recipe_names[static_cast<std::size_t>(recipe)];
}

[[nodiscard]] constexpr const char* name_of(BakingSettings::Engine engine) {
  return engine == BakingSettings::Engine::cycles ? "cycles" : "embree";
}

[[nodiscard]] constexpr const char* name_of(ReferenceSettings::Model model) {
  return model == ReferenceSettings::Model::truth ? "true" : flat_normal_map_name;
}

/// In the order of BakingSettings::DirectionSet.
inline constexpr std::array direction_set_names{"rnm", "l1", "h6", "sg", "sh3", "study"};

[[nodiscard]] constexpr const char* name_of(BakingSettings::DirectionSet set) {
  return direction_set_names[static_cast<std::size_t>(set)];
}

}  // namespace rnmbake
