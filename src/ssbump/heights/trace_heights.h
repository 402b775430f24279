// ssbump/heights/trace_heights.h - intersections of rays with a height field's bilinear patches.
#pragma once

#include "base/math.h"
#include "ssbump/heights/height_field.h"

#include <optional>
#include <utility>

namespace rnmbake {

/// A place over the field: column and row in texels, also beyond the borders.
struct HeightPlace {
  double column = 0, row = 0, height = 0;
};

struct HeightHit {
  HeightPlace place;
  Vec3d normal;  // tangent space, unit length, up
};

/// Rays walk from cell to cell (the square between four texel centres). The field must outlive it and be
/// finite.
class HeightTracer {
 public:
  explicit HeightTracer(const HeightField& field);

  /// The texel's centre.
  [[nodiscard]] HeightPlace centre(int x, int y) const;

  /// Next intersection of a ray that starts on the surface; `direction` in tangent space. Rays end after
  /// 65,536 cells.
  [[nodiscard]] std::optional<HeightHit> next(const HeightPlace& from, const Vec3d& direction) const;

  /// The texel of the map that a place belongs to.
  [[nodiscard]] std::pair<int, int> texel(const HeightPlace& place) const;

 private:
  /// h + u by_u + v by_v + u v by_uv over a cell.
  struct Patch {
    double h = 0, by_u = 0, by_v = 0, by_uv = 0;
  };
  [[nodiscard]] double height(int x, int y) const;
  [[nodiscard]] Patch patch(int x, int y) const;

  const HeightField& field_;
  double highest_ = 0;
};

}  // namespace rnmbake
