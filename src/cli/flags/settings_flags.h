// cli/flags/settings_flags.h - the settings of config/settings.h as flags of one command.
#pragma once

#include "config/resolve.h"

#include <iosfwd>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace rnmbake {

/// Adds the argument SCENE, a flag for each setting of that purpose (grouped by table) and --print-config.
/// With `only`, keys of settings, just those have flags, in one group; those of `without` have none. Must
/// live as long as `command`.
class SettingsFlags {
 public:
  explicit SettingsFlags(CLI::App& command, Purpose purpose = Purpose::bake,
                         std::span<const char* const> only = {}, std::span<const char* const> without = {});
  SettingsFlags(const SettingsFlags&) = delete;
  SettingsFlags& operator=(const SettingsFlags&) = delete;

  /// After parsing. Reads project file and environment, checks that the scene exists. Of a project with
  /// several scenes, --file says which is meant.
  /// nullopt: --print-config was asked for and answered on `out`, the command ends with 0.
  /// Throws Error(usage), Error(io).
  [[nodiscard]] std::optional<ResolvedConfig> resolve(std::ostream& out) const;
  [[nodiscard]] std::optional<ResolvedConfig> resolve() const;  // on stdout

  /// The same with a scene file in the place of the argument.
  [[nodiscard]] std::optional<ResolvedConfig> resolve_scene(const std::filesystem::path& scene) const;

  /// What the command itself wants of the settings; wins over the flags.
  void want(SettingOverride setting) { wanted_.push_back(std::move(setting)); }

  /// The same of a command that takes several scenes or projects, each with the flags, and projects that list
  /// several; of several, each writes into a folder of its own below the output folder, with the name of its
  /// file, unless the project says which. That each of several exists, nobody has looked. Empty: as nullopt
  /// above.
  [[nodiscard]] std::vector<ResolvedConfig> resolve_all() const;
  void take_several_scenes(CLI::App& command);

  /// SCENE as it was typed, a scene or a project file; "" where none was.
  [[nodiscard]] std::string scene_argument() const;

 private:
  void add(CLI::App& command, const Setting& setting, const std::string& group);
  [[nodiscard]] std::vector<SettingOverride> given_flags() const;
  [[nodiscard]] std::vector<ProjectFile> projects_of(const std::string& argument) const;
  [[nodiscard]] std::optional<ResolvedConfig> resolve(const ProjectFile& project, const std::string& argument,
                                                      std::ostream& out) const;

  Purpose purpose_;
  std::vector<std::pair<const Setting*, CLI::Option*>> options_;
  std::vector<SettingOverride> wanted_;
  std::vector<std::string> scenes_;
  CLI::Option* scene_ = nullptr;
  CLI::Option* print_config_ = nullptr;
  CLI::Option* print_reference_ = nullptr;
};

}  // namespace rnmbake
