#include "image/metrics.h"

#include "base/error.h"
#include "base/numeric/running_moments.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace rnmbake {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr int largest_tile = 8;
constexpr double fewest_tiles = 16;
constexpr double few_paths = 4;       // that make up the noise of a mean: too few to tell it
constexpr double small_move = 0.003;  // of a mean: what a path that moves it by less does matters to nobody

int tile_size(const FloatImage& image) {
  const auto size = static_cast<int>(std::sqrt(double(image.texels()) / fewest_tiles));
  return std::clamp(size, 1, largest_tile);
}

void check_sizes(const FloatImage& picture, const FloatImage* other, bool channels_too) {
  if (other == nullptr) return;
  if (other->width() == picture.width() && other->height() == picture.height() &&
      (!channels_too || other->channels() == picture.channels()))
    return;
  fail(ExitCode::invalid_input,
       "cannot compare pictures of {}x{} ({} channels) and {}x{} ({}); bake both at one size",
       picture.width(), picture.height(), picture.channels(), other->width(), other->height(),
       other->channels());
}

/// 97.5 % point of Student's t: exact for 1 and 2 degrees of freedom, else Cornish and Fisher's expansion
/// (within 1 % at 3, 0.1 % from 5 on).
double student_quantile(double freedom) {
  constexpr double z = 1.959963984540054;
  if (freedom < 1.5) return 12.7062;
  if (freedom < 2.5) return 4.3027;
  const double z3 = z * z * z, z5 = z3 * z * z, z7 = z5 * z * z;
  return z + (z3 + z) / (4 * freedom) + (5 * z5 + 16 * z3 + 3 * z) / (96 * freedom * freedom) +
         (3 * z7 + 19 * z5 + 17 * z3 - 15 * z) / (384 * freedom * freedom * freedom);
}

double ratio(double part, double whole) {
  if (part == 0) return 0;  // black on both sides is no error
  return part / whole;
}

/// 0 for 0, where the numbers to be scaled are 0, too, or already infinite.
double inverse(double value) {
  return value == 0 ? 0 : 1 / value;
}

double sum_of_squares(double a, double b) {
  return a * a + b * b;
}

/// The square of the value in an interval that is nearest to 0.
double least_square(const Statistic& statistic) {
  const double nearest = statistic.low95 > 0 ? statistic.low95 : statistic.high95 < 0 ? statistic.high95 : 0;
  return nearest * nearest;
}

/// The square root of an estimate that may have come out below 0.
Statistic root(const Statistic& square) {
  const auto positive_root = [](double value) { return value > 0 ? std::sqrt(value) : 0; };
  return {positive_root(square.value), positive_root(square.low95), positive_root(square.high95)};
}

double percentile(std::vector<float>& values, double share) {
  if (values.empty()) return 0;
  const auto rank = static_cast<std::size_t>(std::ceil(share * double(values.size())));
  const auto place = values.begin() + static_cast<std::ptrdiff_t>(std::max<std::size_t>(rank, 1) - 1);
  std::ranges::nth_element(values, place);
  return *place;
}

}  // namespace

bool counts(const std::vector<CountedWhere>& counted, std::size_t texel) {
  return std::ranges::all_of(counted, [&](const CountedWhere& where) {
    return where.mask == nullptr || where.mask->data()[texel] >= where.least;
  });
}

NoisyValue noisy_value(const ComparedPicture& picture, std::size_t index) {
  const double first = picture.value->data()[index];
  if (picture.second != nullptr) {
    const double second = picture.second->data()[index];
    const double half = 0.5 * (first - second);
    return {0.5 * (first + second), half * half};
  }
  if (picture.standard_error == nullptr) return {first, 0};
  const double error = picture.standard_error->data()[index];
  return {first, error * error};
}

void PictureComparison::add(const ComparedPicture& candidate, const ComparedPicture& reference,
                            const std::vector<CountedWhere>& counted) {
  const FloatImage& picture = *candidate.value;
  for (const FloatImage* other : {candidate.second, candidate.standard_error, reference.value,
                                  reference.second, reference.standard_error})
    check_sizes(picture, other, true);
  for (const CountedWhere& where : counted) check_sizes(picture, where.mask, false);
  if (picture.empty()) return;

  const int size = tile_size(picture);
  const int columns = (picture.width() + size - 1) / size, rows = (picture.height() + size - 1) / size;
  std::vector<Tile> tiles(static_cast<std::size_t>(columns) * rows);
  LargestNoise largest;
  for (std::size_t texel = 0; texel < picture.texels(); ++texel) {
    if (!counts(counted, texel)) continue;
    const int x = static_cast<int>(texel % picture.width()), y = static_cast<int>(texel / picture.width());
    add_texel(candidate, reference, x, y, tiles[static_cast<std::size_t>(y / size) * columns + x / size],
              largest);
  }
  const bool comparable = candidate.paths > 0 && reference.paths > 0;
  const double share = comparable ? reference.paths / candidate.paths : 0;  // 0: neither tells of the other
  rare_.take({std::max(largest.candidate, largest.reference * share),
              std::max(largest.reference, share > 0 ? largest.candidate / share : 0), largest.squared_error});
  std::ranges::copy_if(tiles, std::back_inserter(tiles_), [](const Tile& tile) { return tile.values > 0; });
  candidate_noise_known_ = candidate_noise_known_ && candidate.knows_noise();
  reference_noise_known_ = reference_noise_known_ && reference.knows_noise();
  ++pictures_;
}

void PictureComparison::add_texel(const ComparedPicture& candidate, const ComparedPicture& reference, int x,
                                  int y, Tile& tile, LargestNoise& largest) {
  const int channels = candidate.value->channels();
  const std::size_t first = (static_cast<std::size_t>(y) * candidate.value->width() + x) * channels;
  Tile texel;
  double square = 0, candidate_variance = 0, reference_variance = 0;
  LargestNoise noise;
  for (std::size_t index = first; index < first + channels; ++index) {
    const NoisyValue a = noisy_value(candidate, index), r = noisy_value(reference, index);
    const double error = a.value - r.value;
    square += error * error;
    texel.values += 1;
    texel.error += error;
    texel.reference += r.value;
    candidate_variance += a.variance;
    reference_variance += r.variance;
    noise.candidate += std::sqrt(a.variance);
    noise.reference += std::sqrt(r.variance);
  }
  texel.squared_error = square - candidate_variance - reference_variance;
  if (!std::isfinite(texel.squared_error) || !std::isfinite(texel.reference)) {
    ++non_finite_;
    return;
  }
  const double size = std::sqrt(square / channels);
  if (size > worst_.error) worst_ = {size, x, y, pictures_};
  errors_.push_back(static_cast<float>(size));
  tile += texel;
  largest = {std::max(largest.candidate, noise.candidate), std::max(largest.reference, noise.reference),
             std::max(largest.squared_error, std::abs(texel.squared_error))};
  candidate_variance_ += candidate_variance;
  reference_variance_ += reference_variance;
}

void PictureComparison::add(const PictureComparison& other) {
  if (other.worst_.error > worst_.error) {
    worst_ = other.worst_;
    worst_.picture += pictures_;
  }
  rare_.take(other.rare_);
  tiles_.insert(tiles_.end(), other.tiles_.begin(), other.tiles_.end());
  errors_.insert(errors_.end(), other.errors_.begin(), other.errors_.end());
  pictures_ += other.pictures_;
  non_finite_ += other.non_finite_;
  candidate_variance_ += other.candidate_variance_;
  reference_variance_ += other.reference_variance_;
  candidate_noise_known_ = candidate_noise_known_ && other.candidate_noise_known_;
  reference_noise_known_ = reference_noise_known_ && other.reference_noise_known_;
}

PictureMetrics PictureComparison::metrics() const {
  PictureMetrics result;
  result.texels = errors_.size();
  result.non_finite = non_finite_;
  if (errors_.empty()) return result;

  Tile sum;
  for (const Tile& tile : tiles_) sum += tile;
  const auto mean_reference = [](const Tile& s) { return s.reference / s.values; };
  const auto bias = [](const Tile& s) { return s.error / s.values; };
  const auto relative_bias = [](const Tile& s) { return ratio(s.error, s.reference); };
  const auto square = [](const Tile& s) { return s.squared_error / s.values; };
  const auto relative_square = [&](const Tile& s) {
    return ratio(square(s), mean_reference(s) * mean_reference(s));
  };
  result.reference_mean = mean_reference(sum);
  const Reach reach = jackknife(sum, bias);
  const double down = rare_.down / sum.values, up = rare_.up / sum.values;
  const double share = inverse(std::abs(result.reference_mean));
  result.bias = with_rare_path(reach, down, up);
  result.relative_bias = with_rare_path(jackknife(sum, relative_bias), down * share, up * share);
  const double rare = std::max(down, up);
  result.too_noisy = rare > small_move * std::abs(result.reference_mean) &&
                     few_paths * rare * rare > reach.standard_error * reach.standard_error;
  // A mean that a rare path may have moved so far is in the mean square, too.
  const double moved = least_square(with_rare_path(reach, 0, 0)) - least_square(result.bias);
  const double low = moved + rare_.squared / sum.values;
  result.rmse = root(with_rare_path(jackknife(sum, square), low, 0));
  result.relative_rmse = root(with_rare_path(jackknife(sum, relative_square), low * share * share, 0));

  std::vector<float> errors = errors_;
  result.p95 = percentile(errors, 0.95);
  result.p99 = percentile(errors, 0.99);
  result.max = worst_.error;
  result.max_x = worst_.x;
  result.max_y = worst_.y;
  result.max_picture = worst_.picture;
  result.candidate_noise_known = candidate_noise_known_;
  result.reference_noise_known = reference_noise_known_;
  result.candidate_noise = std::sqrt(candidate_variance_ / sum.values);
  result.reference_noise = std::sqrt(reference_variance_ / sum.values);
  return result;
}

/// Leaves out one tile at a time; how much the result moves is what another scatter of tiles would do to it.
PictureComparison::Reach PictureComparison::jackknife(
    const Tile& sum, const std::function<double(const Tile&)>& estimate) const {
  const double value = estimate(sum);
  const double n = double(tiles_.size());
  if (tiles_.size() < 2) return {value, infinity, 1};
  RunningMoments<double> moments;
  double count = 0;
  for (const Tile& tile : tiles_) moments.add(estimate(sum - tile), ++count);
  return {value, std::sqrt(moments.squares * (n - 1) / n), student_quantile(n - 1)};
}

Statistic PictureComparison::with_rare_path(const Reach& reach, double down, double up) {
  const auto width = [&](double rare) {
    return rare + reach.quantile * std::sqrt(sum_of_squares(reach.standard_error, rare));
  };
  const double low = width(down), high = width(up);
  if (!std::isfinite(low + high)) return {reach.value, -infinity, infinity};
  return {reach.value, reach.value - low, reach.value + high};
}

void PictureComparison::RarePath::take(const RarePath& other) {
  up = std::max(up, other.up);
  down = std::max(down, other.down);
  squared = std::max(squared, other.squared);
}

PictureComparison::Tile& PictureComparison::Tile::operator+=(const Tile& other) {
  values += other.values;
  error += other.error;
  squared_error += other.squared_error;
  reference += other.reference;
  return *this;
}

PictureComparison::Tile PictureComparison::Tile::operator-(const Tile& other) const {
  return {values - other.values, error - other.error, squared_error - other.squared_error,
          reference - other.reference};
}

}  // namespace rnmbake
