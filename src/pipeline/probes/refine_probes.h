// pipeline/probes/refine_probes.h - more light probes where light between them is not what they say.
#pragma once

#include "pipeline/probes/settle_probes.h"
#include "probes/probe_volume.h"
#include "trace/scene.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>

namespace rnmbake {

struct RefineOptions {
  double error = 0;  // wanted, as a share of the mean light of the box's probes; 0: no probes are added
  int levels = 3;    // 1 to most_tree_levels: how often a cell of the box is halved at most
};

/// Gathers light at valid probes: E/pi, standard errors, harmonics. Calls with different rounds must have
/// independent noise.
using LightProbes = std::function<void(std::span<LightProbe* const> probes, std::uint64_t round)>;

struct RefineCounts {
  std::size_t divided = 0;  // cells
  std::size_t lit = 0;      // probes added, those that were not kept included
  std::uint64_t rounds = 0;
};

/// Gives a box, settled and lit, a tree (probes/probe_tree.h). Round by round, light is traced at the places
/// where the next level's probes of all new cells would stand, and held against what the volume as it is
/// then says there, by the best of the leak tests that it allows. With D the difference of E/pi at a place,
/// and V the variance of its noise (squared standard errors: the traced one's, and those of the probes looked
/// up, times the squares of their shares), the mean square error of a cell is
///
///   e^2 = sum of w_j (D_j^2 - V_j) / sum of w_j,
///
/// a mean over the directions and colours within each place, and over places by Simpson's rule: w is 1, 4, 16
/// or 64 at a corner (where D = V = 0), on an edge, in a face, at the centre; 0 at places inside of things.
/// So e^2 is the mean over the cell of what interpolation errs by, without the noise of either side. A cell
/// is divided where e exceeds the wanted error and the mean of D^2 is more than twice that of V: means over
/// the directions scatter by up to sqrt(2 / 9) V, as they have nine harmonics, so less may be noise alone.
/// Where all corners of a cell are inside of things it is not divided.
///
/// Neighbours on faces and edges differ by one level at most (CellLookup needs that): larger ones are divided
/// as well, which costs no more tracing. A probe that moved farther than its smallest cell allows goes back
/// and counts as inside of things. Nothing happens to boxes one probe thick, which is logged. Throws
/// Interrupted.
RefineCounts refine_probes(const TraceScene& scene, const SettleOptions& settling,
                           const RefineOptions& options, const LightProbes& light, ProbeVolume& volume);

}  // namespace rnmbake
