#include "ssbump/heights/bilateral.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <vector>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

namespace rnmbake {
namespace {

constexpr int lanes = 8, block_side = 4 * lanes;  // texels side by side
constexpr int band_rows = 32;
using Lanes [[gnu::vector_size(lanes * sizeof(float))]] = float;

struct Tap {
  int row = 0, column = 0;  // from the disc's corner, so never negative
  float weight = 0;
};

std::vector<Tap> disc(int radius) {
  std::vector<Tap> taps;
  const double sigma = radius / 2.0;
  for (int y = -radius; y <= radius; ++y) {
    for (int x = -radius; x <= radius; ++x) {
      const int square = x * x + y * y;
      if (square > radius * radius) continue;
      taps.push_back({y + radius, x + radius, static_cast<float>(std::exp(-square / (2 * sigma * sigma)))});
    }
  }
  return taps;
}

/// Rows of heights padded by the disc's radius on each side, in units of the edge.
class Padded {
 public:
  Padded(const HeightField& field, int begin, int end, int radius, float edge)
      : stride_(static_cast<std::size_t>(field.width() + 2 * radius + block_side)),
        rows_(stride_ * static_cast<std::size_t>(end - begin + 2 * radius)) {
    for (int y = begin - radius; y < end + radius; ++y) {
      const float* from = field.heights.texel(0, texel_beyond(y, field.height(), field.y)).data();
      float* to = row(y - begin + radius);
      const auto copy = [&](int x, int column) { to[x + radius] = from[column] / edge; };
      for (int x = -radius; x < 0; ++x) copy(x, texel_beyond(x, field.width(), field.x));
      for (int x = 0; x < field.width(); ++x) copy(x, x);
      for (int x = field.width(); x < field.width() + radius; ++x)
        copy(x, texel_beyond(x, field.width(), field.x));
    }
  }
  [[nodiscard]] float* row(int y) { return &rows_[stride_ * static_cast<std::size_t>(y)]; }
  [[nodiscard]] std::size_t stride() const { return stride_; }

 private:
  std::size_t stride_;
  std::vector<float> rows_;
};

/// Change in height of block_side texels from `centre` on, in units of the edge; `corner` is the texel at the
/// disc's upper left of the first of them.
[[gnu::target_clones("avx2", "default")]] void filter_block(const float* corner, const float* centre,
                                                            const std::vector<std::ptrdiff_t>& offsets,
                                                            const std::vector<Tap>& taps, float* out) {
  constexpr int vectors = block_side / lanes;
  Lanes middle[vectors], weight[vectors], moved[vectors];
  std::memcpy(middle, centre, sizeof(middle));
  for (int v = 0; v < vectors; ++v) weight[v] = moved[v] = Lanes{};
  for (std::size_t i = 0; i < taps.size(); ++i) {
    const float* from = corner + offsets[i];
    for (int v = 0; v < vectors; ++v) {
      Lanes height;
      std::memcpy(&height, from + v * lanes, sizeof(height));
      const Lanes difference = height - middle[v];
      Lanes likeness = 1.0F - difference * difference;
      likeness = likeness > 0.0F ? likeness : Lanes{};
      const Lanes share = likeness * likeness * taps[i].weight;
      weight[v] += share;
      moved[v] += share * difference;
    }
  }
  for (int v = 0; v < vectors; ++v) moved[v] /= weight[v];
  std::memcpy(out, moved, sizeof(moved));
}

class Filter {
 public:
  Filter(const HeightField& field, const BilateralOptions& options)
      : field_(field), radius_(options.radius), edge_(options.edge), taps_(disc(options.radius)) {}

  void rows(int begin, int end, FloatImage& out) const {
    Padded padded(field_, begin, end, radius_, edge_);
    std::vector<std::ptrdiff_t> offsets;
    for (const Tap& tap : taps_)
      offsets.push_back(static_cast<std::ptrdiff_t>(padded.stride()) * tap.row + tap.column);
    std::vector<float> block(block_side);
    for (int y = begin; y < end; ++y) {
      const float* corner = padded.row(y - begin);
      const float* centre = padded.row(y - begin + radius_) + radius_;
      const float* from = field_.heights.texel(0, y).data();
      float* to = out.texel(0, y).data();
      for (int x = 0; x < field_.width(); x += block_side) {
        filter_block(corner + x, centre + x, offsets, taps_, block.data());
        const int count = std::min(block_side, field_.width() - x);
        for (int i = 0; i < count; ++i) to[x + i] = from[x + i] + edge_ * block[static_cast<std::size_t>(i)];
      }
    }
  }

 private:
  const HeightField& field_;
  int radius_;
  float edge_;
  std::vector<Tap> taps_;
};

}  // namespace

FloatImage bilateral(const HeightField& field, const BilateralOptions& options,
                     const std::function<void(double)>& progress) {
  if (options.radius <= 0 || !(options.edge > 0)) return field.heights;
  FloatImage out(field.width(), field.height(), 1);
  const Filter filter(field, options);
  std::atomic<int> rows_done = 0;
  const int bands = (field.height() + band_rows - 1) / band_rows;
  tbb::task_arena arena(options.threads > 0 ? options.threads : tbb::task_arena::automatic);
  arena.execute([&] {
    tbb::parallel_for(0, bands, [&](int band) {
      const int begin = band * band_rows, end = std::min(begin + band_rows, field.height());
      filter.rows(begin, end, out);
      const int done = rows_done += end - begin;
      if (progress) progress(static_cast<double>(done) / field.height());
    });
  });
  return out;
}

}  // namespace rnmbake
