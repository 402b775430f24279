#include "volumes/leaks.h"

#include "probes/volume_sampler.h"
#include "sampling/sampler.h"
#include "trace/trace_scenes.h"
#include "volumes/lit_volume.h"

#include <algorithm>
#include <string>
#include <utility>

namespace rnmbake {
namespace {

/// A scene with a bright and a dark part.
struct LeakCase {
  std::string name;
  DiffuseScene scene;
  ProbeBounds bounds;        // of the probes
  ProbeBounds bright, dark;  // where their light is looked up
  ProbeBounds near_side;     // probes outside of it stand on the other side of the wall
};

/// Two closed rooms, 10 cm apart, a lamp in one; the places by the wall.
LeakCase thin_wall() {
  LeakCase it;
  it.name = "thin wall";
  it.bounds = {{0, 0, 0}, {8.1, 4, 3}};
  it.bright = {{3, 0.3, 0.3}, {3.9, 3.7, 2.7}};
  it.dark = {{4.2, 0.3, 0.3}, {5.1, 3.7, 2.7}};
  it.near_side = {{4.05, 0, 0}, {8.1, 4, 3}};
  add_object(it.scene, "bright", box({0, 0, 0}, {4, 4, 3}), Vec3(0.7F));
  add_object(it.scene, "dark", box({4.1F, 0, 0}, {8.1F, 4, 3}), Vec3(0.7F));
  add_object(it.scene, "lamp", {level(0.5F, 2.9F, false, {2, 2, 0})}, Vec3(0), Vec3(10));
  it.scene.survey.blender_version = "4.3.2";
  return it;
}

/// A closed box of 0.6 x 0.6 x 1.5 with walls of 2 cm in a lit room; its inside, 10 cm off the walls.
LeakCase cupboard() {
  LeakCase it;
  it.name = "cupboard";
  it.bounds = {{0, 0, 0}, {4, 4, 3}};
  it.bright = {{1.9, 1.6, 0.3}, {2.8, 2.4, 1.4}};
  it.dark = {{1.2, 1.8, 0.13}, {1.56, 2.16, 1.39}};
  it.near_side = {{1.09, 1.69, 0.02}, {1.67, 2.27, 1.5}};
  add_object(it.scene, "room", box({0, 0, 0}, {4, 4, 3}), Vec3(0.7F));
  add_object(it.scene, "outside", box({1.08F, 1.68F, 0.01F}, {1.68F, 2.28F, 1.51F}, false), Vec3(0.7F));
  add_object(it.scene, "inside", box({1.1F, 1.7F, 0.03F}, {1.66F, 2.26F, 1.49F}), Vec3(0.7F));
  add_object(it.scene, "lamp", {level(0.5F, 2.9F, false, {2, 2, 0})}, Vec3(0), Vec3(10));
  it.scene.survey.blender_version = "4.3.2";
  return it;
}

/// Beside the door, by the wall.
LeakCase door(const std::filesystem::path& file) {
  LeakCase it;
  it.name = "door";
  it.scene = read_diffuse_scene(file);
  it.bounds = {{0, 0, 0}, {8.1, 4, 3}};
  it.bright = {{3, 0.3, 0.3}, {3.9, 1.1, 2.7}};
  it.dark = {{4.2, 0.3, 0.3}, {5.1, 1.1, 2.7}};
  it.near_side = {{4.05, 0, 0}, {8.1, 4, 3}};
  return it;
}

std::vector<Vec3d> places_in(const ProbeBounds& bounds, int count) {
  std::vector<Vec3d> places;
  for (int i = 0; i < count; ++i) {
    Sampler sampler(3, static_cast<std::uint32_t>(i));
    places.push_back(bounds.low + (bounds.high - bounds.low) * Vec3d(sampler.next3()));
  }
  return places;
}

/// Means over the normals, for each place.
std::vector<double> arriving(const TraceScene& scene, const std::vector<Vec3d>& places, int samples) {
  std::vector<double> means;
  for (const GatheredProbe& probe : probes_at(scene, places, {}, samples, 5)) {
    double sum = 0;
    for (const Vec3& light : probe.irradiance) sum += double(light.x + light.y + light.z) / 3;
    means.push_back(sum / double(probe_direction_count));
  }
  return means;
}

bool holds(const ProbeBounds& bounds, const Vec3d& place) {
  for (int axis = 0; axis < 3; ++axis)
    if (place[axis] < bounds.low[axis] || place[axis] > bounds.high[axis]) return false;
  return true;
}

/// Means over the normals: of all light, and of what probes on the other side give of it.
struct LookedUp {
  std::vector<double> light;  // [places]
  double through = 0;         // over all places
};

LookedUp looked_up(const VolumeSampler& sampler, const ProbeVolume& volume, const LeakCase& it,
                   const std::vector<Vec3d>& places) {
  LookedUp found;
  const auto grey = [](const Vec3& light) { return double(light.x + light.y + light.z) / 3; };
  const double share = 1 / double(probe_direction_count);
  for (const Vec3d& place : places) {
    double& sum = found.light.emplace_back(0);
    for (const Vec3& normal : probe_directions()) {
      sum += share * grey(sampler.irradiance(place, normal));
      const ProbeShares shares = sampler.shares(place, normal);
      for (const ProbeShare& one : shares.used()) {
        const LightProbe& probe = volume.probes[one.probe];
        if (holds(it.near_side, probe.position)) continue;
        found.through +=
            share * double(one.weight) * grey(irradiance_of(probe.harmonics, normal)) / double(places.size());
      }
    }
  }
  return found;
}

double mean_of(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum / double(values.size());
}

void study_case(const LeakCase& it, const LeakStudy& study, nlohmann::json& rows) {
  constexpr int count = 400;
  const TraceScene scene(it.scene, it.scene.survey.blender_version);
  const std::vector<Vec3d> places = places_in(it.dark, count);
  const std::vector<double> truth = arriving(scene, places, study.samples);
  const double bright = mean_of(arriving(scene, places_in(it.bright, count), study.samples));
  for (const double spacing : study.spacings) {
    const ProbeVolume volume = lit_volume(scene, it.bounds, spacing, {}, study.samples);
    for (std::size_t t = 0; t < leak_test_names.size(); ++t) {
      const VolumeSampler sampler(volume, ProbeEncoding::sh3, static_cast<LeakTest>(t));
      const LookedUp found = looked_up(sampler, volume, it, places);
      const std::vector<double>& light = found.light;
      double largest = 0;
      for (std::size_t i = 0; i < light.size(); ++i) largest = std::max(largest, light[i] - truth[i]);
      rows.push_back({{"case", it.name},
                      {"spacing", spacing},
                      {"probes", volume.probes.size()},
                      {"test", leak_test_names[t]},
                      {"truth", mean_of(truth) / bright},
                      {"excess", (mean_of(light) - mean_of(truth)) / bright},
                      {"through", found.through / bright},
                      {"largest", largest / bright}});
    }
  }
}

}  // namespace

nlohmann::json study_leaks(const LeakStudy& study) {
  nlohmann::json rows = nlohmann::json::array();
  study_case(thin_wall(), study, rows);
  study_case(cupboard(), study, rows);
  if (!study.two_rooms.empty()) study_case(door(study.two_rooms), study, rows);
  return rows;
}

}  // namespace rnmbake
