#include "pipeline/ssbump/direction_files.h"

#include <algorithm>

namespace rnmbake {
namespace {

constexpr int direction_rows_at_once = 64;

}  // namespace

std::vector<WeightRange> write_directions(const HeightField& field, const DirectionOptions& options,
                                          PictureWriter& writer, const std::function<void(double)>& progress,
                                          const std::function<bool()>& stop) {
  const DirectionRows directions(field, options);
  WeightRanges ranges;
  for (int begin = 0; begin < field.height(); begin += direction_rows_at_once) {
    const int end = std::min(begin + direction_rows_at_once, field.height());
    const FloatImage rows = directions.rows(begin, end, stop);
    if (stop()) break;
    ranges.add(rows);
    writer.write(begin, end, rows.data());
    progress(double(end) / field.height());
  }
  return ranges.ranges();
}

}  // namespace rnmbake
