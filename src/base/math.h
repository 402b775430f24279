// base/math.h - the vector types that every room shares (Imath's).
#pragma once

#include <ImathMatrix.h>
#include <ImathVec.h>

namespace rnmbake {

using Vec2 = Imath::V2f;
using Vec3 = Imath::V3f;
using Vec3d = Imath::V3d;
/// Row-vector convention: p' = p * M, the transpose of how Blender writes a matrix.
using Mat44 = Imath::M44d;

inline constexpr double pi = 3.14159265358979323846;

}  // namespace rnmbake
