// unwrap/upright.h - turns points of the plane so that they fill the smallest upright rectangle.
#pragma once

#include "base/math.h"

#include <vector>

namespace rnmbake {

/// Turns and moves the points: the lower left of their rectangle is 0, and it is at least as high as wide.
/// Returns its size. A rectangle of least area has a side along an edge of the convex hull (Freeman & Shapira
/// 1975); of many edges the longest are tried.
Imath::V2d upright(std::vector<Imath::V2d>& points);

}  // namespace rnmbake
