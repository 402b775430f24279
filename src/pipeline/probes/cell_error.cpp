#include "pipeline/probes/cell_error.h"

#include "probes/probe_tree.h"

namespace rnmbake {

Difference difference_at(const ProbeVolume& volume, const VolumeSampler& sampler, const LightProbe& truth) {
  Difference found;
  for (std::size_t k = 0; k < probe_direction_count; ++k) {
    Vec3 light(0);
    const ProbeShares shares = sampler.shares(truth.position, probe_directions()[k]);
    for (const ProbeShare& share : shares.used()) {
      const LightProbe& probe = volume.probes[share.probe];
      const Vec3 error = probe.standard_error[k] * share.weight;
      light += probe.irradiance[k] * share.weight;
      found.noise += double(error.dot(error));
    }
    const Vec3 difference = light - truth.irradiance[k];
    found.square += double(difference.dot(difference));
    found.noise += double(truth.standard_error[k].dot(truth.standard_error[k]));
  }
  constexpr double values = 3.0 * probe_direction_count;
  return {found.square / values, found.noise / values};
}

double simpson_weight(std::size_t node) {
  double weight = 1;
  for (const int step : node_steps(node)) weight *= step == 1 ? 4 : 1;
  return weight;
}

}  // namespace rnmbake
