#include "cli/farm/merge_arguments.h"

#include "cli/flags/command_line.h"
#include "config/settings.h"

#include <spdlog/fmt/ranges.h>

namespace rnmbake {
namespace {

void add_flag(std::vector<std::string>& arguments, const SettingOverride& one) {
  const std::string flag = one.setting->flag();
  if (const auto* on = std::get_if<bool>(&one.value)) {
    arguments.push_back(*on ? flag : "--no-" + flag.substr(2));
    return;
  }
  arguments.push_back(flag);
  if (const auto* list = std::get_if<std::vector<std::string>>(&one.value))
    arguments.push_back(fmt::format("{}", fmt::join(*list, ",")));
  else if (const auto* text = std::get_if<std::string>(&one.value))
    arguments.push_back(*text);
  else if (const auto* whole = std::get_if<std::int64_t>(&one.value))
    arguments.push_back(fmt::format("{}", *whole));
  else
    arguments.push_back(fmt::format("{}", std::get<double>(one.value)));
}

}  // namespace

std::vector<std::string> merge_arguments(const ResolvedConfig& config, const std::string& scene_argument) {
  std::vector<std::string> arguments;
  if (!scene_argument.empty()) arguments.push_back(scene_argument);
  for (const SettingOverride& one : config.values()) {
    const bool is_argument = one.setting->key == "file" && !scene_argument.empty();
    const bool is_typed = one.source == SettingSource::flag || one.source == SettingSource::environment;
    if (is_typed && !is_argument) add_flag(arguments, one);
  }
  return arguments;
}

std::string merge_command(const FarmPlan& plan, const std::string& program) {
  std::string line = shell_word(program) + " bake";
  for (const std::string& word : plan.merge) line += " " + shell_word(word);
  return line + " --merge " + shell_word(plan.folder.string());
}

}  // namespace rnmbake
