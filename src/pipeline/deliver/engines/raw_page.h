// pipeline/deliver/engines/raw_page.h - pages as a GPU holds them, for engines that read no EXR.
#pragma once

#include "pipeline/deliver/delivery_files.h"
#include "pipeline/deliver/pages.h"

#include <cstddef>

#include <nlohmann/json.hpp>

namespace rnmbake {

/// Writes each layer as pageN.LAYER.rgba16f and returns their names, as EngineTarget::write_page() does: half
/// floats, little endian, red, green, blue and 1 for each texel, rows from the top, and nothing else. The
/// record has width and height.
[[nodiscard]] nlohmann::ordered_json write_raw_page(DeliveryFiles& files, std::size_t number,
                                                    const Page& page);

}  // namespace rnmbake
