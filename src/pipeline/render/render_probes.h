// pipeline/render/render_probes.h - volumes of light probes from disk, and what in a scene they light.
#pragma once

#include "probes/probe_lights.h"
#include "probes/volume_sampler.h"
#include "scene/diffuse_scene.h"

#include <cstddef>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace rnmbake {

struct ProbeLookup {
  ProbeEncoding encoding = ProbeEncoding::sh3;
  LeakTest test = LeakTest::visibility;
};

/// What lights the moving objects of a scene.
class SceneProbes {
 public:
  /// `path`: what rnmbake probes wrote. `dynamic`: patterns of the objects that it lights; none: those that
  /// were left out of it; where that is none either, all. Throws as read_volumes() and dynamic_objects(), and
  /// Error(unsupported) where no volume is a box.
  SceneProbes(const std::filesystem::path& path, const DiffuseScene& scene,
              const std::vector<std::string>& dynamic);

  [[nodiscard]] bool lights(std::size_t object) const { return lit_[object] != 0; }

  /// Adds a sphere for each probe to the scene (pipeline/render/probe_spheres.h), and lights everything.
  void show_spheres(DiffuseScene& scene);
  /// Number of the probe, counted over all volumes, that an object is the sphere of.
  [[nodiscard]] std::optional<std::size_t> sphere_of(std::size_t object) const {
    if (object < first_sphere_) return std::nullopt;
    return object - first_sphere_;
  }
  [[nodiscard]] const std::vector<ProbeVolume>& volumes() const { return volumes_; }
  /// Light that they hold; what is missing are the engine's own lights.
  [[nodiscard]] ProbeLights held() const { return held_; }

 private:
  std::vector<ProbeVolume> volumes_;  // boxes alone
  std::vector<char> lit_;             // [objects]
  ProbeLights held_ = ProbeLights::all;
  std::size_t first_sphere_ = std::numeric_limits<std::size_t>::max();  // object; none: no spheres
};

/// Light at any place, from the first box that it lies in, else the nearest box.
class ProbeLight {
 public:
  ProbeLight(const SceneProbes& probes, const ProbeLookup& lookup);

  /// E/pi, RGB, never negative; world space. A sphere has the light of its own probe.
  [[nodiscard]] Vec3 irradiance(std::size_t object, const Vec3d& place, const Vec3& normal) const;

 private:
  [[nodiscard]] Vec3 between(const Vec3d& place, const Vec3& normal) const;

  const SceneProbes& probes_;
  ProbeEncoding encoding_;
  std::vector<VolumeSampler> samplers_;     // [volumes]
  std::vector<std::vector<Vec3>> spheres_;  // coefficients, by probe
};

}  // namespace rnmbake
