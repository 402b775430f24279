// base/disk.h - whether there is room left.
#pragma once

#include <filesystem>

namespace rnmbake {

/// Whether hardly anything (64 KiB) can be written there any more.
[[nodiscard]] bool disk_is_full(const std::filesystem::path& folder);

}  // namespace rnmbake
