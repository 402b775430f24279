#include "pipeline/probes/refine_probes.h"

#include "base/log.h"
#include "pipeline/probes/cell_error.h"
#include "probes/fill_probes.h"
#include "probes/probe_tree.h"
#include "probes/volume_sampler.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <unordered_map>
#include <utility>
#include <vector>

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

namespace rnmbake {
namespace {

double mean_light(const ProbeVolume& volume) {
  double sum = 0;
  std::size_t count = 0;
  for (const LightProbe& probe : volume.probes) {
    if (!is_valid(probe)) continue;
    for (const Vec3& light : probe.irradiance) sum += double(light.x + light.y + light.z) / 3;
    count += probe.irradiance.size();
  }
  return count > 0 ? sum / double(count) : 0;
}

/// Errors of a cell, of the wanted one, from which on those within it are tested when it is divided.
constexpr double doubt = 2;

/// Level of the cells in whose middle, or in the middle of whose edges and faces, a probe of the tree stood
/// first; 0 for those of the grid.
int first_level(const LatticePlace& place) {
  int level = 0;
  for (const int step : place)
    while (level < most_tree_levels && step % (lattice_steps >> level) != 0) ++level;
  return std::max(0, level - 1);
}

class Refiner {
 public:
  Refiner(const TraceScene& scene, const SettleOptions& settling, const RefineOptions& options,
          const LightProbes& light, ProbeVolume& volume);
  RefineCounts refine();

 private:
  struct Cell {
    CellPlace place;
    bool tested = false;        // light at all of its nodes is known
    bool forced = false;        // its neighbours are too small for it
    std::uint8_t doubtful = 0;  // of a tested one: a bit for each of the eight in it, were it divided
  };
  struct Test {
    bool is_wrong = false;
    std::uint8_t doubtful = 0;
  };

  std::uint32_t probe_at(const LatticePlace& place);
  CellNodes nodes_of(std::size_t cell);
  [[nodiscard]] bool is_buried(std::size_t cell) const;
  /// Probes at the nodes of cells, settled. `cells`: by level.
  void make_probes(const std::vector<std::size_t>& cells);
  /// Sends probes back that moved too far for the cells around them.
  void call_back();
  void light_new();
  [[nodiscard]] Test test(std::size_t cell, const VolumeSampler& sampler) const;
  void divide(std::size_t cell);
  void drop_unused();
  void shorten_reach();

  const TraceScene& scene_;
  const SettleOptions& settling_;
  const RefineOptions& options_;
  const LightProbes& light_;
  ProbeVolume& volume_;
  const ProbeGrid grid_;
  double wanted_square_ = 0;
  std::vector<Cell> cells_;                                 // [cells]
  std::vector<LatticePlace> lattice_;                       // [probes]
  std::vector<char> in_tree_;                               // [probes]
  std::vector<std::size_t> unlit_;                          // numbers of probes
  std::vector<std::size_t> waiting_;                        // numbers of cells, to be tested next
  std::unordered_map<std::uint64_t, std::uint32_t> known_;  // probes by lattice_number()
  RefineCounts counts_;
};

Refiner::Refiner(const TraceScene& scene, const SettleOptions& settling, const RefineOptions& options,
                 const LightProbes& light, ProbeVolume& volume)
    : scene_(scene),
      settling_(settling),
      options_(options),
      light_(light),
      volume_(volume),
      grid_(*volume.grid) {
  const double wanted = options.error * mean_light(volume);
  wanted_square_ = wanted * wanted;
  volume_.tree = undivided_tree(grid_);
  for (int z = 0; z < grid_.counts[2]; ++z) {
    for (int y = 0; y < grid_.counts[1]; ++y) {
      for (int x = 0; x < grid_.counts[0]; ++x) {
        lattice_.push_back({x * lattice_steps, y * lattice_steps, z * lattice_steps});
        known_.emplace(lattice_number(grid_, lattice_.back()),
                       static_cast<std::uint32_t>(lattice_.size() - 1));
      }
    }
  }
  in_tree_.assign(volume_.probes.size(), 1);
  for (const CellPlace& place : cell_places(grid_, *volume_.tree)) {
    waiting_.push_back(cells_.size());
    cells_.push_back({place});
  }
}

std::uint32_t Refiner::probe_at(const LatticePlace& place) {
  const auto [found, is_new] =
      known_.emplace(lattice_number(grid_, place), static_cast<std::uint32_t>(volume_.probes.size()));
  if (is_new) {
    volume_.probes.emplace_back();
    volume_.probes.back().position = lattice_point(grid_, place);
    lattice_.push_back(place);
    in_tree_.push_back(0);
  }
  return found->second;
}

CellNodes Refiner::nodes_of(std::size_t cell) {
  CellNodes nodes;
  for (std::size_t node = 0; node < nodes.size(); ++node)
    nodes[node] = probe_at(cells_[cell].place.node(node));
  return nodes;
}

bool Refiner::is_buried(std::size_t cell) const {
  return std::ranges::none_of(volume_.tree->cells[cell].corners,
                              [&](std::uint32_t probe) { return is_valid(volume_.probes[probe]); });
}

void Refiner::make_probes(const std::vector<std::size_t>& cells) {
  for (std::size_t i = 0; i < cells.size();) {
    const int level = cells_[cells[i]].place.level;
    const std::size_t first = volume_.probes.size();
    for (; i < cells.size() && cells_[cells[i]].place.level == level; ++i) (void)nodes_of(cells[i]);
    // They hang in cells of this level before they have cells of their own.
    settle_probes(scene_, settling_, grid_, level + 1, reach_of(grid_, level),
                  std::span(volume_.probes).subspan(first), volume_.depths);
    for (std::size_t probe = first; probe < volume_.probes.size(); ++probe) unlit_.push_back(probe);
  }
}

void Refiner::call_back() {
  const auto levels = levels_of_probes(leaves_of(grid_, *volume_.tree), volume_.probes.size());
  std::array<std::vector<std::size_t>, most_tree_levels + 1> far;  // by their cells' level
  for (std::size_t i = 0; i < volume_.probes.size(); ++i) {
    LightProbe& probe = volume_.probes[i];
    if (in_tree_[i] == 0 || probe.state != LightProbe::State::moved) continue;
    const Vec3d place = lattice_point(grid_, lattice_[i]);
    if ((probe.position - place).length() <= most_move(grid_, levels[i].finest)) continue;
    probe.position = place;  // where it was inside of something
    probe.state = LightProbe::State::sound;
    far[std::size_t(levels[i].coarsest)].push_back(i);
  }
  for (int level = 0; level <= most_tree_levels; ++level)
    look_again(scene_, settling_, far[std::size_t(level)], reach_of(grid_, level), volume_);
}

void Refiner::light_new() {
  std::vector<LightProbe*> probes;
  for (const std::size_t number : unlit_)
    if (is_valid(volume_.probes[number])) probes.push_back(&volume_.probes[number]);
  unlit_.clear();
  counts_.lit += probes.size();
  if (!probes.empty()) light_(probes, counts_.rounds++);
}

Refiner::Test Refiner::test(std::size_t cell, const VolumeSampler& sampler) const {
  Difference mean;
  double weights = 0;
  std::array<double, 27> excess{}, weight{};
  for (std::size_t node = 0; node < 27; ++node) {
    const std::uint32_t number = known_.at(lattice_number(grid_, cells_[cell].place.node(node)));
    const LightProbe& probe = volume_.probes[number];
    if (!is_valid(probe)) continue;
    weight[node] = simpson_weight(node);
    weights += weight[node];
    if (in_tree_[number] != 0) continue;  // looked up as it is
    const Difference here = difference_at(volume_, sampler, probe);
    excess[node] = here.square - here.noise;
    mean.square += weight[node] * here.square;
    mean.noise += weight[node] * here.noise;
  }
  Test found;
  found.is_wrong = mean.square - mean.noise > wanted_square_ * weights && mean.square > 2 * mean.noise;
  for (std::size_t child = 0; child < 8; ++child) {
    double sum = 0, corners = 0;
    for (std::size_t k = 0; k < 8; ++k) {
      const std::size_t node = node_of_child(child, k);
      sum += weight[node] > 0 ? excess[node] : 0;
      corners += weight[node] > 0 ? 1 : 0;
    }
    if (sum > doubt * doubt * wanted_square_ * corners) found.doubtful |= std::uint8_t(1U << child);
  }
  return found;
}

void Refiner::divide(std::size_t cell) {
  if (volume_.tree->cells[cell].children != 0) return;
  const CellPlace place = cells_[cell].place;
  const CellNodes nodes = nodes_of(cell);
  for (const std::uint32_t probe : nodes) in_tree_[probe] = 1;
  divide_cell(*volume_.tree, cell, nodes);
  ++counts_.divided;
  for (std::size_t child = 0; child < 8; ++child) {
    const bool is_doubtful = (cells_[cell].doubtful >> child & 1) != 0;
    if (place.level + 1 < options_.levels && is_doubtful) waiting_.push_back(cells_.size());
    CellPlace within{place.level + 1, place.low};
    for (std::size_t axis = 0; axis < 3; ++axis)
      within.low[axis] += static_cast<int>(child >> axis & 1) * (place.size() / 2);
    cells_.push_back({within});
  }
  for (std::size_t beside = 0; beside < 27; ++beside) {
    LatticePlace at = place.low;
    int moved = 0;
    bool is_outside = false;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const int step = node_steps(beside)[axis] - 1;
      moved += std::abs(step);
      at[axis] += step * place.size();
      is_outside |= at[axis] < 0 || at[axis] >= (grid_.counts[axis] - 1) * lattice_steps;
    }
    if (moved == 0 || moved == 3 || is_outside) continue;
    const std::size_t neighbour = cell_at(grid_, *volume_.tree, at, place.level);
    if (cells_[neighbour].place.level == place.level) continue;
    if (cells_[neighbour].tested) {
      divide(neighbour);
    } else if (!cells_[neighbour].forced) {
      cells_[neighbour].forced = true;
      waiting_.push_back(neighbour);  // once more, where it waits already
    }
  }
}

/// Traced for tests alone.
void Refiner::drop_unused() {
  const auto texels =
      static_cast<std::size_t>(volume_.depths.side) * static_cast<std::size_t>(volume_.depths.side);
  std::vector<std::uint32_t> number(volume_.probes.size(), no_probe);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < volume_.probes.size(); ++i) {
    if (in_tree_[i] == 0) continue;
    number[i] = static_cast<std::uint32_t>(kept);
    volume_.probes[kept] = volume_.probes[i];
    for (std::vector<float>* maps : {&volume_.depths.mean, &volume_.depths.square})
      std::copy_n(maps->begin() + std::ptrdiff_t(i * texels), texels,
                  maps->begin() + std::ptrdiff_t(kept * texels));
    ++kept;
  }
  volume_.probes.resize(kept);
  volume_.depths.mean.resize(kept * texels);
  volume_.depths.square.resize(kept * texels);
  for (ProbeCell& cell : volume_.tree->cells)
    for (std::uint32_t& corner : cell.corners) corner = number[corner];
}

/// Probes whose cells were divided need not look as far as before: variances of distances that nothing lies
/// between are smaller, and bounds on what is visible sharper.
void Refiner::shorten_reach() {
  if (volume_.depths.side == 0) return;
  const auto levels = levels_of_probes(leaves_of(grid_, *volume_.tree), volume_.probes.size());
  std::array<std::vector<std::size_t>, most_tree_levels + 1> of_level;
  for (std::size_t i = 0; i < levels.size(); ++i) {
    if (in_tree_[i] != 0 && levels[i].coarsest > first_level(lattice_[i]))
      of_level[std::size_t(levels[i].coarsest)].push_back(i);
  }
  for (int level = 1; level <= most_tree_levels; ++level)
    look_again(scene_, settling_, of_level[std::size_t(level)], reach_of(grid_, level), volume_);
}

RefineCounts Refiner::refine() {
  const LeakTest leaks = settling_.depth ? LeakTest::visibility : LeakTest::validity;
  while (!waiting_.empty()) {
    std::vector<std::size_t> cells = std::exchange(waiting_, {});
    std::ranges::sort(cells);
    cells.erase(std::ranges::unique(cells).begin(), cells.end());
    std::erase_if(cells, [&](std::size_t cell) {
      return cells_[cell].tested || (is_buried(cell) && !cells_[cell].forced);
    });
    std::ranges::stable_sort(cells, {}, [&](std::size_t cell) { return cells_[cell].place.level; });
    if (volume_.probes.size() + 19 * cells.size() > std::size_t(most_probes)) {
      log::warn("'{}': no more cells are divided, {} probes are the most; raise --error", volume_.name,
                most_probes);
      break;
    }
    make_probes(cells);
    light_new();
    fill_probes(volume_);
    const VolumeSampler sampler(volume_, ProbeEncoding::cube, leaks);
    std::vector<Test> tests(cells.size());
    tbb::task_arena arena(settling_.threads > 0 ? settling_.threads : tbb::task_arena::automatic);
    arena.execute([&] {
      tbb::parallel_for(std::size_t{0}, cells.size(),
                        [&](std::size_t i) { tests[i] = test(cells[i], sampler); });
    });
    for (std::size_t i = 0; i < cells.size(); ++i) {
      cells_[cells[i]].tested = true;
      cells_[cells[i]].doubtful = tests[i].doubtful;
    }
    for (std::size_t i = 0; i < cells.size(); ++i)
      if (tests[i].is_wrong || cells_[cells[i]].forced) divide(cells[i]);
    call_back();
  }
  shorten_reach();
  drop_unused();
  return counts_;
}

}  // namespace

RefineCounts refine_probes(const TraceScene& scene, const SettleOptions& settling,
                           const RefineOptions& options, const LightProbes& light, ProbeVolume& volume) {
  if (options.error <= 0 || !volume.grid) return {};
  if (std::ranges::any_of(volume.grid->counts, [](int count) { return count < 2; })) {
    log::warn("'{}' is one probe thick: none are added", volume.name);
    return {};
  }
  return Refiner(scene, settling, options, light, volume).refine();
}

}  // namespace rnmbake
