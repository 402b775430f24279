#include "pipeline/ssbump/direction_files.h"

#include <algorithm>

namespace rnmbake {
namespace {

constexpr int direction_rows_at_once = 64;

void widen(std::vector<WeightRange>& ranges, const FloatImage& rows, bool are_first) {
  for (std::size_t c = 0; c < ranges.size(); ++c) {
    WeightRange& range = ranges[c];
    if (are_first) range.least = range.greatest = rows.data()[c];
    for (std::size_t at = c; at < rows.data().size(); at += ranges.size()) {
      range.least = std::min(range.least, rows.data()[at]);
      range.greatest = std::max(range.greatest, rows.data()[at]);
      range.mean += double{rows.data()[at]};
    }
  }
}

}  // namespace

std::vector<WeightRange> write_directions(const HeightField& field, const DirectionOptions& options,
                                          PictureWriter& writer, const std::function<void(double)>& progress,
                                          const std::function<bool()>& stop) {
  std::vector<WeightRange> ranges(options.set.directions.size());
  for (int begin = 0; begin < field.height(); begin += direction_rows_at_once) {
    const int end = std::min(begin + direction_rows_at_once, field.height());
    const FloatImage rows = direction_rows(field, options, begin, end, stop);
    if (stop()) return ranges;
    widen(ranges, rows, begin == 0);
    writer.write(begin, end, rows.data());
    progress(double(end) / field.height());
  }
  for (WeightRange& range : ranges) range.mean /= static_cast<double>(field.heights.texels());
  return ranges;
}

}  // namespace rnmbake
