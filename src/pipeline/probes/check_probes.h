// pipeline/probes/check_probes.h - how far light between probes is from what arrives there.
#pragma once

#include "probes/probe_lights.h"
#include "probes/probe_volume.h"
#include "probes/volume_sampler.h"
#include "trace/probes/gather_probes.h"
#include "trace/scene.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace rnmbake {

/// Errors of E/pi over the 14 directions and all colours, the truth's noise removed.
struct ProbeErrorRow {
  ProbeEncoding encoding = ProbeEncoding::sh3;
  LeakTest test = LeakTest::none;
  double rmse = 0, bias = 0;  // E/pi
  double p95 = 0;             // of a place's RMS error, noise and all
};

/// The probes themselves against the truth at their places: that of another source.
struct ProbeAgreement {
  std::size_t probes = 0;
  double rmse = 0;             // E/pi, noise of both sides included
  double bias = 0, noise = 0;  // mean difference, and its standard error
  bool own_materials = false;  // Blender showed the scene's, of which the reference has the diffuse part
};

struct ProbeCheck {
  std::size_t places = 0;
  double mean = 0;  // E/pi of the truth
  std::vector<ProbeErrorRow> rows;
  std::optional<ProbeAgreement> agreement;
};

/// Traces the truth at `places` random places in the boxes that are in the open, twice, and looks the same up
/// in each encoding, with each test that the volumes allow. No rows where no volume is a box. Deterministic
/// for the options' seed. Throws Interrupted.
[[nodiscard]] ProbeCheck check_between(const TraceScene& scene, const std::vector<ProbeVolume>& volumes,
                                       const ProbeGatherOptions& options, std::size_t places);

/// Traces the light at up to `most` of the valid probes. Throws Interrupted.
[[nodiscard]] ProbeAgreement check_at_probes(const TraceScene& scene, const std::vector<ProbeVolume>& volumes,
                                             const ProbeGatherOptions& options, std::size_t most);

/// "Blender against the reference at 200 probes: no bias beyond the noise ...".
[[nodiscard]] std::string agreement_text(const ProbeAgreement& agreement, double mean);

/// A table with a line for each row, and the sentence on agreement.
[[nodiscard]] std::string check_text(const ProbeCheck& check);
[[nodiscard]] nlohmann::json check_json(const ProbeCheck& check);

}  // namespace rnmbake
