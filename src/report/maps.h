// report/maps.h - lightmaps made small enough to be shown in a report.
#pragma once

#include "image/metrics.h"
#include "report/comparison.h"

#include <cstddef>
#include <string>
#include <vector>

namespace rnmbake {

/// The longer side of maps that a report of so many objects and bases has room for: a power of two, 16 to
/// 256.
[[nodiscard]] int map_limit(std::size_t objects, std::size_t bases);

/// Means over blocks of texels, by a whole factor, so that neither side is longer than `limit`. NaN counts
/// for nothing; a block of nothing but NaN is NaN.
[[nodiscard]] FloatImage shrink(const FloatImage& image, int limit);

/// Maps of one basis for the report: values (means where there are two halves) and standard errors, NaN
/// outside of a mask of `counted`, scaled down to `limit`.
[[nodiscard]] BasisMaps make_maps(const std::string& basis, const ComparedPicture& candidate,
                                  const ComparedPicture& reference, const std::vector<CountedWhere>& counted,
                                  int limit);

}  // namespace rnmbake
