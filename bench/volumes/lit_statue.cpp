#include "volumes/lit_statue.h"

#include "base/error.h"
#include "probes/volume_sampler.h"
#include "sampling/sampler.h"
#include "scene/diffuse_scene.h"
#include "trace/scene.h"
#include "volumes/lit_volume.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace rnmbake {
namespace {

constexpr std::size_t noise_batches = 8;

struct SurfacePoint {
  Vec3d position{0, 0, 0};  // from the statue's place
  Vec3 face{0, 0, 1}, normal{0, 0, 1};
};

/// Evenly over the area, in the order of the triangles: neighbours share paths.
std::vector<SurfacePoint> points_on(const Mesh& mesh, int count) {
  std::vector<double> areas{0};
  const auto corner = [&](std::size_t t, std::size_t k) {
    return mesh.positions[mesh.corner_vertex(3 * t + k)];
  };
  const auto cross = [&](std::size_t t) {
    return (corner(t, 1) - corner(t, 0)).cross(corner(t, 2) - corner(t, 0));
  };
  for (std::size_t t = 0; t < mesh.triangles(); ++t)
    areas.push_back(areas.back() + double(cross(t).length()));
  std::vector<SurfacePoint> points;
  for (int i = 0; i < count; ++i) {
    Sampler sampler(1, static_cast<std::uint32_t>(i));
    const Vec3 u = sampler.next3();
    const double at = areas.back() * (i + double(u.z)) / count;
    const auto t = std::size_t(std::ranges::upper_bound(areas, at) - areas.begin()) - 1;
    const float root = std::sqrt(u.x);
    const std::array<float, 3> weights{1 - root, root * (1 - u.y), root * u.y};
    SurfacePoint point;
    point.face = unit(cross(t));
    Vec3 place(0), normal(0);
    for (std::size_t k = 0; k < 3; ++k) {
      place += corner(t, k) * weights[k];
      normal += mesh.loop_normal[mesh.triangle_loops[3 * t + k]] * weights[k];
    }
    point.position = Vec3d(place);
    point.normal = unit(normal);
    points.push_back(point);
  }
  return points;
}

/// The statue's surface at one place; `whole`: with light from the normal's whole hemisphere, as in free
/// space.
class OnStatue : public PointSource {
 public:
  OnStatue(const std::vector<SurfacePoint>& points, const Vec3d& place, bool whole)
      : points_(points), place_(place), whole_(whole) {}
  [[nodiscard]] std::size_t size() const override { return points_.size(); }
  [[nodiscard]] GatherPoint sample(std::size_t index, const Vec2& /*u*/) const override {
    const SurfacePoint& it = points_[index];
    const Vec3 side = std::abs(it.normal.z) < 0.9F ? Vec3(0, 0, 1) : Vec3(1, 0, 0);
    GatherPoint point;
    point.position = Vec3(place_ + it.position);
    point.face = whole_ ? it.normal : it.face;
    const Vec3 tangent = unit(side.cross(it.normal));
    point.frame = {tangent, it.normal.cross(tangent), it.normal, 1};
    return point;
  }

 private:
  const std::vector<SurfacePoint>& points_;
  Vec3d place_;  // relative to the scene's origin
  bool whole_;
};

/// Light at points as often as `noise_batches` says, with independent noise: [batches][points].
using Batches = std::array<std::vector<Vec3>, noise_batches>;

/// Sums over places, points and colours of an error in shares of each place's mean light. Its square is
/// estimated from products of different batches alone, whose noise is independent, so that noise adds
/// nothing to it; its standard error comes from leaving out one batch after the other (the jackknife).
class Errors {
 public:
  void add(const Batches& values, const Batches& truth, double mean) {
    const auto scale = float(1 / mean);
    for (std::size_t i = 0; i < truth[0].size(); ++i) {
      std::array<Vec3, noise_batches> errors;
      Vec3 all(0);
      double squares = 0;
      for (std::size_t b = 0; b < noise_batches; ++b) {
        errors[b] = (values[b][i] - truth[b][i]) * scale;
        all += errors[b];
        squares += double(errors[b].dot(errors[b]));
      }
      products_ += double(all.dot(all)) - squares;
      for (std::size_t b = 0; b < noise_batches; ++b) {
        const Vec3 others = all - errors[b];
        without_[b] += double(others.dot(others)) - squares + double(errors[b].dot(errors[b]));
      }
      sum_ += double(all.x + all.y + all.z) / noise_batches;
      count_ += 3;
    }
  }

  /// "square_error": standard error of the square of "rmse", by noise.
  [[nodiscard]] nlohmann::json figures() const {
    constexpr double n = noise_batches;
    double mean = 0, spread = 0;
    for (const double one : without_) mean += one / n;
    for (const double one : without_) spread += (one - mean) * (one - mean);
    const double square = products_ / (n * (n - 1) * count_);
    const double error = std::sqrt(spread * (n - 1) / n) / ((n - 1) * (n - 2) * count_);
    return {{"rmse", std::sqrt(std::max(0.0, square))}, {"square_error", error}, {"bias", sum_ / count_}};
  }

 private:
  double products_ = 0, sum_ = 0, count_ = 0;
  std::array<double, noise_batches> without_{};  // products_ of the other batches
};

/// Without noise.
Batches repeated(const std::vector<Vec3>& values) {
  Batches batches;
  batches.fill(values);
  return batches;
}

double mean_of(const Batches& light) {
  double sum = 0, count = 0;
  for (const std::vector<Vec3>& batch : light) {
    for (const Vec3& value : batch) sum += double(value.x + value.y + value.z);
    count += 3 * double(batch.size());
  }
  return sum / count;
}

struct PlaceTruth {
  Vec3d place{0, 0, 0};  // world space
  Batches shaded, open;  // with the statue in the scene, and without
  double mean = 0;       // of what is shaded, E/pi
};

/// Share of a uniform sky, weighed by the cosine, that the statue leaves at each of its points: what an
/// engine multiplies light of probes by. Points that see none of it, inside of the statue, are taken out of
/// `points`.
std::vector<float> occlusion(const DiffuseScene& scene, std::size_t statue, std::vector<SurfacePoint>& points,
                             int samples) {
  DiffuseScene alone;
  alone.survey.meshes = {scene.survey.mesh_of(scene.survey.objects[statue])};
  alone.survey.objects = {scene.survey.objects[statue]};
  alone.survey.objects.front().mesh = 0;
  alone.survey.objects.front().to_world = Mat44();
  alone.object_materials = {{0}};
  alone.materials.emplace_back().name = "black";
  alone.world.radiance = Vec3(1);
  alone.survey.world = "constant";
  const TraceScene traced(alone, scene.survey.blender_version);
  const auto sky = light_at(traced, OnStatue(points, -traced.origin(), false), {}, samples, 11);
  std::vector<float> shares;
  std::vector<SurfacePoint> outside;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!(sky[i].x > 0)) continue;
    shares.push_back(sky[i].x);
    outside.push_back(points[i]);
  }
  points = outside;
  return shares;
}

Batches occluded(const Batches& light, const std::vector<float>& shares) {
  Batches darker = light;
  for (std::vector<Vec3>& batch : darker) {
    for (std::size_t i = 0; i < batch.size(); ++i) batch[i] *= shares[i];
  }
  return darker;
}

Batches batches_at(const TraceScene& scene, const PointSource& points, const StatueStudy& study,
                   std::uint64_t seed) {
  Batches batches;
  for (std::size_t b = 0; b < noise_batches; ++b)
    batches[b] = light_at(scene, points, study.direct, study.samples, hash_of(seed, b));
  return batches;
}

/// As the renderer shows it: never negative.
Vec3 shown(const Vec3& light) {
  return {std::max(0.0F, light.x), std::max(0.0F, light.y), std::max(0.0F, light.z)};
}

std::vector<Vec3> looked_up(const VolumeSampler& sampler, const std::vector<SurfacePoint>& points,
                            const Vec3d& place) {
  std::vector<Vec3> light;
  for (const SurfacePoint& point : points)
    light.push_back(shown(sampler.irradiance(place + point.position, point.normal)));
  return light;
}

/// Rows of light out of probes of each encoding that stand at the points themselves: what encodings lose.
void add_encodings(const TraceScene& open, const StatueStudy& study, const std::vector<SurfacePoint>& points,
                   const std::vector<PlaceTruth>& truths, nlohmann::json& rows) {
  std::array<Errors, probe_encoding_names.size()> errors;
  for (const PlaceTruth& truth : truths) {
    std::array<std::vector<GatheredProbe>, noise_batches> probes;
    std::vector<Vec3d> places;
    for (const SurfacePoint& point : points) places.push_back(truth.place + point.position);
    for (std::size_t b = 0; b < noise_batches; ++b)
      probes[b] = probes_at(open, places, study.direct, study.samples / 2, hash_of(13, b));
    for (std::size_t e = 0; e < errors.size(); ++e) {
      const auto encoding = static_cast<ProbeEncoding>(e);
      Batches values;
      for (std::size_t b = 0; b < noise_batches; ++b) {
        for (std::size_t i = 0; i < points.size(); ++i) {
          const auto encoded = encoded_probe(as_probe(probes[b][i]), encoding);
          values[b].push_back(shown(decoded_probe(encoded, encoding, points[i].normal)));
        }
      }
      errors[e].add(values, truth.open, truth.mean);
    }
  }
  for (std::size_t e = 0; e < errors.size(); ++e) {
    rows.push_back({{"spacing", 0},
                    {"probes", 0},
                    {"test", "none"},
                    {"encoding", probe_encoding_names[e]},
                    {"own", errors[e].figures()}});
  }
}

std::size_t object_named(const DiffuseScene& scene, const std::string& key) {
  const auto& objects = scene.survey.objects;
  const auto found = std::ranges::find(objects, key, &SceneObject::key);
  if (found == objects.end()) fail(ExitCode::invalid_input, "the scene has no object '{}'", key);
  return static_cast<std::size_t>(found - objects.begin());
}

}  // namespace

nlohmann::json study_statue(const StatueStudy& study) {
  DiffuseScene scene = read_diffuse_scene(study.scene);
  const std::size_t number = object_named(scene, study.statue);
  SceneObject& statue = scene.survey.objects[number];
  for (const int material : scene.object_materials[number]) {
    if (study.black) scene.materials[static_cast<std::size_t>(material)] = {};
  }
  auto points = points_on(scene.survey.mesh_of(statue), study.points);
  const std::vector<float> shares = occlusion(scene, number, points, study.samples);
  DiffuseScene without = scene;
  without.unlit.resize(scene.survey.objects.size(), 0);
  without.unlit[number] = 1;
  const std::string version = scene.survey.blender_version;
  const TraceScene open(without, version);
  std::vector<PlaceTruth> truths;
  Errors floor, occluded_floor;
  std::vector<double> means;
  for (const Vec3d& place : study.places) {
    statue.to_world = Mat44().setTranslation(place);
    const TraceScene shaded(scene, version);
    const std::uint64_t seed = hash_of(7, truths.size());
    PlaceTruth& truth = truths.emplace_back();
    truth.place = place;
    truth.shaded = batches_at(shaded, OnStatue(points, place - shaded.origin(), false), study, seed);
    truth.open =
        batches_at(open, OnStatue(points, place - open.origin(), true), study, hash_of(seed, noise_batches));
    truth.mean = mean_of(truth.shaded);
    means.push_back(truth.mean);
    floor.add(truth.open, truth.shaded, truth.mean);
    occluded_floor.add(occluded(truth.open, shares), truth.shaded, truth.mean);
  }
  nlohmann::json rows = nlohmann::json::array();
  add_encodings(open, study, points, truths, rows);
  for (const double spacing : study.spacings) {
    const ProbeVolume volume = lit_volume(open, study.bounds, spacing, study.direct, study.samples);
    for (std::size_t t = 0; t < leak_test_names.size(); ++t) {
      for (std::size_t e = 0; e < probe_encoding_names.size(); ++e) {
        const VolumeSampler sampler(volume, static_cast<ProbeEncoding>(e), static_cast<LeakTest>(t));
        Errors errors, own, with_occlusion;
        for (const PlaceTruth& truth : truths) {
          const Batches values = repeated(looked_up(sampler, points, truth.place));
          errors.add(values, truth.shaded, truth.mean);
          own.add(values, truth.open, truth.mean);
          with_occlusion.add(occluded(values, shares), truth.shaded, truth.mean);
        }
        rows.push_back({{"spacing", spacing},
                        {"probes", volume.probes.size()},
                        {"test", leak_test_names[t]},
                        {"encoding", probe_encoding_names[e]},
                        {"own", own.figures()},
                        {"seen", errors.figures()},
                        {"occluded", with_occlusion.figures()}});
      }
    }
  }
  return {{"means", means},
          {"points", points.size()},
          {"floor", {{"seen", floor.figures()}, {"occluded", occluded_floor.figures()}}},
          {"rows", rows}};
}

}  // namespace rnmbake
