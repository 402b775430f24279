#include "ssbump/heights/height_mesh.h"

#include "ssbump/generate/generate.h"
#include "ssbump/generate/hemisphere_rays.h"
#include "ssbump/low_high.h"
#include "ssbump/mesh/triangle_tree.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

HeightField random_field(int width, int height, WrapMode x, WrapMode y, float amplitude = 2) {
  HeightField field{FloatImage(width, height, 1), x, y};
  std::mt19937 random(7);
  std::uniform_real_distribution<float> uniform(0, amplitude);
  for (float& value : field.heights.data()) value = uniform(random);
  return field;
}

/// All copies as one mesh; fronts stay up where a copy is mirrored.
HighMesh all_copies(const HeightField& field, double reach, PatchCuts cuts = PatchCuts::one) {
  const HeightMesh mesh = height_mesh(field, cuts);
  HighMesh high;
  for (const HeightCopy& copy : height_copies(field, reach)) {
    for (const auto& triangle : mesh.triangles) {
      std::array<Vec3, 3> p;
      for (std::size_t k = 0; k < 3; ++k) {
        const Vec3& from = mesh.positions[triangle[copy.sign_x * copy.sign_y < 0 ? 2 - k : k]];
        p[k] = {from.x * float(copy.sign_x) + copy.shift_x, from.y * float(copy.sign_y) + copy.shift_y,
                from.z};
      }
      high.position.insert(high.position.end(), p.begin(), p.end());
      high.normal.insert(high.normal.end(), 3, unit((p[1] - p[0]).cross(p[2] - p[0])));
    }
  }
  return high;
}

/// What the field is at any texel of the plane.
float height_at(const HeightField& field, int x, int y) {
  return field.heights.texel(texel_beyond(x, field.width(), field.x),
                             texel_beyond(y, field.height(), field.y))[0];
}

TEST(HeightMesh, CopiesGoOnBeyondEveryBorder) {
  for (const WrapMode beyond : {WrapMode::wrap, WrapMode::mirror, WrapMode::none}) {
    const HeightField field = random_field(5, 3, beyond, WrapMode::wrap);
    const TriangleTree tree(all_copies(field, 8, PatchCuts::three).position);
    for (int y = -6; y < 9; ++y) {
      for (int x = -6; x < 11; ++x) {
        const auto hit = tree.first(Vec3(float(x), float(-y), 100), Vec3(0, 0, -1), 0, 1000);
        ASSERT_TRUE(hit) << x << ' ' << y;
        EXPECT_NEAR(100 - hit->distance, height_at(field, x, y), 1e-4) << x << ' ' << y;
        const auto between =
            tree.first(Vec3(float(x) + 0.5F, float(-y) - 0.5F, 100), Vec3(0, 0, -1), 0, 1000);
        ASSERT_TRUE(between);
        EXPECT_NEAR(100 - between->distance,
                    (height_at(field, x, y) + height_at(field, x + 1, y) + height_at(field, x, y + 1) +
                     height_at(field, x + 1, y + 1)) /
                        4,
                    1e-4);
      }
    }
  }
}

TEST(HeightMesh, CellsLieOnTheBilinearSurface) {
  const HeightField field = random_field(4, 4, WrapMode::wrap, WrapMode::wrap);
  const TriangleTree tree(all_copies(field, 1, PatchCuts::five).position);
  for (const float u : {0.0F, 1.0F / 32, 0.25F, 0.5F, 0.75F, 31.0F / 32, 1.0F}) {
    const float a = field.heights.texel(1, 1)[0], b = field.heights.texel(2, 1)[0],
                c = field.heights.texel(1, 2)[0], d = field.heights.texel(2, 2)[0];
    const auto hit = tree.first(Vec3(1 + u, -1 - u, 100), Vec3(0, 0, -1), 0, 1000);
    ASSERT_TRUE(hit);
    EXPECT_NEAR(100 - hit->distance, std::lerp(std::lerp(a, b, u), std::lerp(c, d, u), u), 1e-4) << u;
  }
}

TEST(HeightMesh, TrianglesFaceUp) {
  const HeightField field = random_field(4, 4, WrapMode::mirror, WrapMode::none);
  const HighMesh high = all_copies(field, 4);
  for (const Vec3& normal : high.normal) EXPECT_GT(normal.z, 0);
}

/// Heights that do not change along y make every patch a plane: the very same surface.
TEST(HeightMesh, AsAMeshItHasTheWeightsOfTheHeightField) {
  HeightField field = random_field(16, 8, WrapMode::wrap, WrapMode::none, 3);
  for (int y = 1; y < field.height(); ++y) {
    for (int x = 0; x < field.width(); ++x) field.heights.texel(x, y)[0] = field.heights.texel(x, 0)[0];
  }
  // On a ridge between two faces a point of the mesh belongs to one of them, a point of the field to both: so
  // there are four columns for one, and three of them are compared.
  HeightField fine{FloatImage(64, 8, 1), WrapMode::wrap, WrapMode::wrap};
  for (int y = 0; y < 8; ++y) {
    for (int x = 0; x < 64; ++x) {
      const float a = field.heights.texel(x / 4, y)[0], b = field.heights.texel((x / 4 + 1) % 16, y)[0];
      fine.heights.texel(x, y)[0] = 4 * (a + (b - a) * float(x % 4) / 4);  // as steep as before
    }
  }
  const float left = -0.5F, right = 63.5F, top = 0.5F, bottom = -7.5F;
  const LowSurface low = low_rectangle("low", {left, bottom}, {right, top});
  MeshOcclusionOptions options;
  options.width = 64;
  options.height = 8;
  options.cage = 20;
  options.parts = 1;
  options.rays = 1024;
  HeightField endless = fine;  // the same surface in fewer triangles
  endless.y = WrapMode::none;
  const MeshOcclusion mesh = measure_occlusion(all_copies(endless, 64 * 12), {&low, 1}, options);
  GenerateOptions traced;
  traced.method = SsbumpMethod::trace;
  traced.rays = 4096;
  const SsbumpWeights truth = generate(fine, traced);
  for (std::size_t channel = 0; channel < SsbumpWeights::channels; ++channel) {
    double squares = 0, sum = 0;
    int count = 0;
    for (int y = 0; y < 8; ++y) {
      for (int x = 0; x < 64; ++x) {
        if (x % 4 == 0) continue;  // a ridge: the mesh's point lies in one of two faces
        const double s = truth.image.texel(x, y)[channel], off = mesh.weights.image.texel(x, y)[channel] - s;
        const double variance = std::max(s * (1 - s), 1e-3) * (1.0 / 1024 + 1.0 / 4096);
        EXPECT_LT(std::abs(off), 5 * std::sqrt(variance)) << x << ' ' << y << ' ' << channel;
        squares += off * off / variance;
        sum += off;
        ++count;
      }
    }
    EXPECT_LT(squares / count, 1.2) << channel;
    EXPECT_LT(std::abs(sum / count), 0.002) << channel;
  }
}

/// The share of each channel that rays from just over a texel's centre find open.
SsbumpChannels seen_from(const TriangleTree& tree, const Vec3& place, const std::vector<WeightedRay>& rays) {
  std::array<double, SsbumpWeights::channels> seen{}, all{};
  for (const WeightedRay& ray : rays) {
    const bool open = !tree.blocked(place, ray.direction, 1e9F);
    for (std::size_t c = 0; c < all.size(); ++c) {
      all[c] += ray.weight[c];
      if (open) seen[c] += ray.weight[c];
    }
  }
  SsbumpChannels shares{};
  for (std::size_t c = 0; c < all.size(); ++c) shares[c] = static_cast<float>(seen[c] / all[c]);
  return shares;
}

TEST(HeightMesh, SeesWhatTracedTexelsSeeWhateverLiesBeyond) {
  constexpr int count = 8192;
  const HemisphereRays rays(count, 1, 3);
  for (const WrapMode beyond : {WrapMode::wrap, WrapMode::mirror, WrapMode::none}) {
    HeightField field{FloatImage(9, 6, 1), beyond, beyond};
    for (int y = 0; y < 6; ++y) {
      for (int x = 0; x < 9; ++x)
        field.heights.texel(x, y)[0] = float(2 * std::sin(0.8 * x) + 1.5 * std::cos(0.9 * y));
    }
    GenerateOptions traced;
    traced.method = SsbumpMethod::trace;
    traced.rays = count;
    const SsbumpWeights truth = generate(field, traced);
    const TriangleTree tree(all_copies(field, 60, PatchCuts::five).position);
    double squares = 0, variances = 0, n = 0;
    for (int y = 0; y < 6; ++y) {
      for (int x = 0; x < 9; ++x) {
        const Vec3 place(float(x), float(-y), field.heights.texel(x, y)[0] + 1e-5F);
        const SsbumpChannels shares = seen_from(tree, place, rays.set(std::uint64_t(x + y)));
        for (std::size_t c = 0; c < shares.size(); ++c) {
          const double s = truth.image.texel(x, y)[c], off = shares[c] - s;
          const double variance = std::max(s * (1 - s), 1e-3) * 2 / count;
          EXPECT_LT(std::abs(off), 5 * std::sqrt(variance)) << x << ' ' << y;
          squares += off * off;
          variances += variance;
          ++n;
        }
      }
    }
    // No more than that noise, and 0.001 for triangles instead of bilinear patches.
    EXPECT_LT(squares / n, variances / n + 1e-6) << int(beyond);
  }
}

}  // namespace
}  // namespace rnmbake
