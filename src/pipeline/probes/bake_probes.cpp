#include "pipeline/probes/bake_probes.h"

#include "bake/plan.h"
#include "bake/point_receivers.h"
#include "base/log.h"
#include "base/text.h"
#include "pipeline/dispatch/cycles_settings.h"
#include "pipeline/dispatch/dispatcher.h"
#include "pipeline/probes/probe_collector.h"

#include <algorithm>

#include <spdlog/fmt/fmt.h>

namespace rnmbake {
namespace {

/// Probes that fail together where Blender fails at one of them.
constexpr std::size_t block_size = 1024;

/// Bakes whose sum is the light that is wanted; no two with the same settings. None: there is none.
std::vector<ProbeTerm> terms_of(const BakeSettings& settings, bool has_lamps, ProbeLights lights) {
  const CyclesSettings all = cycles_settings(settings.bake, settings.object);
  CyclesSettings direct = all;
  direct.bounces = 0;
  CyclesSettings direct_without_lamps = direct;
  direct_without_lamps.lamps = false;
  if (lights == ProbeLights::all || (lights == ProbeLights::no_lamps && !has_lamps)) return {{all, 1}};
  std::vector<ProbeTerm> terms;
  if (all.bounces > 0) terms = {{all, 1}, {direct, -1}};
  if (lights == ProbeLights::no_lamps) terms.push_back({direct_without_lamps, 1});
  return terms;
}

std::vector<ProbeBlock> blocks_of(std::size_t positions) {
  std::vector<ProbeBlock> blocks;
  for (std::size_t first = 0; first < positions; first += block_size)
    blocks.push_back({first, std::min(block_size, positions - first)});
  return blocks;
}

std::vector<std::string> names_of(std::span<const Vec3> directions) {
  std::vector<std::string> names;
  for (const Vec3& d : directions)
    names.push_back(fmt::format("direction ({:.3g}, {:.3g}, {:.3g})", d.x, d.y, d.z));
  return names;
}

std::string name_of(const ProbeBlock& block) {
  return block.count == 1 ? fmt::format("probe {}", block.first)
                          : fmt::format("probes {} to {}", block.first, block.first + block.count - 1);
}

/// A launch for everything unless settings say otherwise, whatever the recipe of lightmaps.
BakingSettings::Dispatch dispatch_of(const BakingSettings& settings) {
  using Mode = BakingSettings::Dispatch;
  return settings.dispatch == Mode::automatic ? Mode::scene : settings.dispatch;
}

Plan plan_probes(const BakeSettings& settings, const ProbeBake& wanted, const std::vector<ProbeBlock>& blocks,
                 const std::vector<ProbeTerm>& terms) {
  Plan plan;
  plan.absent = wanted.absent;
  const std::vector<std::string> names = names_of(wanted.directions);
  for (const ProbeBlock& block : blocks) {
    const auto positions = wanted.positions.subspan(block.first, block.count);
    add_receiver_tasks(plan, {name_of(block), point_map(block.count), ""},
                       make_point_receivers(positions, wanted.directions), names, terms.front().cycles);
  }
  const std::vector<BakeTask> of_first_term = plan.tasks;  // the others have the same receivers
  for (std::size_t i = 1; i < terms.size(); ++i) {
    for (const BakeTask& task : of_first_term) plan.tasks.emplace_back(task).cycles = terms[i].cycles;
  }
  group_tasks(plan, dispatch_of(settings.bake));
  return plan;
}

/// Errors of probes whose blocks were delivered; the others have had theirs.
void name_holes(const std::vector<std::size_t>& holes, std::span<const Vec3d> positions) {
  if (holes.empty()) return;
  const Vec3d& first = positions[holes.front()];
  log::error("Blender baked no number at {}, the first of them at ({:.6g}, {:.6g}, {:.6g})",
             counted(holes.size(), "probe"), first.x, first.y, first.z);
}

}  // namespace

BakedProbes bake_probes(BlenderSession& session, const SceneSurvey& survey, const BlendPath& blend,
                        const ProbeBake& wanted) {
  const BakeSettings& settings = session.settings();
  const std::vector<ProbeTerm> terms = terms_of(settings, !survey.lights.empty(), wanted.lights);
  const std::size_t values = wanted.positions.size() * wanted.directions.size();
  if (values == 0 || terms.empty())
    return {std::vector<Vec3>(values, Vec3(0)), {}, std::vector<bool>(wanted.positions.size(), true), {}};
  const std::vector<ProbeBlock> blocks = blocks_of(wanted.positions.size());
  const Plan plan = plan_probes(settings, wanted, blocks, terms);
  log::info("baking {} x {} in {} of Blender {}", counted(wanted.positions.size(), "probe"),
            counted(wanted.directions.size(), "direction"), counted(plan.batches.size(), "launch"),
            session.blender().info().version_text);
  ProbeCollector collector(plan, blocks, terms, wanted.directions.size());
  BakedProbes result;
  result.timings =
      run_batches(session, plan, blend, receiver_requests(settings, survey, plan), collector, wanted.rules);
  result.irradiance = collector.irradiance();
  result.standard_errors = collector.standard_errors();
  result.baked = collector.is_baked();
  name_holes(collector.holes(), wanted.positions);
  return result;
}

}  // namespace rnmbake
