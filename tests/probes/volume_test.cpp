// Volumes: placement, filling, look-up, files.
#include "base/error.h"
#include "base/files.h"
#include "probes/fill_probes.h"
#include "probes/place_probes.h"
#include "probes/volume_file.h"
#include "probes/volume_sampler.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

/// Probes whose light at any normal n is a + n.v, both linear in the place.
LightProbe linear_probe(const Vec3d& place) {
  LightProbe probe;
  probe.position = place;
  const auto x = float(place.x), y = float(place.y), z = float(place.z);
  for (std::size_t k = 0; k < probe_direction_count; ++k) {
    const float along = probe_directions()[k].dot(Vec3(0.1F * y, 0.2F, -0.1F * x));
    probe.irradiance[k] = Vec3(10 + x + along, 10 + 2 * y + along, 10 + 3 * z + along);
  }
  probe.harmonics = harmonics_of(probe.irradiance);
  return probe;
}

ProbeVolume linear_volume() {
  ProbeVolume volume = empty_volume("linear", grid_in({Vec3d(-1, -2, -3), Vec3d(1, 2, 3)}, 1.0));
  for (LightProbe& probe : volume.probes) probe = linear_probe(probe.position);
  return volume;
}

TEST(ProbePlaces, MiddlesOfCells) {
  const ProbeGrid grid = grid_in({Vec3d(0, 0, 0), Vec3d(4, 2, 1)}, 0.9);
  EXPECT_EQ(grid.counts, (std::array{4, 2, 1}));
  EXPECT_EQ(grid.place(0, 0, 0), Vec3d(0.5, 0.5, 0.5));
  EXPECT_EQ(grid.place(3, 1, 0), Vec3d(3.5, 1.5, 0.5));
  const ProbeGrid usual = grid_in({Vec3d(0, 0, 0), Vec3d(20, 10, 5)}, std::nullopt);
  EXPECT_NEAR(double(usual.size()), 1000, 100);
  const ProbeGrid layer = grid_in({Vec3d(0, 0, 1), Vec3d(2, 2, 1)}, 1.0);
  EXPECT_EQ(layer.counts, (std::array{2, 2, 1}));
  EXPECT_EQ(layer.place(1, 1, 0), Vec3d(1.5, 1.5, 1));
}

TEST(ProbePlaces, RefusesWhatIsTooMuch) {
  try {
    (void)grid_in({Vec3d(0), Vec3d(100, 100, 100)}, 0.1);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::invalid_input);
    EXPECT_NE(std::string(error.what()).find("1e+09 probes"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("--spacing"), std::string::npos);
  }
  EXPECT_THROW((void)grid_in({Vec3d(0), Vec3d(0)}, 1.0), Error);
  EXPECT_THROW((void)parse_bounds("1,2,3"), Error);
  EXPECT_THROW((void)parse_bounds("1,2,3,4,5,nan"), Error);
  EXPECT_EQ(parse_bounds("3,2,1,0,5,-1").low, Vec3d(0, 2, -1));
}

/// Blender's own box: the cube from -1 to 1, scaled, turned, moved.
TEST(ProbePlaces, InBlendersBox) {
  Mat44 turn;
  turn.setEulerAngles(Vec3d(0, 0, pi / 2));
  Mat44 scale, move;
  scale.setScale(Vec3d(4, 2, 1));
  move.setTranslation(Vec3d(10, 20, 30));
  const ProbeGrid grid = grid_in_cube(scale * turn * move, {4, 2, 1});
  EXPECT_LT((grid.place(0, 0, 0) - Vec3d(10 + 1, 20 - 3, 30)).length(), 1e-9);
  EXPECT_LT((grid.place(3, 1, 0) - Vec3d(10 - 1, 20 + 3, 30)).length(), 1e-9);
}

TEST(ProbePlaces, PointsOfAList) {
  const TempFolder folder;
  const auto file = folder.path() / "points.csv";
  write_atomically(file, "x,y,z\n1,2,3\n# a note\n\n4; 5; 6\r\n-1e1 0.5 0\n");
  EXPECT_EQ(read_points(file), (std::vector{Vec3d(1, 2, 3), Vec3d(4, 5, 6), Vec3d(-10, 0.5, 0)}));
  for (const char* text : {"1,2,3\n1,2\n", "1,2,3\nnan,0,0\n", "x,y,z\n", "", "1,2,3\n1,2,3x\n"}) {
    write_atomically(file, text);
    EXPECT_THROW((void)read_points(file), Error) << text;
  }
}

/// Each encoding keeps light that is linear in the normal at the axes; harmonics everywhere.
TEST(VolumeSampler, LinearLightIsExact) {
  const ProbeVolume volume = linear_volume();
  const Vec3 slant = unit(Vec3(1, -2, 0.5F));
  for (const Vec3d& place : {Vec3d(0.1, 0.2, 0.3), Vec3d(-0.4, 1.3, 2.2), Vec3d(0.5, -1.5, -2.5)}) {
    const LightProbe truth = linear_probe(place);
    for (const ProbeEncoding encoding : {ProbeEncoding::cube, ProbeEncoding::sh2, ProbeEncoding::sh3}) {
      const VolumeSampler sampler(volume, encoding, LeakTest::none);
      for (std::size_t k = 0; k < 6; ++k) {
        const Vec3 found = sampler.irradiance(place, probe_directions()[k]);
        EXPECT_LT((found - truth.irradiance[k]).length(), 1e-4F) << int(encoding) << ' ' << k;
      }
      if (encoding == ProbeEncoding::cube) continue;
      const Vec3 found = sampler.irradiance(place, slant);
      EXPECT_LT((found - irradiance_of(truth.harmonics, slant)).length(), 1e-4F);
    }
  }
}

TEST(VolumeSampler, ClampsOutside) {
  const ProbeVolume volume = linear_volume();
  const VolumeSampler sampler(volume, ProbeEncoding::cube, LeakTest::none);
  const Vec3 up(0, 0, 1);
  EXPECT_EQ(sampler.irradiance({0.5, 1.5, 100}, up), sampler.irradiance({0.5, 1.5, 2.5}, up));
}

/// Two halves of a box, one dark and one bright, with a wall between the probes that both see.
ProbeVolume halved(int side) {
  ProbeVolume volume = empty_volume("halved", grid_in({Vec3d(-2, -2, -2), Vec3d(2, 2, 2)}, 1.0));
  volume.depths.side = side;
  for (LightProbe& probe : volume.probes) {
    const bool bright = probe.position.x > 0;
    probe.irradiance.fill(Vec3(bright ? 1.0F : 0.0F));
    probe.harmonics = harmonics_of(probe.irradiance);
  }
  return volume;
}

TEST(VolumeSampler, ValidityLeavesOutProbesInsideOfThings) {
  ProbeVolume volume = halved(0);
  for (LightProbe& probe : volume.probes)
    if (probe.position.x < 0) probe.validity = 0.2F;
  const VolumeSampler all(volume, ProbeEncoding::sh3, LeakTest::none),
      open(volume, ProbeEncoding::sh3, LeakTest::validity);
  EXPECT_NEAR(all.irradiance({0, 0, 0}, {0, 0, 1}).x, 0.5, 1e-5);
  EXPECT_NEAR(open.irradiance({0, 0, 0}, {0, 0, 1}).x, 1, 1e-5);
  EXPECT_NEAR(open.irradiance({-1.2, 0, 0}, {0, 0, 1}).x, 0, 1e-5);  // none of the eight is valid
  EXPECT_THROW(VolumeSampler(volume, ProbeEncoding::sh3, LeakTest::visibility), Error);
}

TEST(FillProbes, FromTheNearestOutwards) {
  ProbeVolume volume = empty_volume("row", grid_in({Vec3d(0, 0, 0), Vec3d(5, 1, 1)}, 1.0));
  for (LightProbe& probe : volume.probes) {
    probe.irradiance.fill(Vec3(float(probe.position.x)));
    probe.validity = probe.position.x < 1 || probe.position.x > 4 ? 1 : 0;
  }
  EXPECT_EQ(fill_probes(volume), 3U);
  const float values[] = {0.5F, 0.5F, 2.5F, 4.5F, 4.5F};
  for (std::size_t i = 0; i < 5; ++i) EXPECT_FLOAT_EQ(volume.probes[i].irradiance[3].y, values[i]) << i;
  EXPECT_EQ(volume.probes[2].state, LightProbe::State::filled);
  EXPECT_EQ(volume.probes[2].validity, 0);
  for (LightProbe& probe : volume.probes) probe.validity = 0;
  EXPECT_EQ(fill_probes(volume), 0U);
}

TEST(VolumeFile, ThereAndBack) {
  const TempFolder folder;
  ProbeVolume volume = linear_volume();
  volume.probes[3].validity = 0.25F;
  volume.probes[3].state = LightProbe::State::filled;
  volume.probes[4].standard_error[2] = Vec3(0.5F, 0.25F, 0);
  volume.depths.side = 4;
  for (std::size_t i = 0; i < volume.probes.size() * 16; ++i) {
    volume.depths.mean.push_back(float(i));
    volume.depths.square.push_back(float(i) * 2);
  }
  const ProbeVolume points = empty_volume("some/points", {Vec3d(1, 2, 3), Vec3d(4, 5, 6)});
  write_volumes(folder.path(), {volume, points}, {{"lights", "all"}});
  const StoredVolumes read = read_volumes(folder.path());
  EXPECT_EQ(read.about.at("lights"), "all");
  ASSERT_EQ(read.volumes.size(), 2U);
  const ProbeVolume& back = read.volumes[0];
  EXPECT_EQ(back.name, "linear");
  EXPECT_EQ(back.grid->counts, volume.grid->counts);
  EXPECT_EQ(back.grid->first, volume.grid->first);
  for (std::size_t i = 0; i < volume.probes.size(); ++i) {
    EXPECT_EQ(back.probes[i].irradiance, volume.probes[i].irradiance);
    EXPECT_EQ(back.probes[i].standard_error, volume.probes[i].standard_error);
    EXPECT_EQ(back.probes[i].harmonics, volume.probes[i].harmonics);
    EXPECT_EQ(back.probes[i].position, volume.probes[i].position);
    EXPECT_EQ(back.probes[i].validity, volume.probes[i].validity);
    EXPECT_EQ(back.probes[i].state, volume.probes[i].state);
  }
  EXPECT_EQ(back.depths.mean, volume.depths.mean);
  EXPECT_EQ(back.depths.square, volume.depths.square);
  EXPECT_EQ(read.volumes[1].probes[1].position, Vec3d(4, 5, 6));
  EXPECT_FALSE(read.volumes[1].grid);
}

/// One line that names the file.
void expect_refused(const std::filesystem::path& folder, const std::string& named) {
  try {
    (void)read_volumes(folder);
    ADD_FAILURE() << named;
  } catch (const Error& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find(named), std::string::npos) << text;
    EXPECT_EQ(text.find('\n'), std::string::npos) << text;
  }
}

TEST(VolumeFile, RefusesWhatIsDamaged) {
  const TempFolder folder;
  ProbeVolume volume = linear_volume();
  volume.probes[5].irradiance[1].y = std::numeric_limits<float>::quiet_NaN();
  write_volumes(folder.path(), {volume}, {});
  expect_refused(folder.path(), "linear.exr: the layer 'nx' has values that are no numbers");
  const auto json = folder.path() / "probes.json";
  const std::string text = read_text(json);
  write_volumes(folder.path(), {linear_volume()}, {});
  EXPECT_NO_THROW((void)read_volumes(folder.path()));
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string changed = text;
    changed.replace(changed.find(from), from.size(), to);
    write_atomically(json, changed);
  };
  with("\"probes\": 48", "\"probes\": 47");
  expect_refused(folder.path(), "probes.json: 'linear' has 47 probes");
  with(R"("file": "linear.exr")", R"("file": "../linear.exr")");
  expect_refused(folder.path(), "no plain file name");
  write_atomically(json, text.substr(0, text.size() / 2));
  expect_refused(folder.path(), "probes.json");
  write_atomically(json, text);
  const std::string picture = read_text(folder.path() / "linear.exr");
  write_atomically(folder.path() / "linear.exr", picture.substr(0, picture.size() / 2));
  expect_refused(folder.path(), "linear.exr");
}

}  // namespace
}  // namespace rnmbake
