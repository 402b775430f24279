#include "volumes/lit_volume.h"

#include "encoding/basis_set.h"
#include "pipeline/probes/reference_light.h"
#include "pipeline/probes/settle_probes.h"
#include "probes/fill_probes.h"
#include "sampling/sampler.h"
#include "trace/block.h"

#include <algorithm>

#include <tbb/parallel_for.h>

namespace rnmbake {

std::vector<GatheredProbe> probes_at(const TraceScene& scene, std::span<const Vec3d> places,
                                     const DirectLight& direct, int samples, std::uint64_t seed) {
  ProbeGatherOptions options = probe_gathering();
  options.direct = direct;
  options.samples = samples;
  options.seed = seed;
  return gather_at(scene, places, options);
}

LightProbe as_probe(const GatheredProbe& gathered) {
  LightProbe probe;
  std::ranges::copy(gathered.irradiance, probe.irradiance.begin());
  probe.harmonics = gathered.harmonics;
  return probe;
}

ProbeVolume lit_volume(const TraceScene& scene, const ProbeBounds& bounds, double spacing,
                       const DirectLight& direct, int samples) {
  ProbeVolume volume = empty_volume("box", grid_in(bounds, spacing));
  settle_probes(scene, {}, volume);
  ProbeGatherOptions options = probe_gathering();
  options.direct = direct;
  options.samples = samples;
  std::vector<LightProbe*> probes;
  for (LightProbe& probe : volume.probes) probes.push_back(&probe);
  light_by_reference(scene, probes, options);
  fill_probes(volume);
  return volume;
}

std::vector<Vec3> light_at(const TraceScene& scene, const PointSource& points, const DirectLight& direct,
                           int samples, std::uint64_t seed) {
  GatherOptions options;
  options.directions.push_back(flat_direction());
  options.direct = direct;
  options.samples = samples;
  std::vector<Vec3> light(points.size());
  constexpr std::size_t block = BlockGatherer::most_points;
  tbb::parallel_for(std::size_t{0}, (points.size() + block - 1) / block, [&](std::size_t b) {
    const std::size_t first = b * block, count = std::min(block, points.size() - first);
    BlockGatherer gatherer(scene, points, options, nullptr);
    BatchStatistics statistics(count, gatherer.values());
    gatherer.batch(first, count, samples, hash_of(seed, b), statistics);
    for (std::size_t i = 0; i < count; ++i) light[first + i] = statistics.mean(i, 0);
  });
  return light;
}

}  // namespace rnmbake
