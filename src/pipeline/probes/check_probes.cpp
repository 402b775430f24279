#include "pipeline/probes/check_probes.h"

#include "base/log.h"
#include "base/numeric/running_moments.h"
#include "base/progress.h"
#include "base/text.h"
#include "base/text_table.h"
#include "blender/blender_session.h"
#include "pipeline/probes/reference_light.h"
#include "probes/fill_probes.h"
#include "process/stop.h"
#include "sampling/sampler.h"
#include "trace/probes/surroundings.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include <spdlog/fmt/fmt.h>

namespace rnmbake {
namespace {

struct Place {
  std::size_t volume = 0;
  Vec3d at{0, 0, 0};
};

double probes_of_boxes(const std::vector<ProbeVolume>& volumes) {
  double sum = 0;
  for (const ProbeVolume& volume : volumes) sum += volume.grid ? double(volume.probes.size()) : 0;
  return sum;
}

/// Places in each box by its share of the probes, between the outermost ones; those that see backs of faces
/// are left out.
std::vector<Place> random_places(const TraceScene& scene, const std::vector<ProbeVolume>& volumes,
                                 std::size_t count, std::uint64_t seed) {
  std::vector<Place> places;
  std::vector<Vec3d> points;
  const double all = probes_of_boxes(volumes);
  for (std::size_t v = 0; v < volumes.size(); ++v) {
    if (!volumes[v].grid) continue;
    const ProbeGrid& grid = *volumes[v].grid;
    const auto share = std::max<std::size_t>(1, std::size_t(double(count * volumes[v].probes.size()) / all));
    for (std::size_t i = 0; i < share; ++i) {
      Sampler sampler(hash_of(seed, v), static_cast<std::uint32_t>(i));
      const Vec3 u = sampler.next3();
      Vec3d at = grid.first;
      for (int axis = 0; axis < 3; ++axis)
        at += grid.steps[std::size_t(axis)] * (double(u[axis]) * (grid.counts[std::size_t(axis)] - 1));
      places.push_back({v, at});
      points.push_back(at);
    }
  }
  SurroundingsOptions looking;
  looking.side = 8;
  const auto around =
      look_around(scene, scene.relative(points), looking, [] { return StopRequest::requested(); });
  std::vector<Place> open;
  for (std::size_t i = 0; i < places.size(); ++i)
    if (1 - around[i].back_faces >= double(least_validity)) open.push_back(places[i]);
  return open;
}

std::vector<GatheredProbe> gathered(const TraceScene& scene, const std::vector<Vec3d>& at,
                                    const ProbeGatherOptions& options, Progress& progress, double from,
                                    double to) {
  return gather_at(scene, at, options, [&](double share) {
    progress.update(from + (to - from) * share, "places between probes");
  });
}

/// Truth at places, in two halves whose noise is independent.
struct Truth {
  std::vector<GatheredProbe> first, second;
};

/// `looked_up`: [places][directions].
ProbeErrorRow errors_of(const std::vector<Vec3>& looked_up, const Truth& truth) {
  ProbeErrorRow row;
  const std::size_t directions = truth.first.front().irradiance.size();
  std::vector<double> of_places;
  double product = 0, sum = 0;
  for (std::size_t i = 0; i < truth.first.size(); ++i) {
    double square = 0;
    for (std::size_t k = 0; k < directions; ++k) {
      const Vec3& value = looked_up[i * directions + k];
      const Vec3 a = value - truth.first[i].irradiance[k], b = value - truth.second[i].irradiance[k],
                 mean = (a + b) * 0.5F;
      product += double(a.dot(b));
      sum += double(mean.x + mean.y + mean.z);
      square += double(mean.dot(mean));
    }
    of_places.push_back(std::sqrt(square / (3 * double(directions))));
  }
  const double values = 3 * double(directions * truth.first.size());
  row.rmse = std::sqrt(std::max(0.0, product / values));
  row.bias = sum / values;
  const auto rank = of_places.begin() + std::ptrdiff_t(0.95 * double(of_places.size() - 1));
  std::ranges::nth_element(of_places, rank);
  row.p95 = *rank;
  return row;
}

std::vector<Vec3> look_up(const std::vector<ProbeVolume>& volumes, const std::vector<Place>& places,
                          ProbeEncoding encoding, LeakTest test) {
  std::vector<Vec3> values;
  std::size_t current = volumes.size();
  std::optional<VolumeSampler> sampler;
  for (const Place& place : places) {  // in the order of the volumes
    if (place.volume != current) {
      current = place.volume;
      sampler.emplace(volumes[current], encoding, test);
    }
    for (const Vec3& normal : probe_directions()) values.push_back(sampler->irradiance(place.at, normal));
  }
  return values;
}

double mean_of(const Truth& truth) {
  double sum = 0;
  std::size_t count = 0;
  for (const auto* half : {&truth.first, &truth.second}) {
    for (const GatheredProbe& probe : *half) {
      for (const Vec3& light : probe.irradiance) sum += double(light.x + light.y + light.z) / 3;
      count += probe.irradiance.size();
    }
  }
  return count > 0 ? sum / double(count) : 0;
}

std::string share_of(double value, double mean) {
  return mean > 0 ? fmt::format("{:.1f}", 100 * value / mean) : "-";
}

}  // namespace

ProbeCheck check_between(const TraceScene& scene, const std::vector<ProbeVolume>& volumes,
                         const ProbeGatherOptions& options, std::size_t places) {
  ProbeCheck check;
  const std::vector<Place> open = random_places(scene, volumes, places, options.seed);
  if (StopRequest::requested()) throw Interrupted{StopRequest::signal()};
  if (open.empty()) {
    if (probes_of_boxes(volumes) > 0)
      log::warn("nothing was checked: of {} between the probes none is in the open",
                counted(places, "random place"));
    return check;
  }
  std::vector<Vec3d> at;
  at.reserve(open.size());
  for (const Place& place : open) at.push_back(place.at);
  Progress progress("checking", progress_for(log::is_quiet(), log::is_jsonl()));
  ProbeGatherOptions half = options;
  half.seed = hash_of(options.seed, 1);
  Truth truth{gathered(scene, at, half, progress, 0, 0.5), {}};
  half.seed = hash_of(options.seed, 2);
  truth.second = gathered(scene, at, half, progress, 0.5, 1);
  check.places = open.size();
  check.mean = mean_of(truth);
  for (const LeakTest test : leak_tests_for(volumes)) {
    for (std::size_t e = 0; e < probe_encoding_names.size(); ++e) {
      const auto encoding = static_cast<ProbeEncoding>(e);
      ProbeErrorRow row = errors_of(look_up(volumes, open, encoding, test), truth);
      row.encoding = encoding;
      row.test = test;
      check.rows.push_back(row);
    }
  }
  return check;
}

ProbeAgreement check_at_probes(const TraceScene& scene, const std::vector<ProbeVolume>& volumes,
                               const ProbeGatherOptions& options, std::size_t most) {
  std::vector<const LightProbe*> probes;
  for (const ProbeVolume& volume : volumes) {
    for (const LightProbe& probe : volume.probes)
      if (is_valid(probe)) probes.push_back(&probe);
  }
  const std::size_t step =
      std::max<std::size_t>(1, (probes.size() + most - 1) / std::max<std::size_t>(1, most));
  std::vector<const LightProbe*> chosen;
  std::vector<Vec3d> at;
  for (std::size_t i = 0; i < probes.size(); i += step) {
    chosen.push_back(probes[i]);
    at.push_back(probes[i]->position);
  }
  Progress progress("checking", progress_for(log::is_quiet(), log::is_jsonl()));
  const auto truth = gathered(scene, at, options, progress, 0, 1);
  // Probes share paths with their neighbours, so that differences of one probe count as one.
  RunningMoments<double> differences;
  double square = 0;
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    double sum = 0;
    for (std::size_t k = 0; k < probe_direction_count; ++k) {
      const Vec3 difference = chosen[i]->irradiance[k] - truth[i].irradiance[k];
      sum += double(difference.x + difference.y + difference.z);
      square += double(difference.dot(difference));
    }
    differences.add(sum / (3 * double(probe_direction_count)), double(i + 1));
  }
  const auto count = double(chosen.size());
  ProbeAgreement agreement;
  agreement.probes = chosen.size();
  agreement.rmse = std::sqrt(square / (3 * count * double(probe_direction_count)));
  agreement.bias = differences.mean;
  agreement.noise = count > 1 ? std::sqrt(differences.squares / (count * (count - 1))) : 0;
  return agreement;
}

std::string agreement_text(const ProbeAgreement& it, double mean) {
  constexpr double beyond_doubt = 4;  // standard errors: once in 16,000 by chance
  const bool is_biased = std::abs(it.bias) > beyond_doubt * it.noise;
  return fmt::format("Blender against the reference at {}: {} ({} +- {} %), RMSE with noise {} %{}",
                     counted(it.probes, "probe"), is_biased ? "biased" : "no bias beyond the noise",
                     share_of(it.bias, mean), share_of(it.noise, mean), share_of(it.rmse, mean),
                     it.own_materials ? "; the reference traces the diffuse part of materials, --materials "
                                        "lambert gives Blender the same"
                                      : "");
}

std::string check_text(const ProbeCheck& check) {
  std::ostringstream out;
  if (!check.rows.empty()) {
    TextTable table;
    table.add({"encoding", "leak test", "RMSE %", "bias %", "95 % of places below %"});
    for (const ProbeErrorRow& row : check.rows) {
      table.add({std::string(probe_encoding_names[std::size_t(row.encoding)]),
                 std::string(leak_test_names[std::size_t(row.test)]), share_of(row.rmse, check.mean),
                 share_of(row.bias, check.mean), share_of(row.p95, check.mean)});
    }
    out << fmt::format("At {} between the probes, of the mean light there, {:.4g} (E/pi):\n",
                       counted(check.places, "random place"), check.mean);
    table.write(out);
  }
  if (check.agreement) out << agreement_text(*check.agreement, check.mean) << '\n';
  return out.str();
}

nlohmann::json check_json(const ProbeCheck& check) {
  nlohmann::json rows = nlohmann::json::array();
  for (const ProbeErrorRow& row : check.rows) {
    rows.push_back({{"encoding", probe_encoding_names[std::size_t(row.encoding)]},
                    {"leak_test", leak_test_names[std::size_t(row.test)]},
                    {"rmse", row.rmse},
                    {"bias", row.bias},
                    {"p95", row.p95}});
  }
  nlohmann::json content{{"places", check.places}, {"mean", check.mean}, {"errors", rows}};
  if (check.agreement) {
    const ProbeAgreement& it = *check.agreement;
    content["agreement"] = {
        {"probes", it.probes}, {"bias", it.bias}, {"bias_error", it.noise}, {"rmse", it.rmse}};
  }
  return content;
}

}  // namespace rnmbake
