#include "scene/test_meshes.h"
#include "scene/uv_raster.h"
#include "scene/uv_report.h"
#include "unwrap/unwrap_mesh.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

/// Polygons by their corners; quads are cut from corner 0 to corner 2.
class MeshMaker {
 public:
  void add(const std::vector<Vec3>& corners) {
    const auto start = static_cast<std::uint32_t>(mesh_.loop_vertex.size());
    const auto size = static_cast<std::uint32_t>(corners.size());
    for (std::uint32_t i = 0; i < size; ++i) {
      mesh_.loop_vertex.push_back(static_cast<std::uint32_t>(mesh_.positions.size()));
      mesh_.positions.push_back(corners[i]);
    }
    for (std::uint32_t i = 2; i < size; ++i) {
      for (const std::uint32_t corner : {0U, i - 1, i}) mesh_.triangle_loops.push_back(start + corner);
      mesh_.triangle_polygon.push_back(static_cast<std::uint32_t>(mesh_.polygon_start.size()));
    }
    mesh_.polygon_start.push_back(start);
    mesh_.polygon_size.push_back(size);
    mesh_.polygon_slot.push_back(0);
  }
  void add_box(const Vec3& low, const Vec3& size) {
    const auto at = [&](int x, int y, int z) { return low + Vec3(float(x), float(y), float(z)) * size; };
    add({at(0, 0, 0), at(0, 1, 0), at(1, 1, 0), at(1, 0, 0)});
    add({at(0, 0, 1), at(1, 0, 1), at(1, 1, 1), at(0, 1, 1)});
    add({at(0, 0, 0), at(1, 0, 0), at(1, 0, 1), at(0, 0, 1)});
    add({at(0, 1, 0), at(0, 1, 1), at(1, 1, 1), at(1, 1, 0)});
    add({at(0, 0, 0), at(0, 0, 1), at(0, 1, 1), at(0, 1, 0)});
    add({at(1, 0, 0), at(1, 1, 0), at(1, 1, 1), at(1, 0, 1)});
  }
  [[nodiscard]] Mesh take() { return std::move(mesh_); }

 private:
  Mesh mesh_;
};

Mesh box() {
  MeshMaker maker;
  maker.add_box({0, 0, 0}, {1, 2, 3});
  return maker.take();
}

Mesh boxes(int count) {
  MeshMaker maker;
  std::mt19937 random(1);
  std::uniform_real_distribution<float> place(-50, 50), size(0.1F, 3);
  for (int i = 0; i < count; ++i) {
    maker.add_box({place(random), place(random), place(random)}, {size(random), size(random), size(random)});
  }
  return maker.take();
}

/// A ramp that winds up three times: seen from above it lies on top of itself.
Mesh spiral() {
  MeshMaker maker;
  const auto at = [](int step, float radius) {
    const float angle = float(step) * float(pi) / 12;
    return Vec3(radius * std::cos(angle), radius * std::sin(angle), 0.02F * float(step));
  };
  for (int i = 0; i < 72; ++i) maker.add({at(i, 1), at(i, 2), at(i + 1, 2), at(i + 1, 1)});
  return maker.take();
}

Mesh ball() {
  MeshMaker maker;
  constexpr int rings = 16;
  const auto at = [](int ring, int step) {
    const double a = pi * ring / rings, b = pi * step / rings;
    return Vec3(float(std::sin(a) * std::cos(b)), float(std::sin(a) * std::sin(b)), float(std::cos(a)));
  };
  for (int ring = 0; ring < rings; ++ring) {
    for (int step = 0; step < 2 * rings; ++step)
      maker.add({at(ring, step), at(ring + 1, step), at(ring + 1, step + 1), at(ring, step + 1)});
  }
  return maker.take();
}

struct Made {
  Charts charts;
  Unwrapping unwrapping;
};

Made unwrapped(const Mesh& mesh, int side, double margin_texels, const Mat44& to_world = {}) {
  Made made;
  made.charts = make_charts(mesh, to_world, side);
  made.unwrapping = unwrap_charts(mesh, made.charts, margin_texels / side);
  return made;
}

/// The least distance in texels, along x or y, between texels whose centres lie in different charts.
int least_gap(const Mesh& mesh, const Made& made, int side) {
  std::vector<int> chart(mesh.polygon_start.size(), -1);
  for (std::size_t i = 0; i < made.charts.charts.size(); ++i) {
    for (const std::uint32_t polygon : made.charts.charts[i].polygons) chart[polygon] = int(i);
  }
  std::vector<Vec2> corners;
  for (const std::uint32_t loop : mesh.triangle_loops) corners.push_back(made.unwrapping.uv[loop]);
  const UvRaster raster = rasterize(corners, side, side);
  const auto chart_at = [&](int x, int y) {
    const int triangle = raster.at(x, y).triangle;
    return triangle < 0 ? -1 : chart[mesh.triangle_polygon[std::size_t(triangle)]];
  };
  for (int gap = 1; gap < side; ++gap) {
    for (int y = 0; y < side; ++y) {
      for (int x = 0; x < side; ++x) {
        const int here = chart_at(x, y);
        if (here < 0) continue;
        for (int dy = 0; dy <= gap && y + dy < side; ++dy) {
          for (int dx = -gap; dx <= gap; ++dx) {
            if (std::max(std::abs(dx), dy) != gap || x + dx < 0 || x + dx >= side) continue;
            const int there = chart_at(x + dx, y + dy);
            if (there >= 0 && there != here) return gap;
          }
        }
      }
    }
  }
  return side;
}

/// Everything that a lightmap needs of its UVs.
void expect_sound(const Mesh& mesh, const Made& made, int side) {
  const UvReport report = report_uv(mesh, made.unwrapping.uv, {}, side, side);
  EXPECT_EQ(report.overlap_texels, 0U);
  EXPECT_EQ(report.outside_corners, 0U);
  EXPECT_EQ(report.degenerate_uv, 0U);
  EXPECT_EQ(report.mirrored_charts, 0U);
}

TEST(Unwrap, GivesABoxSixFlatChartsWithTheMarginBetweenThem) {
  const Mesh mesh = box();
  const Made made = unwrapped(mesh, 256, 4);
  EXPECT_EQ(made.charts.charts.size(), 6U);
  EXPECT_NEAR(made.charts.world_area, 22, 1e-9);
  expect_sound(mesh, made, 256);
  EXPECT_GE(least_gap(mesh, made, 256), 4);
  EXPECT_GT(made.unwrapping.uv_area, 0.5);
}

TEST(Unwrap, StretchesNothingBeyondItsLimit) {
  const Mesh mesh = ball();
  const Made made = unwrapped(mesh, 256, 4);
  expect_sound(mesh, made, 256);
  const UvReport report = report_uv(mesh, made.unwrapping.uv, {}, 256, 256);
  // Areas shrink by the cosine, densities by its root.
  EXPECT_LT(report.density.max / report.density.min, 1.001 / std::sqrt(std::cos(widest_angle)));
  EXPECT_LT(made.charts.charts.size(), 24U);
}

TEST(Unwrap, CutsWhatWouldLieOnTopOfItself) {
  const Mesh mesh = spiral();
  const Made made = unwrapped(mesh, 256, 2);
  EXPECT_GE(made.charts.charts.size(), 3U);  // one for each turn, at the least
  expect_sound(mesh, made, 256);
}

TEST(Unwrap, JoinsFacesByPlaceAndNotByVertex) {
  MeshMaker maker;  // a strip whose quads have vertices of their own, as glTF has them at hard edges
  for (int i = 0; i < 8; ++i) {
    const auto x = float(i);
    maker.add({{x, 0, 0}, {x + 1, 0, 0}, {x + 1, 1, 0}, {x, 1, 0}});
  }
  EXPECT_EQ(make_charts(maker.take(), {}, 64).charts.size(), 1U);
}

TEST(Unwrap, PacksThousandsOfCharts) {
  const Mesh mesh = boxes(400);
  const Made made = unwrapped(mesh, 1024, 2);
  EXPECT_EQ(made.charts.charts.size(), 2400U);
  expect_sound(mesh, made, 1024);
  EXPECT_GE(least_gap(mesh, made, 1024), 2);
  EXPECT_EQ(made.unwrapping.margin, 2.0 / 1024);
  EXPECT_GT(made.unwrapping.uv_area, 0.5);
}

TEST(Unwrap, NarrowsAMarginThatLeavesNoRoomAndSaysSo) {
  const Mesh mesh = boxes(100);
  const Made made = unwrapped(mesh, 64, 4);
  EXPECT_LT(made.unwrapping.margin, 4.0 / 64);
  EXPECT_GT(made.unwrapping.uv_area, 0.1);
  expect_sound(mesh, made, 1024);
}

TEST(Unwrap, LeavesOutFacesWithoutArea) {
  MeshMaker maker;
  maker.add({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
  const float thin = 1e-9F;
  maker.add({{0, 0, 0}, {1, 1, 1}, {3, 3, 3}});             // on a line
  maker.add({{5, 5, 5}, {5, 5, 5}, {5, 5, 5}});             // a point
  maker.add({{0, 2, 0}, {1, 2, 0}, {1, 2 + thin, 0}});      // as thin as floats go
  maker.add({{7, 0, 0}, {8, 0, 0}, {7, 0, 0}, {8, 0, 0}});  // folded shut
  const Mesh mesh = maker.take();
  const Made made = unwrapped(mesh, 64, 2);
  EXPECT_EQ(made.charts.charts.size(), 1U);
  expect_sound(mesh, made, 64);
  for (std::size_t loop = 4; loop < mesh.loop_vertex.size(); ++loop)
    EXPECT_EQ(made.unwrapping.uv[loop], Vec2(0, 0));
}

TEST(Unwrap, HasNoChartsWhereNothingHasArea) {
  MeshMaker maker;
  maker.add({{0.1F, 0.2F, 0.3F}, {1.1F, 2.2F, 3.3F}, {0.6F, 1.2F, 1.8F}});
  maker.add({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}});
  const Mesh mesh = maker.take();
  const Made made = unwrapped(mesh, 64, 2);
  EXPECT_TRUE(made.charts.charts.empty());
  EXPECT_EQ(made.unwrapping.uv_area, 0);
  EXPECT_EQ(made.unwrapping.uv.size(), mesh.loop_vertex.size());
}

TEST(Unwrap, TakesLinesForWhatTheyAreInSpiteOfRounding) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> at(-10, 10), along(-1, 1);
  MeshMaker maker;
  for (int i = 0; i < 2000; ++i) {
    const Vec3d place(at(random), at(random), at(random)), direction(at(random), at(random), at(random));
    std::vector<Vec3> corners;
    for (int k = 0; k < 3; ++k) corners.emplace_back(place + direction * along(random));
    maker.add(corners);
  }
  EXPECT_TRUE(unwrapped(maker.take(), 64, 2).charts.charts.empty());
}

TEST(Unwrap, EndsAtAnySize) {
  for (const float size : {1e-20F, 1e-12F, 1e-6F, 1e6F, 1e15F}) {
    Mesh mesh = box();
    for (Vec3& position : mesh.positions) position *= size;
    const Made made = unwrapped(mesh, 64, 2);
    EXPECT_EQ(made.charts.charts.size(), 6U) << size;
    EXPECT_GT(made.unwrapping.uv_area, 0.4) << size;
  }
}

TEST(Unwrap, EndsWithSliversAmongLargeFaces) {
  MeshMaker maker;
  std::mt19937 random(2);
  std::uniform_real_distribution<float> at(-10, 10);
  std::uniform_real_distribution<double> exponent(-7, 0);
  for (int i = 0; i < 300; ++i) {
    const Vec3 a(at(random), at(random), at(random)), along(at(random), at(random), at(random));
    const Vec3 aside = along % Vec3(at(random), at(random), at(random));
    maker.add({a, a + along, a + along * 0.3F + aside * float(std::pow(10, exponent(random)))});
  }
  const Mesh mesh = maker.take();
  const Made made = unwrapped(mesh, 256, 1);
  for (const Vec2& uv : made.unwrapping.uv)
    EXPECT_TRUE(uv.x >= 0 && uv.x <= 1 && uv.y >= 0 && uv.y <= 1) << uv;
  EXPECT_EQ(report_uv(mesh, made.unwrapping.uv, {}, 256, 256).overlap_texels, 0U);
}

TEST(Unwrap, FollowsTheScaleOfTheObject) {
  Mat44 to_world;
  to_world.setScale(Vec3d(10, 1, 1));
  const Mesh mesh = square();
  const Made made = unwrapped(mesh, 256, 0, to_world);
  const UvReport report = report_uv(mesh, made.unwrapping.uv, to_world, 256, 256);
  EXPECT_NEAR(report.density.max, 256.0 / 20, 0.01);  // 20 x 2 units: the long side fills the square's
}

}  // namespace
}  // namespace rnmbake
