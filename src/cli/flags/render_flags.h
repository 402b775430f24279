// cli/flags/render_flags.h - the flags of `rnmbake render`.
#pragma once

#include "cli/flags/settings_flags.h"

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace rnmbake {

/// Its own flags, and those of the settings that matter for a view. Must live as long as `command`.
class RenderFlags {
 public:
  explicit RenderFlags(CLI::App& command);
  RenderFlags(const RenderFlags&) = delete;
  RenderFlags& operator=(const RenderFlags&) = delete;

  /// Throws Error(usage) where flags contradict each other or one is missing.
  void check();

  /// Of --resolution.
  [[nodiscard]] std::optional<std::pair<int, int>> size() const;

  /// The flags of its own, as one would type them, with a blank before each.
  [[nodiscard]] std::string as_text() const;

  SettingsFlags settings;
  std::vector<std::filesystem::path> lightmaps;  // the bakes first, or one that was converted
  std::filesystem::path probes;                  // "": none
  std::vector<std::string> dynamic;              // what they light
  std::string probes_as = "sh3", leak_test;      // "": the best that they allow
  std::filesystem::path output;
  bool decode_by_header = false;  // nothing was said: what the lightmaps are made for
  std::string decode, with, materials = "lambert", resolution, camera;
  int samples = 0;  // 0: not said
  float exposure = 0;
  bool compare = false, gbuffer = false, spheres = false;
};

[[nodiscard]] bool is_png(const std::filesystem::path& file);

}  // namespace rnmbake
