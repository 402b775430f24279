// blender/blender_info.h - version and abilities of a Blender.
#pragma once

#include <compare>
#include <filesystem>
#include <string>
#include <vector>

namespace rnmbake {

struct BlenderVersion {
  int major = 0, minor = 0, patch = 0;
  auto operator<=>(const BlenderVersion&) const =
      default;  // NOLINT(modernize-use-nullptr): clang-tidy 14 errs
};

inline constexpr BlenderVersion oldest_blender = {3, 4, 0};

struct BlenderInfo {
  std::filesystem::path executable;
  bool is_module = false;  // Python's module bpy; the executable is an interpreter that has it
  BlenderVersion version;
  std::vector<std::filesystem::path> folders;  // beside the executable's own, that it consists of
  std::string version_text;                    // as printed: "3.4.1"
  std::string build;                           // build date, hash, platform where printed
  std::vector<std::string> devices;            // "CPU", "CUDA", ...: compute devices that Cycles lists
  bool has_numpy = false;                      // the glTF importer needs it
  bool has_denoiser = false;
};

}  // namespace rnmbake
