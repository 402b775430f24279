#include "cli/flags/settings_flags.h"

#include "base/error.h"
#include "base/object_notes.h"
#include "config/document.h"
#include "config/value.h"

#include <algorithm>
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

namespace fs = std::filesystem;

/// Whether a flag means the scene of a project: by its path, or its name alone.
bool is_same(const fs::path& wanted, const fs::path& scene) {
  return fs::absolute(wanted).lexically_normal() == fs::absolute(scene).lexically_normal() ||
         wanted == scene.filename();
}

std::string files_in(const ProjectFile& project) {
  std::vector<std::string> names;
  for (const ProjectScene& scene : project.scenes) names.push_back(scene.file.filename().string());
  return first_names(names, 8);
}

/// Of a project that lists its scenes: whether the output folder is not that scene's own.
bool is_in_shared_folder(const ProjectFile& project, const ResolvedConfig& config) {
  if (project.scenes.empty()) return false;
  const std::string& where = config.provenance("dir");
  return std::ranges::none_of(project.scenes.front().values, [&](const SettingOverride& one) {
    return one.setting->key == "dir" && one.where == where;
  });
}

std::string joined(const std::vector<std::string>& parts) {
  return fmt::format("{}", fmt::join(parts, ","));
}

}  // namespace

SettingsFlags::SettingsFlags(CLI::App& command, Purpose purpose, std::span<const char* const> only,
                             std::span<const char* const> without)
    : purpose_(purpose) {
  if (only.empty()) command.footer(fmt::format(epilogue, command.get_name()));
  const std::string help = fmt::format("scene (.blend, .glb, .gltf{}) or project file (.toml)",
                                       purpose == Purpose::reference ? ", .rnmscene" : "");
  scene_ = command.add_option("SCENE", help);
  for (const Setting& setting : settings()) {
    const bool left_out = std::ranges::any_of(without, [&](const char* key) { return setting.key == key; });
    if (only.empty() && setting.serves(purpose) && !left_out) add(command, setting, group_of(setting));
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
  flags.insert(flags.end(), wanted_.begin(), wanted_.end());
  return flags;
}

void SettingsFlags::take_several_scenes(CLI::App& command) {
  const std::string help = scene_->get_description();
  command.remove_option(scene_);  // one that takes a single word cannot be told to take more
  scene_ = command.add_option("SCENE", scenes_, help)->type_name("");
}

std::vector<ProjectFile> SettingsFlags::projects_of(const std::string& argument) const {
  if (argument.empty() || !is_project_path(argument)) return {{}};
  const ProjectFile project = read_project(argument);
  if (project.scenes.empty()) return {project};
  std::vector<SettingOverride> given = read_environment(process_environment());
  for (SettingOverride& flag : given_flags()) given.push_back(std::move(flag));
  fs::path wanted;
  for (const SettingOverride& one : given) {
    if (one.setting->key == "file") wanted = std::get<std::string>(one.value);
  }
  std::vector<ProjectFile> chosen;
  for (const ProjectScene& scene : project.scenes) {
    if (wanted.empty() || is_same(wanted, scene.file)) chosen.push_back(project.of_scene(scene));
  }
  if (chosen.empty())
    fail(ExitCode::usage, "{} lists no scene '{}'; there are {}", argument, wanted.string(),
         files_in(project));
  return chosen;
}

std::vector<ResolvedConfig> SettingsFlags::resolve_all() const {
  const std::vector<std::string> arguments =
      scene_->count() > 0 ? scene_->results() : std::vector<std::string>{""};
  std::vector<ResolvedConfig> all;
  std::set<fs::path> folders;
  for (const std::string& argument : arguments) {
    for (const ProjectFile& project : projects_of(argument)) {
      auto config = resolve(project, argument, std::cout);
      if (!config) continue;
      fs::path& dir = config->globals.output.dir;
      if (!dir.empty() && arguments.size() > 1) dir /= fs::path(argument).stem();
      if (!dir.empty() && is_in_shared_folder(project, *config)) dir /= config->globals.scene.file.stem();
      if (!dir.empty() && !folders.insert(fs::absolute(dir).lexically_normal()).second)
        fail(ExitCode::usage,
             "two of the scenes would write into {}, {} and another; bake one after the other, each with an "
             "--output of its own, or give one of a project's [[scenes]] a dir of its own",
             dir.string(), config->globals.scene.file.string());
      all.push_back(std::move(*config));
    }
  }
  if (all.size() == 1) require_scene(all.front(), purpose_);
  return all;
}

std::optional<ResolvedConfig> SettingsFlags::resolve(std::ostream& out) const {
  const std::string argument = scene_argument();
  const std::vector<ProjectFile> projects = projects_of(argument);
  if (projects.size() > 1)
    fail(ExitCode::usage, "{} lists {} scenes, and this command takes one; pick it with --file: {}", argument,
         projects.size(), files_in(read_project(argument)));
  auto config = resolve(projects.front(), argument, out);
  if (config && !config->globals.output.dir.empty() && is_in_shared_folder(projects.front(), *config))
    config->globals.output.dir /= config->globals.scene.file.stem();
  if (config) require_scene(*config, purpose_);
  return config;
}

std::optional<ResolvedConfig> SettingsFlags::resolve(const ProjectFile& project, const std::string& argument,
                                                     std::ostream& out) const {
  if (print_reference_->count() > 0) {
    out << settings_reference();
    return std::nullopt;
  }
  const Setting* file = find_setting("file");
  std::vector<SettingOverride> flags = given_flags();
  std::vector<SettingOverride> environment = read_environment(process_environment());
  const auto is_file = [&](const SettingOverride& one) { return one.setting == file; };
  if (!project.scenes.empty()) {
    const bool is_chosen = std::erase_if(flags, is_file) + std::erase_if(environment, is_file) > 0;
    SettingOverride one{file, project.scenes.front().file.string(), SettingSource::flag, "flag --file"};
    if (is_chosen) flags.push_back(std::move(one));
  } else if (!argument.empty() && !is_project_path(argument)) {
    if (std::ranges::any_of(flags, is_file))
      fail(ExitCode::usage, "{} and --file both name a scene; give one of them", argument);
    SettingOverride one{file, argument, SettingSource::flag, "argument SCENE"};
    flags.push_back(std::move(one));
  }
  ResolvedConfig config = rnmbake::resolve(project, environment, flags);
  if (print_config_->count() > 0) {
    if (!project.scenes.empty()) out << fmt::format("# {}\n", config.globals.scene.file.string());
    out << print_config(config, purpose_);
    return std::nullopt;
  }
  return config;
}

std::optional<ResolvedConfig> SettingsFlags::resolve_scene(const fs::path& scene) const {
  auto config = resolve({}, scene.string(), std::cout);
  if (config) require_scene(*config, purpose_);
  return config;
}

std::optional<ResolvedConfig> SettingsFlags::resolve() const {
  return resolve(std::cout);
}

std::string SettingsFlags::scene_argument() const {
  return scene_->count() > 0 ? scene_->results().back() : std::string();
}

}  // namespace rnmbake
