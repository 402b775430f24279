#include "unwrap/pack.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace rnmbake {
namespace {

constexpr double step = 0.85;         // between two scales that are tried
constexpr int refinements = 4;        // halvings of the last step
constexpr double least_scale = 1e-3;  // of the scale at which charts would fill the square

/// Columns of the square: fine enough for the number of charts.
int columns_for(std::size_t charts) {
  return static_cast<int>(std::clamp(32 * std::sqrt(static_cast<double>(charts)), 512.0, 4096.0));
}

/// What a chart with its margin occupies of each of its columns, in columns, from its own lower left.
struct Outline {
  std::vector<double> low, high;  // low > high: nothing
};

class Packer {
 public:
  Packer(const Mesh& mesh, const Charts& charts, double margin)
      : mesh_(mesh),
        charts_(charts),
        columns_(columns_for(charts.charts.size())),
        pad_(static_cast<int>(std::ceil(margin * columns_ / 2 - 1e-9))),
        order_(charts.charts.size()) {
    std::iota(order_.begin(), order_.end(), std::size_t{0});
    std::stable_sort(order_.begin(), order_.end(), [&](std::size_t a, std::size_t b) {
      return charts.charts[a].size.y > charts.charts[b].size.y;
    });
  }

  Packing pack() {
    double scale = largest_scale();
    const double least = pad_ > 0 ? least_scale * scale : 0;
    while (!place_all(scale)) {
      scale *= step;
      if (!(scale > least)) return {};
    }
    auto best = std::pair(scale, places_);
    double low = scale, high = scale / step;
    for (int i = 0; i < refinements; ++i) {
      const double middle = 0.5 * (low + high);
      const bool fits = place_all(middle);
      (fits ? low : high) = middle;
      if (fits) best = {middle, places_};
    }
    for (Vec2d& place : best.second) place /= columns_;
    return {best.first / columns_, std::move(best.second)};
  }

 private:
  /// Columns for a world unit at which something must stand over.
  [[nodiscard]] double largest_scale() const {
    double longest = 0;
    for (const Chart& chart : charts_.charts) longest = std::max(longest, chart.size.y);
    const double room = std::max(1.0, columns_ - 2.0 * pad_);
    return std::min(columns_ / std::sqrt(charts_.world_area) / std::sqrt(std::cos(widest_angle)),
                    room / longest);
  }

  /// Whether the charts with their margins have less area than the square: the rest of the trials is waste.
  bool may_fit(double scale) {
    double area = 0;
    for (const Chart& chart : charts_.charts) {
      draw_outline(chart, scale);
      for (std::size_t c = 0; c < outline_.low.size(); ++c)
        area += std::max(0.0, outline_.high[c] - outline_.low[c]);
    }
    return area <= static_cast<double>(columns_) * columns_;
  }

  bool place_all(double scale) {
    if (!may_fit(scale)) return false;
    skyline_.assign(static_cast<std::size_t>(columns_), 0.0);
    places_.assign(charts_.charts.size(), Vec2d(0, 0));
    for (const std::size_t chart : order_) {
      if (!place(chart, scale)) return false;
    }
    return true;
  }

  bool place(std::size_t chart, double scale) {
    draw_outline(charts_.charts[chart], scale);
    const double height = charts_.charts[chart].size.y * scale + 2 * pad_;
    const std::size_t width = outline_.low.size();
    if (width > skyline_.size()) return false;
    double best = columns_ - height + 1e-9;
    std::size_t where = skyline_.size();
    for (std::size_t x = 0; x + width <= skyline_.size(); ++x) {
      double y = 0;
      for (std::size_t c = 0; c < width && y < best; ++c) y = std::max(y, skyline_[x + c] - outline_.low[c]);
      if (y >= best) continue;
      best = y;
      where = x;
    }
    if (where == skyline_.size()) return false;
    for (std::size_t c = 0; c < width; ++c)
      skyline_[where + c] = std::max(skyline_[where + c], best + outline_.high[c]);
    places_[chart] = {static_cast<double>(where) + pad_, best + pad_};
    return true;
  }

  /// The chart's own outline, then widened by the padding on all sides.
  void draw_outline(const Chart& chart, double scale) {
    const auto width = static_cast<std::size_t>(std::floor(chart.size.x * scale)) + 1;
    constexpr double far = std::numeric_limits<double>::max();
    bare_.low.assign(width, far);
    bare_.high.assign(width, -far);
    for (const std::uint32_t polygon : chart.polygons) {
      const std::uint32_t start = mesh_.polygon_start[polygon], size = mesh_.polygon_size[polygon];
      for (std::uint32_t k = 0; k < size; ++k)
        draw_edge(charts_.at[start + k] * scale, charts_.at[start + (k + 1) % size] * scale);
    }
    const std::size_t padding = 2 * static_cast<std::size_t>(pad_);
    outline_.low.assign(width + padding, far);
    outline_.high.assign(width + padding, -far);
    for (std::size_t c = 0; c < width; ++c) {
      for (std::size_t to = c; to <= c + padding; ++to) {
        outline_.low[to] = std::min(outline_.low[to], bare_.low[c]);
        outline_.high[to] = std::max(outline_.high[to], bare_.high[c] + 2 * pad_);
      }
    }
  }

  void draw_edge(Vec2d a, Vec2d b) {
    if (a.x > b.x) std::swap(a, b);
    const auto last = static_cast<double>(bare_.low.size() - 1);
    const double slope = b.x > a.x ? (b.y - a.y) / (b.x - a.x) : 0;
    const auto draw = [&](std::size_t column, double y) {
      bare_.low[column] = std::min(bare_.low[column], y);
      bare_.high[column] = std::max(bare_.high[column], y);
    };
    const auto first_column = static_cast<std::size_t>(std::clamp(std::floor(a.x), 0.0, last));
    const auto last_column = static_cast<std::size_t>(std::clamp(std::floor(b.x), 0.0, last));
    draw(first_column, a.y);
    draw(last_column, b.y);
    for (std::size_t border = first_column + 1; border <= last_column; ++border) {
      const double y = a.y + (static_cast<double>(border) - a.x) * slope;
      draw(border - 1, y);
      draw(border, y);
    }
  }

  const Mesh& mesh_;
  const Charts& charts_;
  int columns_, pad_;
  std::vector<std::size_t> order_;
  std::vector<double> skyline_;
  std::vector<Vec2d> places_;
  Outline bare_, outline_;
};

}  // namespace

Packing pack(const Mesh& mesh, const Charts& charts, double margin) {
  return Packer(mesh, charts, margin).pack();
}

}  // namespace rnmbake
