// blender/blend_header.h - version of the Blender that saved a .blend, read from its first bytes.
#pragma once

#include "blender/blender_info.h"

#include <filesystem>
#include <optional>
#include <string>

namespace rnmbake {

/// Version of the file's format: that of the Blender that saved it, without the patch.
struct BlendHeader {
  int major = 0, minor = 0;
};

/// Version of a plain or compressed file (zstd; gzip before 3.0); nullopt where it does not begin as a .blend
/// does. Throws Error(io) where the file cannot be read.
[[nodiscard]] std::optional<BlendHeader> read_blend_header(const std::filesystem::path& file);

/// Reason why this Blender cannot read the file, with the remedy; empty where it may.
[[nodiscard]] std::string unreadable_blend(const std::filesystem::path& file, const BlenderInfo& blender);

/// "hall.blend was saved by Blender 4.3, this is 3.4.1, `which`; name ...", where the file is newer; else
/// empty. Blender opens many such files without the data that it does not know, and crashes over others.
[[nodiscard]] std::string newer_blend(const std::filesystem::path& file, const BlenderInfo& blender,
                                      const std::string& which);

}  // namespace rnmbake
