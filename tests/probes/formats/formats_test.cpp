#include "probes/formats/formats.h"

#include "base/error.h"
#include "base/files.h"
#include "encoding/sh.h"
#include "probes/formats/engine_box.h"
#include "probes/formats/sample_volumes.h"

#include <functional>
#include <random>
#include <set>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

TEST(EngineBox, TurnedHarmonicsAreThoseOfTurnedLight) {
  std::mt19937 random(1);
  std::normal_distribution<float> number;
  for (const EngineAxes& axes : {y_up_axes(), unity_axes()}) {
    std::array<Vec3, 9> harmonics;
    for (Vec3& one : harmonics) one = Vec3(number(random), number(random), number(random));
    const auto found = turned(axes, harmonics);
    for (int i = 0; i < 20; ++i) {
      const Vec3 normal = unit(Vec3(number(random), number(random), number(random)));
      const Vec3 expected = irradiance_of(harmonics, normal);
      const Vec3 light = irradiance_of(found, to_engine(axes, normal));
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(light[c], expected[c], 2e-6);
      EXPECT_NEAR((from_engine(axes, to_engine(axes, normal)) - normal).length(), 0, 1e-7);
    }
  }
}

/// Boxes in all orders and directions of their axes, mirrored ones among them, turned ones and sheared ones:
/// places of the probes stay what they are, steps keep the engine's handedness.
TEST(EngineBox, ProbesKeepTheirPlaces) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> number(-1, 1);
  for (int trial = 0; trial < 200; ++trial) {
    ProbeGrid grid;
    grid.counts = {2, 3, 4};
    grid.first = {number(random), number(random), number(random)};
    const double shear = trial % 2 == 0 ? 0 : 1;
    for (std::size_t k = 0; k < 3; ++k) {
      grid.steps[k] = Vec3d(number(random), number(random), number(random)) * shear;
      grid.steps[k][static_cast<int>((k + static_cast<std::size_t>(trial)) % 3)] +=
          (number(random) < 0 ? -1 : 1) * (2 + double(k));
    }
    const ProbeVolume volume = sample_box("box", grid, false);
    for (const EngineAxes& axes : {y_up_axes(), unity_axes()}) {
      const EngineBox box = engine_box(volume, axes, "a format");
      EXPECT_GT(box.steps[0].dot(box.steps[1].cross(box.steps[2])), 0);
      EXPECT_TRUE(shear > 0 || box.along_axes());
      std::set<std::size_t> seen;
      for (int z = 0; z < box.counts[2]; ++z) {
        for (int y = 0; y < box.counts[1]; ++y) {
          for (int x = 0; x < box.counts[0]; ++x) {
            const std::size_t index = box.index(x, y, z);
            ASSERT_LT(index, volume.probes.size());
            seen.insert(index);
            const Vec3d place = box.first + box.steps[0] * x + box.steps[1] * y + box.steps[2] * z;
            EXPECT_LT((place - to_engine(axes, volume.probes[index].position)).length(), 1e-12);
          }
        }
      }
      EXPECT_EQ(seen.size(), volume.probes.size());
    }
  }
}

TEST(EngineBox, RotationsTurnTheAxesToTheSteps) {
  std::mt19937 random(3);
  std::normal_distribution<double> number;
  for (int trial = 0; trial < 100; ++trial) {
    EngineBox box{};
    box.counts = {2, 2, 2};
    box.steps[0] = Vec3d(number(random), number(random), number(random));
    box.steps[2] = box.steps[0].cross(Vec3d(number(random), number(random), number(random)));
    box.steps[1] = box.steps[2].cross(box.steps[0]);
    ASSERT_TRUE(box.right_angled());
    const auto q = box.rotation();
    const Vec3d u(q[0], q[1], q[2]);
    for (int axis = 0; axis < 3; ++axis) {
      Vec3d v(0);
      v[axis] = 1;
      const Vec3d turned_axis = v + u.cross(v) * (2 * q[3]) + u.cross(u.cross(v)) * 2.0;
      EXPECT_LT((turned_axis - box.steps[static_cast<std::size_t>(axis)].normalized()).length(), 1e-12);
    }
  }
}

ExitCode code_of(const std::function<void()>& work, std::string* message) {
  try {
    work();
  } catch (const Error& error) {
    *message = error.what();
    return error.code();
  }
  return ExitCode::ok;
}

TEST(ProbeFormats, NamesAreKnownOrGuessed) {
  for (const ProbeFormat& format : probe_formats())
    EXPECT_EQ(&probe_format_named(std::string(format.name)), &format);
  std::string message;
  EXPECT_EQ(code_of([] { static_cast<void>(probe_format_named("bevvy")); }, &message), ExitCode::usage);
  EXPECT_NE(message.find("'bevy'"), std::string::npos) << message;
}

TEST(ProbeFormats, BoxesAlonePassWhereOnlyBoxesFit) {
  const TempFolder folder;
  const std::vector<ProbeVolume> volumes{sample_points()};
  for (const std::string name : {"bevy", "vrc", "godot"}) {
    std::string message;
    EXPECT_EQ(code_of([&] { write_probe_format(name, volumes, folder.path() / name); }, &message),
              ExitCode::unsupported);
    EXPECT_NE(message.find("'two points'"), std::string::npos) << message;
    EXPECT_FALSE(std::filesystem::exists(folder.path() / name));
  }
}

TEST(ProbeFormats, ShearedBoxesAreNamed) {
  ProbeGrid grid;
  grid.counts = {2, 2, 2};
  grid.steps = {Vec3d(1, 0, 0), Vec3d(0.5, 1, 0), Vec3d(0, 0, 1)};
  const std::vector<ProbeVolume> volumes{sample_box("leaning", grid, false)};
  const TempFolder folder;
  std::string message;
  EXPECT_EQ(code_of([&] { write_probe_format("bevy", volumes, folder.path()); }, &message),
            ExitCode::unsupported);
  EXPECT_NE(message.find("'leaning'"), std::string::npos) << message;
}

}  // namespace
}  // namespace rnmbake
