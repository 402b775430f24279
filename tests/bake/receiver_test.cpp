#include "bake/receiver.h"

#include "bake/fixture.h"
#include "encoding/basis_set.h"
#include "scene/test_meshes.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace rnmbake {
namespace {

using Horizon = ObjectSettings::Horizon;
using Role = ReceiverPass::Role;

float sine_of(double degrees) {
  return static_cast<float>(std::sin(degrees * pi / 180));
}

std::size_t count(const ReceiverPasses& passes, Role role) {
  return static_cast<std::size_t>(std::count_if(passes.passes.begin(), passes.passes.end(),
                                                [&](const ReceiverPass& pass) { return pass.role == role; }));
}

const ReceiverPass* find(const ReceiverPasses& passes, Role role, std::size_t basis) {
  for (const ReceiverPass& pass : passes.passes)
    if (pass.role == role && pass.basis == basis) return &pass;
  return nullptr;
}

Surface flat_square() {
  const Mesh mesh = square();
  const Mat44 id;
  return make_surface(mesh, {0, 1}, square_uv(), tangent_frames(mesh, square_uv(), id), id);
}

/// A cube of which every corner's normal points away from its middle: 54.7 degrees off each face.
Surface smooth_cube() {
  Surface surface;
  for (int axis = 0; axis < 3; ++axis) {
    for (const float side : {-1.0F, 1.0F}) {
      Vec3 n(0), u(0), v(0);
      n[axis] = side;
      u[(axis + 1) % 3] = side;
      v[(axis + 2) % 3] = 1;  // u x v = n
      const std::array<Vec3, 4> p{n - u - v, n + u - v, n + u + v, n - u + v};
      const std::array<Vec2, 4> uv{Vec2(0, 0), Vec2(1, 0), Vec2(1, 1), Vec2(0, 1)};
      for (const auto& [a, b, c] : {std::array{0, 1, 2}, std::array{0, 2, 3}}) {
        SurfaceTriangle triangle;
        triangle.normal = n;
        const std::array<int, 3> index{a, b, c};
        for (std::size_t k = 0; k < 3; ++k) {
          const auto i = static_cast<std::size_t>(index[k]);
          Frame frame;
          frame.normal = p[i].normalized();
          frame.tangent = (u - frame.normal * frame.normal.dot(u)).normalized();
          frame.bitangent = frame.normal.cross(frame.tangent);
          triangle.corners[k] = {p[i], frame, uv[i]};
        }
        surface.triangles.push_back(triangle);
      }
    }
  }
  return surface;
}

TEST(BasisNormal, IsTheFramesCombination) {
  const Frame frame = frame_of(Vec3(1, 2, 3));
  const Vec3 b = rnm_set().directions[1].direction;
  const Vec3 n = basis_normal(frame, b);
  EXPECT_NEAR(n.length(), 1, 1e-6);
  EXPECT_NEAR(n.dot(frame.tangent), b.x, 1e-6);
  EXPECT_NEAR(n.dot(frame.bitangent), b.y, 1e-6);
  EXPECT_NEAR(n.dot(frame.normal), b.z, 1e-6);
  EXPECT_EQ(basis_normal(frame, Vec3(0, 0, 1)), frame.normal.normalized());
}

TEST(FaceAxes, AreOrthonormalToTheFace) {
  std::mt19937 random(3);
  std::normal_distribution<float> normal;
  for (int i = 0; i < 1000; ++i) {
    const Vec3 n = Vec3(normal(random), normal(random), normal(random)).normalized();
    const FaceAxes axes = face_axes(n);
    for (const float dot : {axes.t1.dot(n), axes.t2.dot(n), axes.t1.dot(axes.t2)}) ASSERT_NEAR(dot, 0, 1e-6);
    ASSERT_NEAR(axes.t1.cross(axes.t2).dot(n), 1, 1e-6);
  }
}

TEST(RaiseAbove, LeavesWhatIsHighEnough) {
  const Vec3 n = Vec3(1, 0, 1).normalized();
  EXPECT_EQ(raise_above(n, Vec3(0, 0, 1), sine_of(1)), n.normalized());
}

TEST(RaiseAbove, RaisesTheRestToTheConeInTheSamePlane) {
  const Vec3 up(0, 0, 1);
  const Vec3 raised = raise_above(Vec3(1, 1, -5), up, sine_of(1));
  EXPECT_NEAR(raised.z, sine_of(1), 1e-6);
  EXPECT_NEAR(raised.length(), 1, 1e-6);
  EXPECT_NEAR(raised.x, raised.y, 1e-6);
  EXPECT_GT(raised.x, 0);
}

TEST(RaiseAbove, FindsAWayOutOfTheOppositeOfTheFace) {
  const Vec3 raised = raise_above(Vec3(0, 0, -1), Vec3(0, 0, 1), sine_of(1));
  EXPECT_NEAR(raised.z, sine_of(1), 1e-6);
  EXPECT_NEAR(raised.length(), 1, 1e-6);
}

TEST(RaiseAbove, ConeIsConvex) {
  std::mt19937 random(4);
  std::normal_distribution<float> normal;
  std::uniform_real_distribution<float> uniform(0, 1);
  const auto direction = [&] { return Vec3(normal(random), normal(random), normal(random)).normalized(); };
  for (int i = 0; i < 1000; ++i) {
    const Vec3 face = direction();
    const Vec3 a = raise_above(direction(), face, sine_of(1)), b = raise_above(direction(), face, sine_of(1));
    const float t = uniform(random);
    ASSERT_GE((a * t + b * (1 - t)).normalized().dot(face), sine_of(1) - 1e-5F);
  }
}

TEST(ReceiverPasses, OfAPlaneAreOneForEachBasis) {
  const ReceiverPasses passes =
      make_receiver_passes(flat_square(), flat_and_rnm().directions, Horizon::identity);
  ASSERT_EQ(passes.passes.size(), 4U);
  EXPECT_EQ(count(passes, Role::basis), 4U);
  for (std::size_t b = 0; b < 4; ++b) {
    EXPECT_EQ(passes.passes[b].basis, b);
    ASSERT_EQ(passes.passes[b].corners.size(), 6U);
    EXPECT_NEAR(uv_area(passes.passes[b]), 1, 1e-6);
    for (const ReceiverCorner& corner : passes.passes[b].corners)
      EXPECT_LT((corner.normal - flat_and_rnm().directions[b].direction).length(), 1e-5);
  }
  EXPECT_EQ(passes.counts.corners, 24U);
  EXPECT_EQ(passes.counts.corners_below, 0U);
  EXPECT_EQ(passes.counts.triangles, 2U);
  EXPECT_EQ(passes.counts.triangles_below, 0U);
}

TEST(ReceiverPasses, OfASmoothCubeNeedTheIdentity) {
  const Surface cube = smooth_cube();
  const auto bases = flat_and_rnm().directions;
  std::size_t below = 0, triangles = 0;
  for (const SurfaceTriangle& triangle : cube.triangles) {
    std::size_t here = 0;
    for (const BasisDirection& basis : bases)
      for (const SurfaceCorner& corner : triangle.corners)
        here += basis_normal(corner.frame, basis.direction).dot(triangle.normal) < 0 ? 1 : 0;
    below += here;
    triangles += here > 0 ? 1 : 0;
  }
  ASSERT_GT(below, 0U);
  const ReceiverPasses passes = make_receiver_passes(cube, bases, Horizon::identity);
  EXPECT_EQ(passes.counts.corners, 12U * 3 * 4);
  EXPECT_EQ(passes.counts.corners_below, below);
  EXPECT_EQ(passes.counts.triangles, 12U);
  EXPECT_EQ(passes.counts.triangles_below, triangles);
  EXPECT_EQ(find(passes, Role::below, 0), nullptr);  // the flat bake never falls below
  EXPECT_EQ(count(passes, Role::moment), 5U);
  for (std::size_t m = 0; m < 5; ++m) EXPECT_EQ(find(passes, Role::moment, m)->corners.size(), 3 * triangles);
}

TEST(ReceiverPasses, AreLegalForCyclesEverywhere) {
  const Surface cube = smooth_cube();
  for (const Horizon horizon : {Horizon::identity, Horizon::clamp}) {
    const ReceiverPasses passes = make_receiver_passes(cube, flat_and_rnm().directions, horizon);
    for (const ReceiverPass& pass : passes.passes) {
      const float least = sine_of(0.05) - 1e-5F;
      for (std::size_t i = 0; i < pass.corners.size(); i += 3) {
        const auto* k = &pass.corners[i];
        const Vec3 across = (k[1].position - k[0].position).cross(k[2].position - k[0].position);
        if (across.length() < 1e-5F) continue;  // a sliver at the cut: no texel fits into it
        const Vec3 face = across.normalized();
        for (std::size_t c = 0; c < 3; ++c) {
          ASSERT_GE(k[c].normal.dot(face), least);
          ASSERT_NEAR(k[c].normal.length(), 1, 1e-5);
        }
      }
    }
  }
}

TEST(ReceiverPasses, ClampNeedsNothingElse) {
  const ReceiverPasses passes =
      make_receiver_passes(smooth_cube(), flat_and_rnm().directions, Horizon::clamp);
  EXPECT_EQ(passes.passes.size(), 4U);
  EXPECT_GT(passes.counts.corners_below, 0U);
  for (const ReceiverPass& pass : passes.passes) EXPECT_EQ(pass.corners.size(), 36U);
}

TEST(ReceiverPasses, AreNotDividedFinerThanTheMapShows) {
  const auto corners = [](const Vec2& map) {
    std::size_t total = 0;
    for (const ReceiverPass& pass :
         make_receiver_passes(smooth_cube(), flat_and_rnm().directions, Horizon::identity, map).passes)
      if (pass.role != Role::moment) total += pass.corners.size();
    return total;
  };
  const std::size_t fine = corners(Vec2(4096)), coarse = corners(Vec2(0.25F));
  EXPECT_LT(coarse, fine / 4);
  EXPECT_GE(coarse, 4U * 36);  // what is cut still has all its parts
}

TEST(ReceiverPasses, CutAtTheHorizonCoverTheTriangleOnce) {
  std::mt19937 random(5);
  std::normal_distribution<float> normal;
  std::uniform_real_distribution<float> uniform(0, 1);
  int cut = 0;
  for (int i = 0; i < 300; ++i) {
    std::array<Vec3, 3> normals;
    for (Vec3& n : normals) n = Vec3(normal(random), normal(random), std::abs(normal(random)) + 0.05F);
    Surface surface;
    surface.triangles.push_back(
        floor_triangle({Vec2(uniform(random), uniform(random)), Vec2(uniform(random), uniform(random)),
                        Vec2(uniform(random), uniform(random))},
                       normals));
    const ReceiverPasses passes = make_receiver_passes(surface, flat_and_rnm().directions, Horizon::identity);
    const auto& k = surface.triangles[0].corners;
    const ReceiverCorner whole[] = {{{}, {}, k[0].uv}, {{}, {}, k[1].uv}, {{}, {}, k[2].uv}};
    for (std::size_t b = 0; b < 4; ++b) {
      const ReceiverPass* below = find(passes, Role::below, b);
      const double above_area = uv_area(*find(passes, Role::basis, b));
      const double below_area = below != nullptr ? uv_area(*below) : 0;
      ASSERT_NEAR(above_area + below_area, uv_area(whole), 1e-5);
      cut += above_area > 1e-3 && below_area > 1e-3 ? 1 : 0;
    }
  }
  EXPECT_GT(cut, 50);  // the sample holds the case that it is about
}

TEST(ReceiverPasses, AreClippedToTheUnitSquare) {
  Surface surface;
  surface.triangles.push_back(floor_triangle({Vec2(-1, -1), Vec2(3, -1), Vec2(-1, 3)},
                                             {Vec3(0, 0, 1), Vec3(0, 0, 1), Vec3(0, 0, 1)}));
  const ReceiverPasses passes = make_receiver_passes(surface, {flat_direction()}, Horizon::identity);
  EXPECT_NEAR(uv_area(passes.passes[0]), 1, 1e-5);
  for (const ReceiverCorner& corner : passes.passes[0].corners) {
    for (int axis = 0; axis < 2; ++axis) {
      EXPECT_GE(corner.uv[axis], -1e-6);
      EXPECT_LE(corner.uv[axis], 1 + 1e-6);
      EXPECT_NEAR(corner.uv[axis], corner.position[axis], 1e-5);
    }
  }
}

TEST(ReceiverPasses, OfATriangleOutsideTheUnitSquareAreEmpty) {
  Surface surface;
  surface.triangles.push_back(
      floor_triangle({Vec2(2, 2), Vec2(3, 2), Vec2(2, 3)}, {Vec3(0, 0, 1), Vec3(0, 0, 1), Vec3(0, 0, 1)}));
  EXPECT_TRUE(make_receiver_passes(surface, {flat_direction()}, Horizon::identity).passes[0].corners.empty());
}

}  // namespace
}  // namespace rnmbake
