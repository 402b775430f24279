// bake/receiver.h - the receiver recipe: which corner normals make Cycles return E(b)/pi for a basis vector
// b.
//
// A white Lambertian receiver whose corner normal is b = b.x T + b.y B + b.z N returns the clipped integral
// of L max(0, D.b) over the face's hemisphere, exactly, as long as b lies above the face. Where it does not
// (smooth normals far off their face), Cycles would flip the receiver. There the identity
//     max(0, D.b) = max(0, -D.b) + D.b,   so   E(b) = E(-b) + v.b,   v = integral of L D over the hemisphere
// holds, and -b is legal; v comes from five more normals. A triangle that b's horizon crosses is cut there
// (Horizon::identity: exact, up to six more bakes of such faces). Horizon::clamp bends such normals to 89.95
// degrees off the face instead: cheap, and wrong there.
#pragma once

#include "base/math.h"
#include "config/bake_settings.h"
#include "encoding/basis_set.h"
#include "scene/surface.h"

#include <cstddef>
#include <string>
#include <vector>

namespace rnmbake {

/// One corner of a receiver triangle.
struct ReceiverCorner {
  Vec3 position, normal;  // world space
  Vec2 uv;                // lightmap UV, v up, inside [0,1]
};

/// A receiver that shows the radiance that arrives along one ray: a mirror of its own texel (bake/mirrors.h).
struct Mirror {
  Vec3 position, direction;  // of the ray, world space; unit
};

/// One picture to bake of a target.
struct ReceiverPass {
  enum class Role { basis, below, moment, mirrors };
  Role role = Role::basis;
  std::size_t basis = 0;  // index into the list of bases; for a moment: 0..4 = t1, -t1, t2, -t2, face normal;
                          // of mirrors: the half that they belong to
  std::vector<ReceiverCorner> corners;  // three for each triangle
  std::vector<Mirror> mirrors = {};     // in place of corners: one triangle each, in the order of texels
  bool meets_light = false;             // mirrors may show a lamp, the sky or what glows at once

  [[nodiscard]] std::size_t triangles() const { return corners.size() / 3 + mirrors.size(); }
};

struct HorizonCounts {
  std::size_t corners = 0;        // triangle corners x bases
  std::size_t corners_below = 0;  // of these: basis normal under the face
  std::size_t triangles = 0;
  std::size_t triangles_below = 0;  // with such a corner for any basis
};

struct ReceiverPasses {
  std::vector<ReceiverPass>
      passes;  // one with role basis for each basis, in order; then below and moment passes
  HorizonCounts counts;
};

/// Two unit tangents of a face, the same for the same normal: the axes of `v`.
struct FaceAxes {
  Vec3 t1, t2;
};
[[nodiscard]] FaceAxes face_axes(const Vec3& normal);

/// World-space direction of a tangent-space basis vector in a corner's frame, unit length.
[[nodiscard]] Vec3 basis_normal(const Frame& frame, const Vec3& basis);

/// `n` raised to at least `sine` over the face; unit length. The set of such normals is a convex cone, so
/// interpolation between corners stays in it.
[[nodiscard]] Vec3 raise_above(const Vec3& n, const Vec3& face_normal, float sine);

/// `map`: texels of the lightmap along u and v; cut triangles are divided no finer than they need be for it.
[[nodiscard]] ReceiverPasses make_receiver_passes(const Surface& surface,
                                                  const std::vector<BasisDirection>& bases,
                                                  ObjectSettings::Horizon horizon,
                                                  const Vec2& map = Vec2(8192));

}  // namespace rnmbake
