#include "trace/recipe.h"

#include "trace/trace_scenes.h"

#include <cmath>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

RecipeFaults all_faults(const std::string& version) {
  RecipeFaults faults;
  faults.tilt_clamp = version == "3.4.1";
  faults.bump_shadowing = faults.self_reflection = faults.below_horizon = true;
  return faults;
}

GatherOptions recipe_options(const std::string& version, int samples) {
  GatherOptions options = all_directions(samples);
  options.footprint = Footprint::centre;
  options.faults = all_faults(version);
  options.blender_version = version;
  return options;
}

constexpr double four_digits = 5e-5 + 1e-5;  // what rounding to them takes, and floats

/// The mean of a direction's map is `truth`, but for four standard errors and what rounding took.
void expect_mean(const GatheredDirection& found, double truth, const std::string& version) {
  EXPECT_NEAR(found.mean[0], truth, 4 * found.mean_error[0] + four_digits) << version;
}

/// What each Blender's bake of the recipe gives (docs/accuracy.md), basis rnm0, sun in the plane of x and z.
TEST(Recipe, SunsComeOutAsInEachBlender) {
  struct Row {
    std::string version;
    std::array<double, 5> values;  // at 0, 54.74, 70, 80, 85 degrees
  };
  const std::array<double, 5> angles{0, 54.7356, 70, 80, 85};
  for (const Row& row : {Row{"3.4.1", {0.7106, 0.9297, 0.6011, 0.2956, 0.1392}},
                         Row{"4.3.2", {0.5773, 1.0000, 0.7328, 0.3675, 0.1727}},
                         Row{"5.2.2", {0.5773, 0.8990, 0.7148, -1, 0.2540}}}) {
    for (std::size_t i = 0; i < angles.size(); ++i) {
      if (row.values[i] < 0) continue;
      DiffuseScene scene;
      add_object(scene, "floor", {level(1, 0)}, Vec3(0.5F));
      LightInfo sun = light("SUN", 1, {{"angle", 0}});
      const double angle = angles[i] * pi / 180;
      sun.to_world.setAxisAngle(Vec3d(0, 1, 0), angle);  // the sun shines along -z of its own axes
      scene.survey.lights.push_back(sun);
      const Gathered gathered = gather_one(scene, 0, recipe_options(row.version, 16), 2, 2);
      EXPECT_NEAR(gathered.directions[1].mean[0] * pi, row.values[i], four_digits)
          << row.version << " at " << angles[i];
      EXPECT_NEAR(gathered.directions[0].mean[0] * pi, std::cos(angle), four_digits);
    }
  }
}

TEST(Recipe, UniformSkyComesOutAsInEachBlender) {
  for (const auto& [version, value] : {std::pair{"3.4.1", 0.7416}, {"4.3.2", 0.6847}, {"5.2.2", 0.6330}}) {
    DiffuseScene scene;
    add_object(scene, "floor", {level(1, 0)}, Vec3(0.5F));
    scene.world.radiance = Vec3(1);
    const Gathered gathered = gather_one(scene, 0, recipe_options(version, 1 << 14), 4, 4);
    EXPECT_LT(gathered.directions[1].mean_error[0], 5e-4) << "the test is too weak";
    expect_mean(gathered.directions[1], value, version);
    expect_mean(gathered.directions[0], 1, version);
  }
}

/// Self-reflection: expected without it is 3.9434.
TEST(Recipe, FurnaceComesOutAsInEachBlender) {
  for (const auto& [version, value] : {std::pair{"3.4.1", 1.9187}, {"4.3.2", 1.5167}, {"5.2.2", 1.2841}}) {
    DiffuseScene scene;
    add_object(scene, "room", room(1), Vec3(0.8F), Vec3(1));
    const Gathered gathered = gather_one(scene, 0, recipe_options(version, 1 << 12), 12, 2);
    EXPECT_LT(gathered.directions[1].mean_error[0], 0.0035 * value) << "the test is too weak";
    expect_mean(gathered.directions[1], value, version);
    expect_mean(gathered.directions[0], 5, version);
  }
}

/// Smooth normals: those of a sphere about `middle`, on its inside if `side` is -1.
void make_smooth(Mesh& mesh, const Vec3& middle, float side) {
  for (std::size_t k = 0; k < mesh.loop_normal.size(); ++k) {
    mesh.loop_normal[k] = ((mesh.positions[mesh.loop_vertex[k]] - middle) * side).normalized();
  }
}

void add_sun(DiffuseScene& scene, double degrees) {
  LightInfo sun = light("SUN", 1, {{"angle", 0}});
  sun.to_world.setAxisAngle(Vec3d(0, 1, 0), degrees * pi / 180);  // from the zenith towards +x
  scene.survey.lights.push_back(sun);
}

double flat_mean(const DiffuseScene& scene, bool from_below, int samples = 64) {
  GatherOptions options = recipe_options("4.3.2", samples);
  options.faults.self_reflection = false;
  options.faults.below_horizon = from_below;
  return gather_one(scene, 0, options, 16, 16).directions[0].mean[0];
}

TEST(Recipe, LightFromBelowComesWhereTheSurfaceBulges) {
  DiffuseScene scene;
  add_object(scene, "square", {level(1, 0)}, Vec3(0.5F));
  make_smooth(scene.survey.meshes[0], Vec3(0, 0, -3), 1);
  add_sun(scene, 91);
  EXPECT_EQ(flat_mean(scene, false), 0);
  EXPECT_GT(flat_mean(scene, true) * pi, 0.01);
}

/// Cycles does not pass by the face that a ray starts from where it is shaded smooth.
TEST(Recipe, NoLightFromBelowComesThroughAShell) {
  DiffuseScene scene;
  add_object(scene, "room", room(1), Vec3(0.5F));
  make_smooth(scene.survey.meshes[0], Vec3(0), -1);
  for (const double degrees : {0, 30, 50}) add_sun(scene, degrees);
  EXPECT_EQ(flat_mean(scene, true), 0);
}

/// Cycles leaves a sky that is the same everywhere to chance, which finds none of it under the face.
TEST(Recipe, AnEvenSkyGivesNoLightFromBelow) {
  DiffuseScene scene;
  add_object(scene, "square", {level(1, 0)}, Vec3(0.5F));
  make_smooth(scene.survey.meshes[0], Vec3(0, 0, -3), 1);
  scene.world.radiance = Vec3(1);
  EXPECT_NEAR(flat_mean(scene, true, 1024), flat_mean(scene, false, 1024), 1e-3);
}

TEST(Recipe, WhatReflectsNothingBakesBlack) {
  DiffuseScene scene;
  add_object(scene, "floor", {level(1, 0)}, Vec3(0));
  scene.world.radiance = Vec3(1);
  GatherOptions options = recipe_options("4.3.2", 16);
  EXPECT_GT(gather_one(scene, 0, options, 4, 4).directions[0].mean[0], 0.9);
  options.faults.no_diffuse = true;
  EXPECT_EQ(gather_one(scene, 0, options, 4, 4).directions[0].mean[0], 0);
}

/// Cycles divides what a surface sends back by its albedo, colour by colour.
TEST(Recipe, ColorsThatASurfaceLacksAreTheMeanOfTheOthers) {
  DiffuseScene scene;
  const std::vector<Vec3> albedos{Vec3(0.5F, 0.5F, 0), Vec3(0, 0, 0.01F)};
  for (std::size_t i = 0; i < albedos.size(); ++i)
    add_object(scene, "floor", {level(1, 0, true, Vec3(float(i) * 5, 0, 0))}, albedos[i]);
  // The third floor's texels are yellow on the left and white on the right.
  add_object(scene, "picture", {level(1, 0, true, Vec3(10, 0, 0))}, Vec3(0));
  scene.pictures.push_back({2, 1, {Vec3(0.5F, 0.5F, 0), Vec3(0.5F)}});
  scene.picture_uvs.push_back(scene.survey.meshes[2].uv_layers[0].uv);
  scene.materials[2].albedo_picture = scene.materials[2].picture_uv = 0;
  scene.world.radiance = Vec3(1, 2, 4);
  GatherOptions options = recipe_options("4.3.2", 64);
  options.faults.no_diffuse = true;
  const auto texel = [&](std::size_t object, int x) {
    const auto colors = gather_one(scene, object, options, 8, 8).directions[0].radiance.texel(x, 4);
    return Vec3(colors[0], colors[1], colors[2]);
  };
  const auto expect = [](const Vec3& found, const Vec3& relative) {
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(found[c], relative[c] * found[relative.x > 0 ? 0 : 2], 1e-5F) << c;
  };
  expect(texel(0, 4), {1, 2, 1.5F});
  expect(texel(1, 4), {1, 1, 1});
  EXPECT_NEAR(texel(1, 4).x, 4, 0.2);
  expect(texel(2, 0), {1, 2, 1.5F});
  expect(texel(2, 7), {1, 2, 4});
}

/// A floor, its left half black, under a ceiling that sends the sky's light down to it.
DiffuseScene half_black_floor() {
  DiffuseScene scene;
  const auto half = [](float from, float to) {
    return Quad{Vec3(from, -1, 0), Vec3(to, -1, 0), Vec3(to, 1, 0), Vec3(from, 1, 0)};
  };
  add_object(scene, "floor", {half(-1, 0), half(0, 1)}, Vec3(0));
  add_object(scene, "ceiling", {level(1, 1, false)}, Vec3(0.8F));
  scene.world.radiance = Vec3(1);
  SurfaceMaterial white = scene.materials[0];
  white.albedo = Vec3(0.5F);
  scene.object_materials[0].push_back(static_cast<int>(scene.materials.size()));
  scene.materials.push_back(white);
  scene.survey.objects[0].slots.emplace_back("white");
  scene.survey.meshes[0].polygon_slot[1] = 1;
  return scene;
}

TEST(Recipe, BlackTexelsTakeNothingFromTheirNeighbours) {
  const DiffuseScene scene = half_black_floor();
  constexpr int width = 8, height = 4;  // one block of texels
  GatherOptions options = recipe_options("4.3.2", 1 << 12);
  options.faults = {};
  const Gathered all = gather_one(scene, 0, options, width, height);
  options.faults.no_diffuse = true;
  options.seed = 1;
  const Gathered some = gather_one(scene, 0, options, width, height);
  double difference = 0, square = 0;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      EXPECT_EQ(some.coverage.texel(x, y)[0], 1);
      if (x < width / 2) {
        EXPECT_EQ(some.directions[0].radiance.texel(x, y)[0], 0);
        EXPECT_EQ(some.validity.texel(x, y)[0], 1);
        continue;
      }
      difference += some.directions[0].radiance.texel(x, y)[0] - all.directions[0].radiance.texel(x, y)[0];
      for (const Gathered* one : {&some, &all})
        square += std::pow(one->directions[0].standard_error.texel(x, y)[0], 2);
    }
  }
  EXPECT_LT(std::abs(difference), 4 * std::sqrt(square));
  EXPECT_LT(std::sqrt(square), 0.003 * width / 2 * height);
}

}  // namespace
}  // namespace rnmbake
