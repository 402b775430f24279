#include "bake/targets.h"

#include "bake/fixture.h"
#include "scene/test_meshes.h"

namespace rnmbake {
namespace {

using Unwrap = ObjectSettings::Unwrap;
using Split = ObjectSettings::Split;

/// A square whose layers have these names; the UVs of those named "empty..." lie in one point.
Mesh with_layers(const std::vector<std::string>& names) {
  Mesh mesh = square();
  for (const std::string& name : names) {
    const bool empty = name.starts_with("empty");
    mesh.uv_layers.push_back({name, empty ? std::vector<Vec2>(6, Vec2(0.5F)) : square_uv()});
  }
  return mesh;
}

UvChoice choose(const std::vector<std::string>& names, const ObjectSettings& settings = {}) {
  return choose_lightmap_uv(with_layers(names), settings, "thing");
}

ObjectSettings settings_with(const std::string& uv, Unwrap unwrap) {
  ObjectSettings settings;
  settings.uv = uv;
  settings.unwrap = unwrap;
  return settings;
}

TEST(LightmapUv, IsTheNamedLayer) {
  EXPECT_EQ(choose({"UVMap", "Lightmap", "mine"}, settings_with("mine", Unwrap::when_needed)).layer, 2);
}

TEST(LightmapUv, FollowsTheConventionalNames) {
  EXPECT_EQ(choose({"UVMap", "x", "lightmap"}).layer, 2);
  EXPECT_EQ(choose({"UVMap", "lightmap", "UV2"}).layer, 2);
  EXPECT_EQ(choose({"UV2", "UVMap", "Lightmap"}).layer, 2);
  EXPECT_EQ(choose({"Lightmap"}).layer, 0);
}

TEST(LightmapUv, IsElseTheSecondLayer) {
  EXPECT_EQ(choose({"UVMap", "other", "third"}).layer, 1);
}

TEST(LightmapUv, IsElseToBeUnwrapped) {
  EXPECT_FALSE(choose({"UVMap"}).layer);
  EXPECT_EQ(choose({"UVMap"}).reason, "no lightmap UV layer");
  EXPECT_FALSE(choose({}).layer);
}

TEST(LightmapUv, WithoutAreaCountsAsAbsent) {
  const UvChoice choice = choose({"UVMap", "empty"});
  EXPECT_FALSE(choice.layer);
  EXPECT_EQ(choice.reason, "layer 'empty' has no area");
}

TEST(LightmapUv, IsUnwrappedWheneverAskedFor) {
  EXPECT_FALSE(choose({"Lightmap"}, settings_with("Lightmap", Unwrap::always)).layer);
}

TEST(LightmapUv, NamedButMissingIsAnErrorThatListsTheOthers) {
  const auto text = error_of(ExitCode::invalid_input, [] {
    (void)choose({"UVMap", "b"}, settings_with("mine", Unwrap::when_needed));
  });
  EXPECT_EQ(
      text,
      "object 'thing' has no UV layer 'mine' (it has 'UVMap', 'b'): name another with --uv, or let it be "
      "unwrapped with --unwrap always");
  EXPECT_NE(
      error_of(ExitCode::invalid_input, [] { (void)choose({}, settings_with("mine", Unwrap::when_needed)); })
          .find("(it has none)"),
      std::string::npos);
}

TEST(LightmapUv, AbsentIsAnErrorWhereUnwrappingIsForbidden) {
  EXPECT_EQ(
      error_of(ExitCode::invalid_input, [] { (void)choose({"UVMap"}, settings_with("", Unwrap::never)); }),
      "object 'thing' has no lightmap UV layer (it has 'UVMap'): name one with --uv, or allow --unwrap auto");
}

TEST(LightmapUv, WithoutAreaIsAnErrorWhereItWasNamedOrUnwrappingForbidden) {
  const std::string expected =
      "UV layer 'empty' of object 'thing' has no area (all UVs in one point or line): unwrap it, or pass "
      "--unwrap always";
  EXPECT_EQ(error_of(ExitCode::invalid_input,
                     [] {
                       (void)choose({"a", "empty"}, settings_with("", Unwrap::never));
                     }),
            expected);
  EXPECT_EQ(error_of(ExitCode::invalid_input,
                     [] {
                       (void)choose({"a", "empty"}, settings_with("empty", Unwrap::when_needed));
                     }),
            expected);
}

TEST(TangentUv, IsTheNamedElseTheRenderElseTheFirstLayer) {
  Mesh mesh = with_layers({"a", "b", "c"});
  ObjectSettings settings;
  EXPECT_EQ(choose_tangent_uv(mesh, settings, "thing"), 0);
  mesh.render_uv = 1;
  EXPECT_EQ(choose_tangent_uv(mesh, settings, "thing"), 1);
  settings.tangent_uv = "c";
  EXPECT_EQ(choose_tangent_uv(mesh, settings, "thing"), 2);
  EXPECT_EQ(choose_tangent_uv(with_layers({}), {}, "thing"), std::nullopt);
}

TEST(TangentUv, NamedButMissingIsAnError) {
  ObjectSettings settings;
  settings.tangent_uv = "z";
  EXPECT_EQ(
      error_of(ExitCode::invalid_input,
               [&] { (void)choose_tangent_uv(with_layers({"a"}), settings, "thing"); }),
      "object 'thing' has no UV layer 'z' for its tangents (it has 'a'): name another with --tangent-uv");
}

TEST(Areas, AreThoseOfTheWorldAndOfTheUvs) {
  Mat44 matrix;
  matrix.setScale(Imath::V3d(3, -2, 1));
  const Areas sum = areas(square(), {0, 1}, square_uv(), matrix);
  EXPECT_NEAR(sum.world, 24, 1e-9);
  EXPECT_NEAR(sum.uv, 1, 1e-9);
  EXPECT_NEAR(areas(square(), {1}, square_uv(), matrix).world, 12, 1e-9);
}

int resolution(int wanted) {
  ObjectSettings settings;
  settings.resolution = wanted;
  return choose_resolution(settings, {1, 1});
}

TEST(Resolution, IsRoundedUpToAMultipleOfFour) {
  EXPECT_EQ(resolution(64), 64);
  EXPECT_EQ(resolution(65), 68);
  EXPECT_EQ(resolution(1), 4);
}

TEST(Resolution, FollowsTheTexelsPerUnit) {
  ObjectSettings settings;
  settings.texels_per_unit = 10;
  EXPECT_EQ(choose_resolution(settings, {4, 1}), 20);
  EXPECT_EQ(choose_resolution(settings, {4, 0.25}), 40);  // the charts fill a quarter: twice the side
  EXPECT_EQ(choose_resolution(settings, {1e9, 1}), settings.max_resolution);
  EXPECT_EQ(choose_resolution(settings, {1e-9, 1}), settings.min_resolution);
  EXPECT_EQ(choose_resolution(settings, {1, 0}), settings.min_resolution);
}

TEST(Resolution, StaysWithinLimitsThatAreNoMultipleOfFour) {
  ObjectSettings settings;
  settings.texels_per_unit = 10;
  settings.min_resolution = 18;
  settings.max_resolution = 30;
  EXPECT_EQ(choose_resolution(settings, {1e9, 1}), 28);
  EXPECT_EQ(choose_resolution(settings, {1e-9, 1}), 20);
}

/// Four triangles over four polygons with these slots; the first two share vertices, the others not.
Mesh with_slots(const std::vector<std::uint32_t>& slots) {
  std::vector<Vec3> positions;
  for (int i = 0; i < 10; ++i) positions.emplace_back(float(i % 3), float(i), 0.0F);
  Mesh mesh =
      triangle_mesh(positions, {0, 1, 2, 2, 1, 3, 4, 5, 6, 7, 8, 9}, std::vector<Vec3>(12, Vec3(0, 0, 1)));
  mesh.polygon_slot = slots;
  return mesh;
}

TEST(SplitMesh, NoneIsTheWholeObject) {
  const auto parts = split_mesh(with_slots({0, 1, 0, 1}), {"red", "green"}, Split::none);
  ASSERT_EQ(parts.size(), 1U);
  EXPECT_EQ(parts[0].name, "");
  EXPECT_EQ(parts[0].triangles, (std::vector<std::uint32_t>{0, 1, 2, 3}));
}

TEST(SplitMesh, ByMaterialNamesPartsAfterMaterialsAndLeavesUnusedSlotsOut) {
  const auto parts = split_mesh(with_slots({0, 2, 0, 3}), {"red", "unused", "", "green"}, Split::material);
  ASSERT_EQ(parts.size(), 3U);
  EXPECT_EQ(parts[0].name, "red");
  EXPECT_EQ(parts[0].triangles, (std::vector<std::uint32_t>{0, 2}));
  EXPECT_EQ(parts[1].name, "slot2");  // no material in it
  EXPECT_EQ(parts[2].name, "green");
}

TEST(SplitMesh, ByMaterialNamesSlotsBeyondTheList) {
  const auto parts = split_mesh(with_slots({0, 0, 0, 5}), {"red"}, Split::material);
  ASSERT_EQ(parts.size(), 2U);
  EXPECT_EQ(parts[1].name, "slot5");
}

TEST(SplitMesh, ByMaterialJoinsSlotsOfOneMaterial) {
  const auto parts = split_mesh(with_slots({0, 1, 2, 0}), {"red", "blue", "red"}, Split::material);
  ASSERT_EQ(parts.size(), 2U);
  EXPECT_EQ(parts[0].name, "red");
  EXPECT_EQ(parts[0].triangles, (std::vector<std::uint32_t>{0, 2, 3}));
  EXPECT_EQ(parts[1].name, "blue");
}

TEST(SplitMesh, LooseNumbersTheParts) {
  const auto parts = split_mesh(with_slots({0, 0, 0, 0}), {}, Split::loose);
  ASSERT_EQ(parts.size(), 3U);
  EXPECT_EQ(parts[0].triangles, (std::vector<std::uint32_t>{0, 1}));
  EXPECT_EQ(parts[2].name, "part2");
}

TEST(InFrame, TurnsTheGreenChannelRound) {
  Target target;
  EXPECT_EQ(in_frame(Vec3(1, 2, 3), target), Vec3(1, 2, 3));
  target.flip_green = true;
  EXPECT_EQ(in_frame(Vec3(1, 2, 3), target), Vec3(1, -2, 3));
}

}  // namespace
}  // namespace rnmbake
