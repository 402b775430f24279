// cli/render_flags.h - what `rnmbake render` was asked for.
#pragma once

#include "config/resolve.h"

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace rnmbake {

/// Its own flags, and those of the settings that matter for a view. Must live as long as `command`.
class RenderFlags {
 public:
  explicit RenderFlags(CLI::App& command);
  RenderFlags(const RenderFlags&) = delete;
  RenderFlags& operator=(const RenderFlags&) = delete;

  /// Throws Error(usage) where flags contradict each other or one is missing.
  void check();

  /// Project file, environment and flags. Throws Error(usage), Error(io) as SettingsFlags::resolve().
  [[nodiscard]] ResolvedConfig resolve() const;

  /// Of --resolution.
  [[nodiscard]] std::optional<std::pair<int, int>> size() const;

  /// The flags of its own, as one would type them, with a blank before each.
  [[nodiscard]] std::string as_text() const;

  std::filesystem::path lightmaps, output;
  std::string decode, with, materials = "lambert", resolution;
  int samples = 0;  // 0: not said
  float exposure = 0;
  bool compare = false;

 private:
  void add_pictures(CLI::App& command);
  void add_settings(CLI::App& command);

  CLI::Option* scene_ = nullptr;
  std::vector<std::pair<const Setting*, CLI::Option*>> settings_;
};

[[nodiscard]] bool is_png(const std::filesystem::path& file);

}  // namespace rnmbake
