#include "scene/lighting.h"

#include <algorithm>
#include <array>

namespace rnmbake {
namespace {

bool is_black(const std::array<double, 3>& color) {
  return color[0] == 0 && color[1] == 0 && color[2] == 0;
}

bool contains(const std::vector<std::string>& words, const char* word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

/// A node tree may give light whatever energy and colour say.
bool may_shine(const LightInfo& light) {
  if (contains(light.outside_model, "portal")) return false;
  return contains(light.outside_model, "node tree") || (light.energy != 0 && !is_black(light.color));
}

bool may_shine(const MaterialInfo& material) {
  return material.emissive || contains(material.outside_model, "volume") ||
         contains(material.outside_model, "script node");
}

bool sky_may_shine(const SceneSurvey& survey) {
  if (survey.world == "none") return false;
  if (survey.world == "nodes") return true;
  return survey.world_strength != 0 && !is_black(survey.world_color);
}

}  // namespace

bool may_be_lit(const SceneSurvey& survey) {
  const auto shines = [](const auto& light) { return may_shine(light); };
  return sky_may_shine(survey) || std::any_of(survey.lights.begin(), survey.lights.end(), shines) ||
         std::any_of(survey.materials.begin(), survey.materials.end(),
                     [](const auto& entry) { return may_shine(entry.second); });
}

}  // namespace rnmbake
