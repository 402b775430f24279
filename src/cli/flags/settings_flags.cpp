#include "cli/flags/settings_flags.h"

#include "base/error.h"
#include "config/document.h"
#include "config/value.h"

#include <filesystem>
#include <iostream>
#include <set>
#include <string>

#include <CLI/CLI.hpp>
#include <spdlog/fmt/ranges.h>

namespace rnmbake {

namespace {

constexpr const char* epilogue =
    "Each setting may also stand in a project file (docs/project-file.md) under its table, with _ for -, or "
    "in\n"
    "the environment as RNMBAKE_ and its key in capitals. A flag wins over the environment, that over the\n"
    "project file, that over the default. Lists take commas or the flag several times; in a name that holds\n"
    "a comma write ? for it.\n"
    "\n"
    "Examples:\n"
    "  rnmbake {0} hall.blend --output lightmaps\n"
    "  rnmbake {0} hall.blend -o lightmaps --objects 'floor*,wall*' --resolution 512\n"
    "  rnmbake {0} hall.blend -o lightmaps --texels-per-unit 32 --max-resolution 1024\n"
    "  rnmbake {0} hall.toml --samples 64           a project file, with one setting changed\n"
    "  rnmbake {0} hall.toml --print-config         what would hold, and who says so";

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
    case SettingKind::path_list:
      return "DIR,DIR,...";
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

SettingsFlags::SettingsFlags(CLI::App& command, Purpose purpose, std::span<const char* const> only)
    : purpose_(purpose) {
  if (only.empty()) command.footer(fmt::format(epilogue, command.get_name()));
  const std::string help = fmt::format("scene (.blend, .glb, .gltf{}) or project file (.toml)",
                                       purpose == Purpose::reference ? ", .rnmscene" : "");
  scene_ = command.add_option("SCENE", help);
  for (const Setting& setting : settings()) {
    if (only.empty() && setting.serves(purpose)) add(command, setting, group_of(setting));
  }
  for (const char* key : only) add(command, *find_setting(key), "Settings");
  print_config_ = command.add_flag("--print-config");
  print_config_->description("show every setting with where its value comes from, and end");
  print_reference_ = command.add_flag("--print-settings-doc")->group("");  // for docs/project-file.md
}

void SettingsFlags::add(CLI::App& command, const Setting& setting, const std::string& group) {
  const std::string help = help_text(setting);
  CLI::Option* option = setting.kind == SettingKind::boolean ? command.add_flag(setting.flag_names(), help)
                                                             : command.add_option(setting.flag_names(), help);
  const bool is_list = setting.is_list();
  option->type_name(value_name(setting.kind))->group(group);
  option->multi_option_policy(is_list ? CLI::MultiOptionPolicy::TakeAll : CLI::MultiOptionPolicy::TakeLast);
  options_.emplace_back(&setting, option);
}

std::vector<SettingOverride> SettingsFlags::given_flags() const {
  std::vector<SettingOverride> flags;
  for (const auto& [setting, option] : options_) {
    if (option->count() == 0) continue;
    const bool is_list = setting->is_list();
    const std::string text = is_list ? joined(option->results()) : option->results().back();
    std::string where = "flag " + setting->flag();
    SettingValue value = parse_value(*setting, text, where);
    if (value == SettingValue(false)) where = "flag --no-" + setting->flag().substr(2);
    SettingOverride one{setting, std::move(value), SettingSource::flag, std::move(where)};
    flags.push_back(std::move(one));
  }
  return flags;
}

std::optional<ResolvedConfig> SettingsFlags::resolve(std::ostream& out) const {
  return resolve(scene_->count() > 0 ? scene_->results().back() : "", out);
}

void SettingsFlags::take_several_scenes(CLI::App& command) {
  const std::string help = scene_->get_description();
  command.remove_option(scene_);  // one that takes a single word cannot be told to take more
  scene_ = command.add_option("SCENE", scenes_, help)->type_name("");
}

std::vector<ResolvedConfig> SettingsFlags::resolve_all() const {
  const std::vector<std::string> scenes =
      scene_->count() > 0 ? scene_->results() : std::vector<std::string>{""};
  std::vector<ResolvedConfig> all;
  std::set<std::string> names;
  for (const std::string& scene : scenes) {
    auto config = resolve(scene, std::cout);
    if (!config) return {};
    const std::string name = std::filesystem::path(scene).stem().string();
    if (scenes.size() > 1) {
      if (!names.insert(name).second)
        fail(ExitCode::usage,
             "two of the scenes are called '{}' and would write into one folder; bake one after the other, "
             "each "
             "with an --output of its own",
             name);
      if (!config->globals.output.dir.empty()) config->globals.output.dir /= name;
    }
    all.push_back(std::move(*config));
  }
  return all;
}

std::optional<ResolvedConfig> SettingsFlags::resolve(const std::string& scene, std::ostream& out) const {
  if (print_reference_->count() > 0) {
    out << settings_reference();
    return std::nullopt;
  }
  std::vector<SettingOverride> flags = given_flags();
  ProjectFile project;
  if (!scene.empty()) {
    if (is_project_path(scene)) {
      project = read_project(scene);
    } else {
      const Setting* file = find_setting("file");
      for (const SettingOverride& flag : flags) {
        if (flag.setting == file)
          fail(ExitCode::usage, "{} and --file both name a scene; give one of them", scene);
      }
      SettingOverride one{file, scene, SettingSource::flag, "argument SCENE"};
      flags.push_back(std::move(one));
    }
  }
  ResolvedConfig config = rnmbake::resolve(project, read_environment(process_environment()), flags);
  if (print_config_->count() > 0) {
    out << print_config(config, purpose_);
    return std::nullopt;
  }
  require_scene(config, purpose_);
  return config;
}

std::optional<ResolvedConfig> SettingsFlags::resolve() const {
  return resolve(std::cout);
}

std::string SettingsFlags::scene_argument() const {
  return scene_->count() > 0 ? scene_->results().back() : std::string();
}

}  // namespace rnmbake
