#include "cli/settings_flags.h"

#include "base/error.h"
#include "config/document.h"
#include "config/value.h"

#include <iostream>
#include <string>

#include <CLI/CLI.hpp>

namespace rnmbake {

namespace {

std::string value_name(SettingKind kind) {
  switch (kind) {
    case SettingKind::boolean:
      return "";
    case SettingKind::integer:
      return "N";
    case SettingKind::real:
      return "X";
    case SettingKind::text:
      return "NAME";
    case SettingKind::text_list:
      return "A,B,...";
    case SettingKind::choice:
      return "CHOICE";
    case SettingKind::path:
      return "PATH";
    case SettingKind::program:
      break;
  }
  return "PROGRAM";
}

std::string group_of(const Setting& setting) {
  for (const SettingTable& table : setting_tables()) {
    if (table.name == setting.table) return fmt::format("{} [{}]", table.help, table.name);
  }
  return "Options";
}

std::string joined(const std::vector<std::string>& parts) {
  return fmt::format("{}", fmt::join(parts, ","));
}

}  // namespace

SettingsFlags::SettingsFlags(CLI::App& command) {
  std::string help = "scene (.blend, .glb, .gltf) or project file (.toml)";
  scene_ = command.add_option("SCENE", help);
  for (const Setting& setting : settings()) add(command, setting);
  print_config_ =
      command.add_flag("--print-config", "show every setting with where its value comes from, and end");
  print_reference_ =
      command.add_flag("--print-settings-doc", "the tables of docs/project-file.md")->group("");
}

void SettingsFlags::add(CLI::App& command, const Setting& setting) {
  std::string help = help_text(setting);
  CLI::Option* option = setting.kind == SettingKind::boolean ? command.add_flag(setting.flag_names(), help)
                                                             : command.add_option(setting.flag_names(), help);
  const bool is_list = setting.kind == SettingKind::text_list;
  option->type_name(value_name(setting.kind))->group(group_of(setting));
  option->multi_option_policy(is_list ? CLI::MultiOptionPolicy::TakeAll : CLI::MultiOptionPolicy::TakeLast);
  options_.emplace_back(&setting, option);
}

std::vector<Given> SettingsFlags::given_flags() const {
  std::vector<Given> flags;
  for (const auto& [setting, option] : options_) {
    if (option->count() == 0) continue;
    const bool is_list = setting->kind == SettingKind::text_list;
    const std::string text = is_list ? joined(option->results()) : option->results().back();
    const std::string where = "flag " + setting->flag();
    Given one{setting, parse_value(*setting, text, where), SettingSource::flag, where};
    flags.push_back(std::move(one));
  }
  return flags;
}

std::optional<ResolvedConfig> SettingsFlags::resolve(std::ostream& out) const {
  if (print_reference_->count() > 0) {
    out << settings_reference();
    return std::nullopt;
  }
  std::vector<Given> flags = given_flags();
  ProjectFile project;
  if (scene_->count() > 0) {
    const std::string scene = scene_->results().back();
    if (is_project_path(scene)) {
      project = read_project(scene);
    } else {
      const Setting* file = find_setting("file");
      for (const Given& flag : flags) {
        if (flag.setting == file)
          fail(ExitCode::usage, "{} and --file both name a scene; give one of them", scene);
      }
      Given one{file, scene, SettingSource::flag, "argument SCENE"};
      flags.push_back(std::move(one));
    }
  }
  ResolvedConfig config = rnmbake::resolve(project, read_environment(process_environment()), flags);
  if (print_config_->count() > 0) {
    out << print_config(config);
    return std::nullopt;
  }
  require_scene(config);
  return config;
}

std::optional<ResolvedConfig> SettingsFlags::resolve() const {
  return resolve(std::cout);
}

}  // namespace rnmbake
