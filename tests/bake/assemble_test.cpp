#include "bake/assemble.h"

#include "bake/fixture.h"
#include "encoding/basis_set.h"
#include "scene/uv_raster.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace rnmbake {
namespace {

/// Light from finitely many directions: L(D) dD is a sum of suns, so every clipped integral is a finite sum.
struct Suns {
  struct Sun {
    Vec3 direction, color;
  };
  std::vector<Sun> suns;

  /// `count` suns over the hemisphere above z = 0 with a total irradiance of 1 in each colour, at least five
  /// degrees above the ground.
  static Suns random(unsigned seed, int count) {
    std::mt19937 engine(seed);
    std::normal_distribution<float> normal;
    Suns light;
    while (int(light.suns.size()) < count) {
      const Vec3 d = Vec3(normal(engine), normal(engine), std::abs(normal(engine))).normalized();
      if (d.z < 0.09F) continue;
      light.suns.push_back({d, Vec3(1, 1, 1) / float(count)});
    }
    return light;
  }

  /// What a receiver with this normal returns: the face is z = 0, whatever the normal.
  [[nodiscard]] Vec3 clipped(const Vec3& normal) const {
    Vec3 sum(0);
    for (const Sun& sun : suns) sum += sun.color * std::max(0.0F, sun.direction.dot(normal));
    return sum;
  }
};

/// What Blender would bake for a tile: for every texel centre the receiver's interpolated normal.
FloatImage bake(const AtlasRect& rect, const Target& target, const Suns& light) {
  std::vector<Vec2> uv;
  for (const ReceiverCorner& corner : rect.pass.corners) uv.push_back(corner.uv);
  const UvRaster raster = rasterize(uv, target.width, target.height);
  FloatImage picture(rect.size.width, rect.size.height, 4);
  const int top = target.height - rect.y - rect.size.height;
  for (int y = 0; y < rect.size.height; ++y) {
    for (int x = 0; x < rect.size.width; ++x) {
      const TexelOwner& owner = raster.at(rect.x + x, top + y);
      if (owner.triangle < 0) continue;
      const auto* k = &rect.pass.corners[3 * std::size_t(owner.triangle)];
      const Vec3 n =
          k[0].normal * (1 - owner.b1 - owner.b2) + k[1].normal * owner.b1 + k[2].normal * owner.b2;
      const Vec3 value = light.clipped(n.normalized());
      const auto texel = picture.texel(x, y);
      for (int c = 0; c < 3; ++c) texel[std::size_t(c)] = value[c];
      texel[3] = 1;
    }
  }
  return picture;
}

struct Scene {
  Surface surface;
  Target target = make_target("thing", 32, 32);
  std::vector<BasisDirection> bases = flat_and_rnm().directions;
  ObjectSettings::Horizon horizon = ObjectSettings::Horizon::identity;

  [[nodiscard]] TargetBakes baked(const Suns& light, bool frames = false) const {
    std::vector<BasisDirection> turned = bases;
    for (BasisDirection& basis : turned) basis.direction = in_frame(basis.direction, target);
    Plan plan;
    add_receiver_tasks(plan, planned(target), make_receiver_passes(surface, turned, horizon),
                       task_names(bases), {});
    std::vector<const AtlasRect*> rects;
    std::vector<FloatImage> pictures;
    for (const AtlasRect& rect : plan.rects) {
      rects.push_back(&rect);
      pictures.push_back(bake(rect, target, light));
    }
    return assemble(target, rects, pictures, bases, &surface, frames);
  }
};

/// One triangle over the lower left half of the map.
Scene one_triangle(const std::array<Vec3, 3>& normals) {
  Scene scene;
  scene.surface.triangles.push_back(floor_triangle({Vec2(0, 0), Vec2(1, 0), Vec2(0, 1)}, normals));
  return scene;
}

/// The largest error of a basis over the texels inside the triangle whose basis normal is at least `degrees`
/// off the horizon, where the truth is the clipped integral of the interpolated, normalised frame.
double largest_error(const Scene& scene, const TargetBakes& bakes, std::size_t b, const Suns& light,
                     double degrees = 0) {
  const auto& k = scene.surface.triangles[0].corners;
  const Vec3 direction = in_frame(scene.bases[b].direction, scene.target);
  double largest = 0;
  for (int y = 0; y < 32; ++y) {
    for (int x = 0; x < 32; ++x) {
      const float u = (float(x) + 0.5F) / 32, v = 1 - (float(y) + 0.5F) / 32;
      if (u + v > 0.97F) continue;
      EXPECT_EQ(bakes.coverage.texel(x, y)[0], 1) << x << " " << y;
      const Vec3 n = (basis_normal(k[0].frame, direction) * (1 - u - v) +
                      basis_normal(k[1].frame, direction) * u + basis_normal(k[2].frame, direction) * v)
                         .normalized();
      if (std::abs(n.z) < std::sin(degrees * pi / 180)) continue;
      const Vec3 truth = light.clipped(n);
      for (int c = 0; c < 3; ++c) {
        const double value = bakes.bases[b].radiance.texel(x, y)[std::size_t(c)];
        largest = std::max(largest, std::abs(value - truth[c]));
      }
    }
  }
  return largest;
}

/// The moments are baked 0.05 degrees above the face, so v's tangents are off by sin(0.05 deg) E_n at most.
const double moment_tilt = std::sin(0.05 * pi / 180);
const double bend = std::sin(0.1 * pi / 180);  // of the interpolation by parts of 10 degrees, at most

TEST(Assemble, CopiesTilesToTheirPlace) {
  const Target target = make_target("thing", 8, 8);
  AtlasRect rect{0, {ReceiverPass::Role::basis, 0, {}}, 2, 1, {3, 2}};  // rows count from the bottom
  FloatImage picture(3, 2, 4);
  for (int y = 0; y < 2; ++y) {
    for (int x = 0; x < 3; ++x) {
      picture.texel(x, y)[0] = float(10 * y + x + 1);
      picture.texel(x, y)[3] = x == 2 ? 0.0F : 1.0F;
    }
  }
  const TargetBakes bakes = assemble(target, {&rect}, {picture}, {flat_direction()}, nullptr, false);
  ASSERT_EQ(bakes.bases.size(), 1U);
  for (int y = 0; y < 8; ++y) {
    for (int x = 0; x < 8; ++x) {
      const bool inside = x >= 2 && x < 4 && y >= 5 && y < 7;
      EXPECT_EQ(bakes.coverage.texel(x, y)[0], inside ? 1 : 0);
      EXPECT_EQ(bakes.bases[0].radiance.texel(x, y)[0], inside ? float(10 * (y - 5) + (x - 2) + 1) : 0);
    }
  }
  EXPECT_TRUE(bakes.tangent.empty());
}

TEST(Assemble, RefusesATargetWithoutATexel) {
  const Target target = make_target("thing", 8, 8);
  const AtlasRect rect{0, {ReceiverPass::Role::basis, 0, {}}, 0, 0, {8, 8}};
  const auto text = error_of(ExitCode::tasks_failed, [&] {
    (void)assemble(target, {&rect}, {FloatImage(8, 8, 4)}, {flat_direction()}, nullptr, false);
  });
  EXPECT_NE(text.find("'thing'"), std::string::npos);
  EXPECT_NE(text.find("--resolution"), std::string::npos);
}

TEST(Assemble, NeedsTheSurfaceOnlyForTheIdentity) {
  const AtlasRect basis{0, {ReceiverPass::Role::basis, 0, {}}, 0, 0, {1, 1}};
  const AtlasRect below{0, {ReceiverPass::Role::below, 0, {}}, 0, 0, {1, 1}};
  EXPECT_FALSE(needs_surface({&basis}));
  EXPECT_TRUE(needs_surface({&basis, &below}));
}

TEST(Assemble, IsExactWithoutTheIdentity) {
  const Scene scene = one_triangle({Vec3(0, 0, 1), Vec3(0.2F, 0, 1), Vec3(0, 0.2F, 1)});
  const Suns light = Suns::random(1, 7);
  const TargetBakes bakes = scene.baked(light);
  for (std::size_t b = 0; b < 4; ++b) EXPECT_LT(largest_error(scene, bakes, b, light), 1e-5);
}

TEST(Horizon, FaceWhollyBelowIsTheClippedIntegral) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    // 60 degrees off the face: B1 and B2 turn with it, B0 falls 24.7 degrees below
    const Scene scene =
        one_triangle({Vec3(std::sqrt(3.0F), 0, 1), Vec3(std::sqrt(3.0F), 0, 1), Vec3(std::sqrt(3.0F), 0, 1)});
    const Suns light = Suns::random(seed, 12);
    const TargetBakes bakes = scene.baked(light);
    for (std::size_t b = 0; b < 4; ++b)
      EXPECT_LT(largest_error(scene, bakes, b, light), 1.5 * moment_tilt)
          << "seed " << seed << " basis " << b;
  }
}

TEST(Horizon, SheetsOfLightFromAllAroundAreExactToAThousandth) {
  // 4096 suns: a smooth sky, where the tilt of opposite moments cancels
  const Scene scene =
      one_triangle({Vec3(std::sqrt(3.0F), 0, 1), Vec3(std::sqrt(3.0F), 0, 1), Vec3(std::sqrt(3.0F), 0, 1)});
  const Suns light = Suns::random(3, 4096);
  const TargetBakes bakes = scene.baked(light);
  for (std::size_t b = 0; b < 4; ++b) EXPECT_LT(largest_error(scene, bakes, b, light), 1e-3);
}

TEST(Horizon, CutTriangleIsTheClippedIntegralOnBothSides) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    const Scene scene = one_triangle({Vec3(0, 0, 1), Vec3(2, 0, 1), Vec3(1, -1.5F, 1)});
    const Suns light = Suns::random(seed + 100, 12);
    const TargetBakes bakes = scene.baked(light);
    for (std::size_t b = 0; b < 4; ++b) {
      SCOPED_TRACE(testing::Message() << "seed " << seed << " basis " << b);
      EXPECT_LT(largest_error(scene, bakes, b, light), 1.5 * moment_tilt + bend);
    }
  }
}

TEST(Horizon, GreenPointingDownTurnsTheBasis) {
  Scene scene = one_triangle({Vec3(0, 2, 1), Vec3(0, 2, 1), Vec3(0, 2, 1)});
  scene.target.flip_green = true;
  const Suns light = Suns::random(8, 12);
  const TargetBakes bakes = scene.baked(light);
  for (std::size_t b = 0; b < 4; ++b) EXPECT_LT(largest_error(scene, bakes, b, light), 1.5 * moment_tilt);
}

TEST(Horizon, ClampIsWrongThereAndNeedsNoSurface) {
  Scene scene =
      one_triangle({Vec3(std::sqrt(3.0F), 0, 1), Vec3(std::sqrt(3.0F), 0, 1), Vec3(std::sqrt(3.0F), 0, 1)});
  scene.horizon = ObjectSettings::Horizon::clamp;
  const Suns light = Suns::random(1, 12);
  const TargetBakes bakes = scene.baked(light);
  EXPECT_LT(largest_error(scene, bakes, 0, light), 1e-5);
  EXPECT_GT(largest_error(scene, bakes, 1, light), 0.05);
}

TEST(Frames, AreThoseOfTheSurface) {
  const Vec3 tilted = Vec3(0.5F, 0.25F, 1).normalized();
  const Scene scene = one_triangle({tilted, tilted, tilted});
  const TargetBakes bakes = scene.baked(Suns::random(1, 3), true);
  ASSERT_EQ(bakes.tangent.channels(), 4);
  const Frame frame = frame_of(tilted);
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(bakes.normal.texel(3, 28)[std::size_t(c)], frame.normal[c], 1e-6);
    EXPECT_NEAR(bakes.tangent.texel(3, 28)[std::size_t(c)], frame.tangent[c], 1e-6);
  }
  EXPECT_EQ(bakes.tangent.texel(3, 28)[3], 1);
  EXPECT_EQ(bakes.normal.texel(30, 1)[2], 0);
}

}  // namespace
}  // namespace rnmbake
