// Surfaces that let light through: closed forms, and estimators that must agree.
#include "trace/gather.h"
#include "trace/moments.h"
#include "trace/trace_scenes.h"
#include "trace/transparency.h"
#include "trace/view.h"

#include <array>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

const Vec3 tint(0.5F, 0.25F, 0.75F);

void add_sheet(DiffuseScene& scene, const std::vector<Quad>& quads, const Vec3& transmittance,
               const Vec3& albedo = Vec3(0), const Vec3& emission = Vec3(0)) {
  add_object(scene, "sheet " + std::to_string(scene.survey.objects.size()), quads, albedo, emission);
  scene.materials.back().transmittance = transmittance;
}

/// The same surface of many quads.
std::vector<Quad> split(const std::vector<Quad>& quads, int across) {
  std::vector<Quad> pieces;
  for (const Quad& quad : quads) {
    const auto at = [&](int x, int y) {
      const float u = float(x) / float(across), v = float(y) / float(across);
      return quad[0] * ((1 - u) * (1 - v)) + quad[1] * (u * (1 - v)) + quad[2] * (u * v) +
             quad[3] * ((1 - u) * v);
    };
    for (int x = 0; x < across; ++x) {
      for (int y = 0; y < across; ++y)
        pieces.push_back({at(x, y), at(x + 1, y), at(x + 1, y + 1), at(x, y + 1)});
    }
  }
  return pieces;
}

/// A floor that reflects nothing, and every kind of light above it.
DiffuseScene lit_floor() {
  DiffuseScene scene;
  add_object(scene, "floor", {level(0.5F, 0)}, Vec3(0));
  add_object(scene, "lamp", {level(0.5F, 3, false)}, Vec3(0), Vec3(4, 2, 1));
  LightInfo sun = light("SUN", 2, {{"angle", 0.1}});
  sun.to_world = Mat44(1, 0, 0, 0, 0, 0.8F, 0.6F, 0, 0, -0.6F, 0.8F, 0, 0, 0, 0, 1);
  LightInfo area = light("AREA", 20, {{"size", 1}, {"size_y", 1}});
  area.shape = "SQUARE";
  area.to_world[3][2] = 2.5F;
  scene.survey.lights = {sun, area};
  scene.world.radiance = Vec3(0.2F, 0.3F, 0.4F);
  return scene;
}

/// Every texel has `share` of what it has in `open`, but for rounding.
void expect_scaled(const DiffuseScene& open, const DiffuseScene& covered, const Vec3& share) {
  const Gathered before = gather_one(open, 0, all_directions(16)),
                 after = gather_one(covered, 0, all_directions(16));
  for (std::size_t k = 0; k < before.directions.size(); ++k) {
    const FloatImage &a = before.directions[k].radiance, &b = after.directions[k].radiance;
    for (int y = 0; y < a.height(); ++y) {
      for (int x = 0; x < a.width(); ++x) {
        for (std::size_t c = 0; c < 3; ++c) {
          const float expected = a.texel(x, y)[c] * share[int(c)];
          EXPECT_GT(expected, 0);
          ASSERT_NEAR(b.texel(x, y)[c], expected, 2e-5 * expected) << k << ": " << x << " " << y << " " << c;
        }
      }
    }
  }
}

TEST(SeeThrough, BlackSheetsScaleAllLightByTheirTransmittance) {
  DiffuseScene covered = lit_floor();
  add_sheet(covered, room(1), tint);
  expect_scaled(lit_floor(), covered, tint);
}

TEST(SeeThrough, SheetsMultiply) {
  DiffuseScene covered = lit_floor();
  add_sheet(covered, room(1), tint);
  add_sheet(covered, room(1.5F), tint);
  add_sheet(covered, split(room(2), 24), Vec3(0.5F));
  expect_scaled(lit_floor(), covered, tint * tint * 0.5F);
}

TEST(SeeThrough, CommonEdgesCountOnce) {
  DiffuseScene scene;
  add_sheet(scene, {level(1, 1)}, tint);
  const TraceScene traced(scene, "4.3.2");
  for (const float along : {0.0F, 0.25F, -0.5F}) {  // the quad's diagonal
    const Visibility left = traced.visibility({{along, along, -1}, {0, 0, 1}, 2});
    EXPECT_EQ(left.transmittance, tint);
    EXPECT_EQ(left.transmit_probability, 1) << "black";
  }
}

TEST(SeeThrough, PicturesCutHoles) {
  DiffuseScene scene;
  add_object(scene, "floor", {level(0.5F, 0)}, Vec3(0));
  scene.survey.lights = {light("SUN", 2, {{"angle", 0}})};
  add_sheet(scene, {level(0.5F, 1)}, Vec3(0));
  Texture mask{4, 4, std::vector<Vec3>(16, Vec3(0)), "mask"};
  for (std::size_t i = 0; i < 16; ++i) mask.texels[i] = i % 4 < 2 ? tint : Vec3(0);  // the left half
  scene.pictures.push_back(mask);
  scene.picture_uvs.push_back(scene.survey.meshes.back().uv_layers[0].uv);
  scene.materials.back().transmittance_picture = scene.materials.back().picture_uv = 0;
  GatherOptions centre = all_directions(4);
  centre.footprint = Footprint::centre;
  const Gathered masked = gather_one(scene, 0, centre, 4, 4);
  for (int y = 0; y < 4; ++y) {
    for (std::size_t c = 0; c < 3; ++c) {
      EXPECT_NEAR(masked.directions[0].radiance.texel(0, y)[c], 2 / pi * double(tint[int(c)]), 1e-5);
      EXPECT_EQ(masked.directions[0].radiance.texel(3, y)[c], 0);
    }
  }
}

/// A room in which everything has the radiance (1, 2, 3), whatever its albedo and transmittance.
DiffuseScene partitioned_furnace() {
  const Vec3 radiance(1, 2, 3), one(1);
  DiffuseScene scene;
  const Vec3 wall(0.5F, 0.4F, 0.3F);
  add_object(scene, "room", room(1), wall, radiance * (one - wall));
  const auto put = [&](const Quad& quad, const Vec3& through, const Vec3& albedo) {
    add_sheet(scene, {quad}, through, albedo, radiance * (one - through - albedo));
  };
  put({Vec3(-1, -1, 0.1F), Vec3(1, -1, 0.1F), Vec3(1, 1, 0.4F), Vec3(-1, 1, 0.4F)}, {0.7F, 0.3F, 0.1F},
      {0.2F, 0.5F, 0.1F});
  put({Vec3(-0.9F, 0.5F, -0.9F), Vec3(0.9F, 0.3F, -0.9F), Vec3(0.9F, 0.3F, 0.8F), Vec3(-0.9F, 0.5F, 0.8F)},
      {0.1F, 0.2F, 0.6F}, {0.6F, 0.1F, 0.4F});
  put(level(0.6F, -0.5F), {0.9F, 0.9F, 0.9F}, {0, 0, 0.1F});
  return scene;
}

/// Mean over directions and colours of the relative error, over seeds.
Moments errors(const DiffuseScene& scene, GatherOptions options, int seeds) {
  Moments all;
  for (int seed = 0; seed < seeds; ++seed) {
    options.seed = static_cast<std::uint64_t>(seed);
    const Gathered gathered = gather_one(scene, 0, options);
    double sum = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      for (std::size_t c = 0; c < 3; ++c)
        sum += gathered.directions[k].mean[c] / (double(c + 1) * (k == 0 ? 1 : sky_share)) - 1;
    }
    all.add(sum / 12);
  }
  return all;
}

void expect_unbiased(const Moments& all, double weakest) {
  EXPECT_LT(all.error(), weakest) << "the test is too weak";
  EXPECT_LT(std::abs(all.mean()), 4 * all.error() + 1e-5);
}

TEST(SeeThrough, FurnaceWithPartitions) {
  expect_unbiased(errors(partitioned_furnace(), all_directions(512), 24), 5e-4);
}

TEST(SeeThrough, FurnaceWithPartitionsWithoutSharing) {
  GatherOptions options = all_directions(256);
  options.reuse = false;
  expect_unbiased(errors(partitioned_furnace(), options, 24), 1e-3);
}

TEST(SeeThrough, FurnaceWithPartitionsByChanceAlone) {
  GatherOptions options = all_directions(512);
  options.sample_lights = false;
  expect_unbiased(errors(partitioned_furnace(), options, 24), 1e-3);
}

/// Leaves over a floor: light comes through them, off them, and from one to the other.
DiffuseScene grove() {
  DiffuseScene scene = lit_floor();
  scene.materials[0].albedo = Vec3(0.7F);
  const Vec3 leaf(0.2F, 0.5F, 0.1F), through(0.6F, 0.4F, 0.2F);
  for (int i = 0; i < 6; ++i) {
    const float x = 0.25F * float(i % 3) - 0.4F, y = i < 3 ? -0.3F : 0.1F, z = 0.15F + 0.1F * float(i);
    add_sheet(
        scene,
        {{Vec3(x, y, z), Vec3(x + 0.4F, y, z + 0.1F), Vec3(x + 0.4F, y + 0.4F, z), Vec3(x, y + 0.4F, z)}},
        through, leaf, i == 2 ? Vec3(0.3F) : Vec3(0));
  }
  return scene;
}

TEST(SeeThrough, EstimatorsAgreeUnderLeaves) {
  const DiffuseScene scene = grove();
  GatherOptions options = all_directions(2048);
  const Gathered shared = gather_one(scene, 0, options);
  options.seed = 1;
  options.reuse = false;
  const Gathered alone = gather_one(scene, 0, options);
  options.seed = 2;
  options.sample_bsdf = false;
  const Gathered sampled = gather_one(scene, 0, options);
  for (const Gathered* other : {&alone, &sampled}) {
    for (std::size_t k = 0; k < 4; ++k) {
      for (std::size_t c = 0; c < 3; ++c) {
        const GatheredDirection &a = shared.directions[k], &b = other->directions[k];
        const double error = std::hypot(a.mean_error[c], b.mean_error[c]);
        EXPECT_LT(error, 4e-3 * a.mean[c]) << "the test is too weak";
        EXPECT_LT(std::abs(a.mean[c] - b.mean[c]), 4 * error) << k << " " << c;
      }
    }
  }
}

TEST(SeeThrough, OpacityOneIsOpaque) {
  DiffuseScene opaque = grove(), clear = grove();
  for (std::size_t i = 2; i < opaque.materials.size(); ++i) opaque.materials[i].transmittance = Vec3(0);
  const Gathered before = gather_one(opaque, 0, all_directions(16));
  for (std::size_t i = 2; i < clear.materials.size(); ++i) {  // see-through nowhere, but not known to be so
    clear.materials[i].transmittance = Vec3(0);
    clear.materials[i].transmittance_picture = clear.materials[i].picture_uv = 0;
  }
  clear.pictures.push_back({1, 1, {Vec3(0)}, "black"});
  clear.picture_uvs.push_back(std::vector<Vec2>(4));
  const Gathered after = gather_one(clear, 0, all_directions(16));
  for (std::size_t k = 0; k < 4; ++k)
    EXPECT_EQ(before.directions[k].radiance.data(), after.directions[k].radiance.data()) << k;
}

TEST(SeeThrough, LeavesSeenFromBehindAreNoWalls) {
  DiffuseScene scene;
  add_object(scene, "floor", {level(0.5F, 0)}, Vec3(0.5F));
  add_sheet(scene, {level(20, 1)}, Vec3(0.5F), Vec3(0.5F));  // its back is down
  scene.world.radiance = Vec3(1);
  const Gathered gathered = gather_one(scene, 0, all_directions(16));
  EXPECT_EQ(gathered.validity.texel(4, 4)[0], 1);
}

TEST(SeeThrough, CamerasLookThrough) {
  DiffuseScene scene;
  add_object(scene, "floor", {level(0.5F, 0)}, Vec3(0), Vec3(4));
  add_sheet(scene, {level(20, 1)}, tint, Vec3(0), Vec3(0, 1, 0));
  add_sheet(scene, {level(20, 2)}, Vec3(0.25F), Vec3(0.5F), Vec3(8));
  scene.survey.objects[2].visible_to_camera = false;
  scene.world.radiance = Vec3(1, 1, 2);
  Camera camera;
  camera.to_world.setTranslation(Vec3d(0, 0, 3));
  camera.angle_x = camera.angle_y = 2 * std::atan(0.5);
  camera.resolution_x = camera.resolution_y = 64;
  ViewOptions options;
  options.width = options.height = 30;
  const View view = trace_view(TraceScene(scene, "4.3.2"), camera, options,
                               [](const Vertex&, Sampler&) { return Vec3(0); });
  const auto expect = [&](int x, const Vec3& colour, float coverage) {
    for (std::size_t c = 0; c < 3; ++c)
      EXPECT_NEAR(view.beauty.texel(x, 15)[c], colour[int(c)], 1e-5) << x << " " << c;
    EXPECT_NEAR(view.coverage.texel(x, 15)[0], coverage, 1e-5) << x;
  };
  expect(15, Vec3(0, 1, 0) + tint * 4.0F, 1);
  expect(2, Vec3(0, 1, 0) + tint * Vec3(1, 1, 2), 0.5F);
}

TEST(SeeThrough, CamerasSeeEachSurfaceByItsShare) {
  DiffuseScene scene;
  add_object(scene, "floor", {level(9, 0)}, Vec3(0.5F));
  add_sheet(scene, {level(20, 1)}, tint, Vec3(0.25F));
  Camera camera;
  camera.to_world.setTranslation(Vec3d(0, 0, 3));
  camera.resolution_x = camera.resolution_y = 64;
  ViewOptions options;
  options.width = options.height = 32;
  options.samples = 256;
  const TraceScene traced(scene, "4.3.2");
  const View view = trace_view(traced, camera, options, [](const Vertex& vertex, Sampler&) {
    return vertex.position.z > 0 ? Vec3(1, 2, 3) : Vec3(3, 1, 2);
  });
  for (std::size_t c = 0; c < 3; ++c) {
    Moments beauty, albedo;
    for (int y = 0; y < 32; ++y) {
      for (int x = 0; x < 32; ++x) {
        beauty.add(view.beauty.texel(x, y)[c]);
        albedo.add(view.albedo.texel(x, y)[c]);
      }
    }
    const double seen = double(Vec3(1, 2, 3)[int(c)]) + double(tint[int(c)] * Vec3(3, 1, 2)[int(c)]);
    // Where the shares are whole parts of the samples there is no noise, but floats.
    EXPECT_LT(beauty.error(), 0.005 * seen) << "the test is too weak";
    EXPECT_NEAR(beauty.mean(), seen, 4.5 * beauty.error() + 1e-5) << c;
    EXPECT_NEAR(albedo.mean(), 0.25 + 0.5 * double(tint[int(c)]), 4.5 * albedo.error() + 1e-5) << c;
  }
}

}  // namespace
}  // namespace rnmbake
