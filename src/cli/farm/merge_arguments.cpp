#include "cli/farm/merge_arguments.h"

#include "cli/flags/command_line.h"
#include "config/settings.h"

#include <utility>

namespace rnmbake {

std::vector<std::string> merge_arguments(const ResolvedConfig& config, const std::string& scene_argument) {
  std::vector<std::string> arguments;
  if (!scene_argument.empty()) arguments.push_back(scene_argument);
  for (const SettingOverride& one : config.values()) {
    const bool is_argument = one.where == "argument SCENE";
    const bool is_typed = one.source == SettingSource::flag || one.source == SettingSource::environment;
    if (!is_typed || is_argument) continue;
    for (std::string& word : flag_words(one)) arguments.push_back(std::move(word));
  }
  return arguments;
}

std::string merge_command(const FarmPlan& plan, const std::string& program) {
  std::string line = shell_word(program) + " bake";
  for (const std::string& word : plan.merge) line += " " + shell_word(word);
  return line + " --merge " + shell_word(plan.folder.string());
}

}  // namespace rnmbake
