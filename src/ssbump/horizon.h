// ssbump/horizon.h - weights out of horizons: sweeps in some azimuths, exact integrals over the elevations.
#pragma once

#include "ssbump/generate.h"
#include "ssbump/horizon_sums.h"

#include <cstdint>

namespace rnmbake {

/// For each texel of the rows wanted: sums of two grids, weights of two sets of azimuths, sines. Beside them
/// all heights are kept twice more.
inline constexpr std::size_t horizon_bytes_per_texel =
    4 * SsbumpWeights::channels * sizeof(float) + 2 * HorizonSines::azimuths * sizeof(std::uint16_t);

/// The weights of rows first_row .. last_row - 1; what lies outside of them casts its shadow as ever.
[[nodiscard]] SsbumpWeights horizon_rows(const HeightField& field, const GenerateOptions& options,
                                         int first_row, int last_row,
                                         const std::function<void(double)>& progress,
                                         const std::function<bool()>& stop);

}  // namespace rnmbake
