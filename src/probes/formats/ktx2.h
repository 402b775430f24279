// probes/formats/ktx2.h - a KTX2 file of one uncompressed picture in three dimensions.
#pragma once

#include <array>
#include <cstdint>
#include <string>

namespace rnmbake {

/// `texels`: RGBA as little-endian half floats, x fastest, z slowest. One level, no supercompression.
/// Khronos, "KTX File Format Specification" 2.0; its data format descriptor: "Khronos Data Format
/// Specification" 1.3.
[[nodiscard]] std::string ktx2_of_halves(const std::array<std::uint32_t, 3>& size, const std::string& texels);

}  // namespace rnmbake
