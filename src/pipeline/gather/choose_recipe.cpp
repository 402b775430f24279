#include "pipeline/gather/choose_recipe.h"

#include "base/error.h"
#include "base/log.h"

#include <algorithm>

#include <spdlog/fmt/fmt.h>

namespace rnmbake {

std::vector<std::string> against_gather(const BakeSettings& settings, const SceneSurvey& survey,
                                        const std::vector<ObjectSettings>& objects) {
  std::vector<std::string> reasons = survey.gather.refused;
  const auto any = [&](auto set) { return std::ranges::any_of(objects, set); };
  if (any([](const ObjectSettings& one) { return one.clamp > 0; }))
    reasons.emplace_back("clamp cuts the light of single paths, which mirrors do not weigh; leave it out");
  if (any([](const ObjectSettings& one) { return one.noise > 0; }) || !settings.run.time.empty())
    reasons.emplace_back("noise and time decide while it bakes how long to go on; give samples");
  return reasons;
}

BakingSettings::Recipe choose_recipe(const BakeSettings& settings, const SceneSurvey& survey,
                                     const std::vector<ObjectSettings>& objects) {
  using Recipe = BakingSettings::Recipe;
  const Recipe wanted = settings.bake.recipe;
  if (wanted != Recipe::automatic && wanted != Recipe::gather) return wanted;
  const std::vector<std::string> reasons = against_gather(settings, survey, objects);
  if (reasons.empty()) return Recipe::gather;
  const std::string more = reasons.size() > 1 ? fmt::format(" (and {} more)", reasons.size() - 1) : "";
  if (wanted == Recipe::gather)
    fail(ExitCode::unsupported, "{}{}; or bake with --recipe receiver", reasons.front(), more);
  log::info("recipe receiver, since gather would not be exact: {}{}", reasons.front(), more);
  return Recipe::receiver;
}

}  // namespace rnmbake
