// config/recipe_names.h - recipes and reference models as text: in settings, manifests, headers, folders,
// reports.
#pragma once

#include "config/bake_settings.h"

namespace rnmbake {

inline constexpr const char* flat_normal_map_name =
    "flat-normal-map";  // the published recipe, baked or traced

[[nodiscard]] constexpr const char* name_of(BakingSettings::Recipe recipe) {
  return recipe == BakingSettings::Recipe::receiver ? "receiver" : flat_normal_map_name;
}

[[nodiscard]] constexpr const char* name_of(ReferenceSettings::Model model) {
  return model == ReferenceSettings::Model::truth ? "true" : flat_normal_map_name;
}

}  // namespace rnmbake
