#include "cli/flags/command_line.h"

#include <spdlog/fmt/fmt.h>
#include <spdlog/fmt/ranges.h>

namespace rnmbake {
namespace {

std::string text_of(const SettingValue& value) {
  if (const auto* list = std::get_if<std::vector<std::string>>(&value))
    return fmt::format("{}", fmt::join(*list, ","));
  if (const auto* text = std::get_if<std::string>(&value)) return *text;
  if (const auto* whole = std::get_if<std::int64_t>(&value)) return fmt::format("{}", *whole);
  return fmt::format("{}", std::get<double>(value));
}

/// Whether the user gave the setting by its flag or variable; a setting that another one turned off has the
/// other's flag as its origin.
bool was_typed(const SettingOverride& given) {
  if (given.source == SettingSource::environment) return true;
  return given.source == SettingSource::flag &&
         given.where.find(given.setting->flag().substr(2)) != std::string::npos;
}

}  // namespace

std::string project_of(const ResolvedConfig& config) {
  for (const SettingOverride& given : config.values()) {
    if (given.source == SettingSource::project) return given.where.substr(0, given.where.rfind(':'));
  }
  return "";
}

std::string shell_word(const std::string& word) {
  const bool harmless = !word.empty() && word.find_first_not_of(
                                             "abcdefghijklmnopqrstuvwxyz"
                                             "ABCDEFGHIJKLMNOPQRSTUVWXYZ"
                                             "0123456789_-./=,%:+@") == std::string::npos;
  if (harmless) return word;
  std::string out = "'";
  for (const char c : word) out += c == '\'' ? "'\\''" : std::string(1, c);
  return out + "'";
}

std::vector<std::string> flag_words(const SettingOverride& given) {
  const std::string flag = given.setting->flag();
  if (const auto* on = std::get_if<bool>(&given.value)) return {*on ? flag : "--no-" + flag.substr(2)};
  return {flag, text_of(given.value)};
}

std::string command_line(const std::string& command, const ResolvedConfig& config) {
  const std::string project = project_of(config);
  std::string line = fmt::format("rnmbake {} {}", command,
                                 shell_word(project.empty() ? config.globals.scene.file.string() : project));
  for (const SettingOverride& given : config.values()) {
    const bool is_scene = given.setting->key == "file" && project.empty();
    if (!was_typed(given) || is_scene) continue;
    for (const std::string& word : flag_words(given)) line += " " + shell_word(word);
  }
  return line;
}

}  // namespace rnmbake
