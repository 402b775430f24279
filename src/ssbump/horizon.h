// ssbump/horizon.h - weights out of horizons: sweeps in some azimuths, exact integrals over the elevations.
#pragma once

#include "ssbump/generate.h"

namespace rnmbake {

/// For each texel of the rows wanted: sums, and the weights. Beside them all heights are kept a second time.
inline constexpr std::size_t horizon_bytes_per_texel =
    (SsbumpWeights::channels + SsbumpWeights::channels + SsbumpWeights::channels) * sizeof(float);

/// The weights of rows first_row .. last_row - 1; what lies outside of them casts its shadow as ever.
[[nodiscard]] SsbumpWeights horizon_rows(const HeightField& field, const GenerateOptions& options,
                                         int first_row, int last_row,
                                         const std::function<void(double)>& progress,
                                         const std::function<bool()>& stop);

}  // namespace rnmbake
