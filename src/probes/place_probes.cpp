#include "probes/place_probes.h"

#include "base/error.h"
#include "base/files.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>
#include <string_view>

namespace rnmbake {
namespace {

/// The numbers of a line; nothing where something else is in it.
std::optional<std::vector<double>> numbers_in(std::string_view line) {
  constexpr std::string_view between = " \t\r,;";
  std::vector<double> numbers;
  while (true) {
    const std::size_t start = line.find_first_not_of(between);
    if (start == std::string_view::npos) return numbers;
    line.remove_prefix(start);
    double number = 0;
    const auto [end, error] = std::from_chars(line.data(), line.data() + line.size(), number);
    if (error != std::errc() || !std::isfinite(number)) return std::nullopt;
    line.remove_prefix(static_cast<std::size_t>(end - line.data()));
    if (!line.empty() && between.find(line.front()) == std::string_view::npos) return std::nullopt;
    numbers.push_back(number);
  }
}

}  // namespace

ProbeBounds parse_bounds(const std::string& text) {
  const auto numbers = numbers_in(text);
  if (!numbers || numbers->size() != 6)
    fail(ExitCode::usage, "--bounds {}: give two corners, x0,y0,z0,x1,y1,z1, or auto", text);
  const auto& n = *numbers;
  ProbeBounds bounds;
  for (int axis = 0; axis < 3; ++axis) {
    const auto [low, high] = std::minmax(n[std::size_t(axis)], n[std::size_t(axis) + 3]);
    bounds.low[axis] = low;
    bounds.high[axis] = high;
  }
  return bounds;
}

ProbeGrid grid_in(const ProbeBounds& bounds, std::optional<double> spacing, double wanted, int levels) {
  const Vec3d size = bounds.high - bounds.low;
  const double longest = std::max({size.x, size.y, size.z});
  const double area = size.x * size.y + size.y * size.z + size.z * size.x;
  if (!(longest > 0) || !(area > 1e-9 * longest * longest)) {
    fail(ExitCode::invalid_input,
         "the box of the probes, {:g} x {:g} x {:g}, is flat; give one by --bounds x0,y0,z0,x1,y1,z1", size.x,
         size.y, size.z);
  }
  Vec3d filled = size;  // a flat box gets a layer of probes
  for (int axis = 0; axis < 3; ++axis) filled[axis] = std::max(size[axis], 1e-3 * longest);
  const double step = spacing.value_or(std::cbrt(filled.x * filled.y * filled.z / wanted));
  ProbeGrid grid;
  double probes = 1;
  for (int axis = 0; axis < 3; ++axis) {
    // `cells` of them between probes, 1 / 2^levels of one for both ends.
    const double ends = std::ldexp(1.0, -levels);
    const double cells =
        size[axis] > 0 ? std::max(levels > 0 ? 1.0 : 0.0, std::round(size[axis] / step - ends)) : 0;
    probes *= cells + 1;
    if (probes > most_probes) continue;
    grid.counts[std::size_t(axis)] = static_cast<int>(cells) + 1;
    const double width = size[axis] > 0 ? size[axis] / (cells + ends) : step;
    grid.steps[std::size_t(axis)] = Vec3d(0);
    grid.steps[std::size_t(axis)][axis] = width;
    grid.first[axis] = bounds.low[axis] + (size[axis] > 0 ? width * ends / 2 : 0);
  }
  if (probes > most_probes) {
    fail(ExitCode::invalid_input,
         "{:.3g} probes, {:g} apart in a box of {:g} x {:g} x {:g}; {} are the most: raise --spacing, or "
         "give a "
         "smaller box by --bounds",
         probes, step, size.x, size.y, size.z, most_probes);
  }
  return grid;
}

ProbeGrid grid_in_cube(const Mat44& to_world, const std::array<int, 3>& counts) {
  ProbeGrid grid;
  grid.counts = counts;
  Vec3d first(0);
  for (int axis = 0; axis < 3; ++axis) {
    const double half = 1.0 / counts[std::size_t(axis)];
    Vec3d step(0);
    step[axis] = 2 * half;
    first[axis] = -1 + half;
    to_world.multDirMatrix(step, grid.steps[std::size_t(axis)]);
  }
  to_world.multVecMatrix(first, grid.first);
  return grid;
}

std::vector<Vec3d> read_points(const std::filesystem::path& file) {
  std::istringstream lines(read_text(file));
  std::vector<Vec3d> points;
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    if (line.starts_with('#')) continue;
    const auto numbers = numbers_in(line);
    if (numbers && numbers->empty()) continue;
    if (!numbers && number == 1) continue;  // names of the columns
    if (!numbers || numbers->size() != 3)
      fail(ExitCode::invalid_input, "{}:{}: a point is three numbers, x, y and z", file.string(), number);
    points.emplace_back((*numbers)[0], (*numbers)[1], (*numbers)[2]);
    if (points.size() > std::size_t(most_probes))
      fail(ExitCode::invalid_input, "{} has more than {} points", file.string(), most_probes);
  }
  if (points.empty())
    fail(ExitCode::invalid_input, "{} has no points: x, y and z in each line", file.string());
  return points;
}

ProbeVolume empty_volume(std::string name, const ProbeGrid& grid) {
  ProbeVolume volume{std::move(name), grid, std::vector<LightProbe>(grid.size()), {}};
  for (int z = 0; z < grid.counts[2]; ++z)
    for (int y = 0; y < grid.counts[1]; ++y)
      for (int x = 0; x < grid.counts[0]; ++x)
        volume.probes[grid.index(x, y, z)].position = grid.place(x, y, z);
  return volume;
}

ProbeVolume empty_volume(std::string name, const std::vector<Vec3d>& points) {
  ProbeVolume volume{std::move(name), std::nullopt, std::vector<LightProbe>(points.size()), {}};
  for (std::size_t i = 0; i < points.size(); ++i) volume.probes[i].position = points[i];
  return volume;
}

}  // namespace rnmbake
