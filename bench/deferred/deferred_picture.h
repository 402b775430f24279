// bench/deferred/deferred_picture.h - one light in several ways, side by side.
#pragma once

#include "deferred_scene.h"

#include <filesystem>
#include <vector>

namespace rnmbake {

/// Three panels to a row, each a part of the view without colours: light times `left`. Red where a pixel is
/// called shadow that the truth has lit.
void write_panels(const std::filesystem::path& file, const LitPixels& lit,
                  const std::vector<FloatImage>& left);

}  // namespace rnmbake
