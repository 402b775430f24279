// blender/probe.h - which Blender is there and what it can do.
#pragma once

#include <compare>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace rnmbake {

class ScriptFolder;

struct BlenderVersion {
  int major = 0, minor = 0, patch = 0;
  auto operator<=>(const BlenderVersion&) const = default;
};

inline constexpr BlenderVersion oldest_blender = {3, 4, 0};

struct BlenderInfo {
  std::filesystem::path executable;
  BlenderVersion version;
  std::string version_text;          // as printed: "3.4.1"
  std::string build;                 // build date, hash, platform where printed
  std::vector<std::string> devices;  // "CPU", "CUDA", ...: compute devices that Cycles lists
  bool has_numpy = false;            // the glTF importer needs it
  bool has_denoiser = false;
};

/// Cheap (`blender --version`, a tenth of a second): executable, version and build; the rest stays empty.
/// Error(environment) if that is no Blender, one older than oldest_blender, or it does not answer.
BlenderInfo probe_version(const std::filesystem::path& executable);

/// Fills in devices, numpy and denoiser by one headless launch (1-2 s). Error(environment) if it fails.
void probe_devices(BlenderInfo& info, const ScriptFolder& scripts);

/// From the output of --version, whatever else it holds; fills version, version_text and build.
/// False: no Blender printed that.
bool parse_version(std::string_view output, BlenderInfo& info);

}  // namespace rnmbake
