#include "ssbump/heights/height_mesh.h"

#include <algorithm>
#include <cmath>

namespace rnmbake {
namespace {

constexpr double reach_of_range = 64;
constexpr int most_periods = 16;

/// Row or column of vertices: its position in texels, and the two texels whose heights it interpolates.
struct Line {
  float place = 0;
  int first = 0, second = 0;
  float share = 0;  // of the second
};

/// Places past a border that goes on, each twice as far as the one before: long and narrow triangles are not
/// exact in single precision.
std::vector<float> skirt_of(double reach) {
  std::vector<float> places;
  for (double step = 1, place = 0; place < reach; step *= 2)
    places.push_back(static_cast<float>(place += step));
  return places;
}

/// Rows or columns through texel centres; the first and the last lie beyond the borders.
std::vector<Line> texel_lines(int count, WrapMode beyond, double reach) {
  std::vector<Line> lines;
  const auto last = static_cast<float>(count - 1);
  const std::vector<float> skirt = beyond == WrapMode::none ? skirt_of(reach) : std::vector<float>{};
  lines.reserve(2 * skirt.size() + static_cast<std::size_t>(count) + 2);
  for (const float place : skirt) lines.push_back({-place, 0});
  std::ranges::reverse(lines);
  if (beyond == WrapMode::mirror)
    lines.push_back({-1, 0});  // on both sides: a turned copy has its own turned
  for (int i = 0; i < count; ++i) lines.push_back({static_cast<float>(i), i});
  for (const float place : skirt) lines.push_back({last + place, count - 1});
  if (beyond == WrapMode::wrap) lines.push_back({last + 1, 0});
  if (beyond == WrapMode::mirror) lines.push_back({last + 1, count - 1});
  return lines;
}

/// Starts of a patch's cells, as shares of its side.
std::vector<float> cells_of(PatchCuts cuts) {
  constexpr float narrow = 1.0F / 32;
  if (cuts == PatchCuts::one) return {0};
  if (cuts == PatchCuts::three) return {0, narrow, 1 - narrow};
  return {0, narrow, 0.25F, 0.75F, 1 - narrow};
}

std::vector<Line> lines_of(int count, WrapMode beyond, double reach, PatchCuts cuts) {
  const std::vector<Line> whole = texel_lines(count, beyond, reach);
  std::vector<Line> lines;
  for (std::size_t i = 0; i + 1 < whole.size(); ++i) {
    const Line &a = whole[i], &b = whole[i + 1];
    // Leaves patches of one height along the axis whole.
    for (const float share : cells_of(a.first == b.first ? PatchCuts::one : cuts))
      lines.push_back({a.place + share * (b.place - a.place), a.first, b.first, share});
  }
  lines.push_back(whole.back());
  lines.back().second = lines.back().first;
  return lines;
}

float height_of(const FloatImage& heights, const Line& column, const Line& row) {
  const auto across = [&](int y) {
    return std::lerp(heights.texel(column.first, y)[0], heights.texel(column.second, y)[0], column.share);
  };
  return std::lerp(across(row.first), across(row.second), row.share);
}

struct Placed {
  float shift = 0;
  int sign = 1;
};

/// The field itself, then its neighbours, the nearer ones first.
std::vector<Placed> placed(int count, WrapMode beyond, double reach) {
  std::vector<Placed> all{{}};
  if (beyond == WrapMode::none) return all;
  const auto periods = static_cast<int>(std::ceil(reach / count));
  const auto add = [&](int period) {
    const auto start = static_cast<float>(period * count);
    const bool turned = beyond == WrapMode::mirror && period % 2 != 0;
    all.push_back(turned ? Placed{start + static_cast<float>(count - 1), -1} : Placed{start, 1});
  };
  for (int period = 1; period <= periods; ++period) {
    add(period);
    add(-period);
  }
  return all;
}

}  // namespace

HeightMesh height_mesh(const HeightField& field, PatchCuts cuts) {
  const double reach = useful_reach(field);
  const std::vector<Line> columns = lines_of(field.width(), field.x, reach, cuts);
  const std::vector<Line> rows = lines_of(field.height(), field.y, reach, cuts);
  HeightMesh mesh;
  for (const Line& row : rows) {
    for (const Line& column : columns)
      mesh.positions.emplace_back(column.place, -row.place, height_of(field.heights, column, row));
  }
  const auto across = static_cast<std::uint32_t>(columns.size());
  for (std::uint32_t y = 0; y + 1 < rows.size(); ++y) {
    for (std::uint32_t x = 0; x + 1 < across; ++x) {
      const std::uint32_t a = y * across + x, b = a + across, c = b + 1,
                          d = a + 1;  // round from the upper left
      const auto middle = static_cast<std::uint32_t>(mesh.positions.size());
      const auto& p = mesh.positions;
      mesh.positions.push_back((p[a] + p[b] + p[c] + p[d]) / 4.0F);
      for (const auto& [from, to] : {std::pair(a, b), {b, c}, {c, d}, {d, a}})
        mesh.triangles.push_back({from, to, middle});
    }
  }
  return mesh;
}

std::vector<HeightCopy> height_copies(const HeightField& field, double reach) {
  std::vector<HeightCopy> copies;
  for (const Placed& y : placed(field.height(), field.y, reach)) {
    for (const Placed& x : placed(field.width(), field.x, reach))
      copies.push_back({x.shift, -y.shift, x.sign, y.sign});
  }
  return copies;
}

double useful_reach(const HeightField& field) {
  const auto [low, high] = std::minmax_element(field.heights.data().begin(), field.heights.data().end());
  const double wanted = reach_of_range * (double{*high} - *low);
  const double shorter = std::min(field.width(), field.height()),
               longer = std::max(field.width(), field.height());
  return std::clamp(wanted, longer, std::max(longer, most_periods * shorter));
}

}  // namespace rnmbake
