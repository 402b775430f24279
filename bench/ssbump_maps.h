// bench/ssbump_maps.h - surfaces on which self-shadowed bump maps are compared with the truth.
#pragma once

#include "image/float_image.h"

#include <filesystem>
#include <string>
#include <vector>

namespace rnmbake {

struct SsbumpMap {
  std::string name;
  FloatImage heights;  // in texels, one channel
};

/// 256 x 256 texels each; bump, groove and step have their middle at x = 128.
[[nodiscard]] std::vector<SsbumpMap> generated_maps();

/// `cube` (depths: what is far is low), `rock023` and `rock058` of a folder: means over areas of 256 x 256
/// texels, black to white 32 texels high. Throws Error where a picture cannot be read.
[[nodiscard]] std::vector<SsbumpMap> real_maps(const std::filesystem::path& folder);

}  // namespace rnmbake
