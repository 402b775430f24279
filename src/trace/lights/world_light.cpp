#include "trace/lights/world_light.h"

#include "base/math.h"
#include "sampling/maps.h"
#include "sampling/orthonormal_basis.h"

#include <algorithm>
#include <cmath>

namespace rnmbake {
namespace {

/// Share of the sphere above a row: sin^2 of half the angle from the upper pole, which is exact near the
/// pole.
double share_above(int row, int rows) {
  const double sine = std::sin(pi / 2 * row / rows);
  return sine * sine;
}

/// Share of the sphere in a row. The lower half mirrors the upper one, so that no digits are lost at its
/// pole.
double share_of_row(int row, int rows) {
  const int upper = std::min(row, rows - 1 - row);
  return share_above(upper + 1, rows) - share_above(upper, rows);
}

/// The v coordinate within a row, uniform per solid angle for a uniform `u` (0: the row's upper edge).
float v_within(int row, int rows, float u) {
  const bool mirrored = row > rows - 1 - row;
  const int upper = std::min(row, rows - 1 - row);
  const double low = share_above(upper, rows), high = share_above(upper + 1, rows);
  const double share = low + (high - low) * double(mirrored ? 1 - u : u);
  const auto polar = static_cast<float>(2 * std::asin(std::sqrt(share)) / pi);
  return mirrored ? polar : 1 - polar;
}

/// Inverts a CDF: the cell that `u` falls in; `u` becomes the position within it.
int find_cell(const float* sums, int count, float& u) {
  const float* above = std::upper_bound(sums + 1, sums + count, u);
  const int cell = std::min(static_cast<int>(above - sums), count) - 1;
  u = std::clamp((u - sums[cell]) / (sums[cell + 1] - sums[cell]), 0.0F, 0.99999994F);
  return cell;
}

/// Makes a CDF of weights; returns their total.
double running_sums(const std::vector<double>& weights, float* sums) {
  double total = 0;
  for (const double weight : weights) total += weight;
  double sum = 0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    sums[i] = static_cast<float>(total > 0 ? sum / total : double(i) / double(weights.size()));
    sum += weights[i];
  }
  sums[weights.size()] = 1;
  return total;
}

}  // namespace

WorldLight::WorldLight(const DiffuseScene& scene) : constant_(scene.world.radiance) {
  if (scene.world.picture < 0) {
    average_ = mean_magnitude(constant_);
    return;
  }
  picture_ = &scene.pictures[scene.world.picture];
  build_table();
}

void WorldLight::build_table() {
  const int w = picture_->width, h = picture_->height;
  std::vector<double> across(std::size_t(w) * h), row(w), rows(h);
  // Bilinear filtering averaged over a texel: 3/4 of itself and 1/8 of each neighbour, on both axes.
  for (int y = 0; y < h; ++y) {
    const Vec3* texels = &picture_->texels[std::size_t(y) * w];
    for (int x = 0; x < w; ++x) {
      across[std::size_t(y) * w + x] = 0.75 * mean_magnitude(texels[x]) +
                                       0.125 * mean_magnitude(texels[(x + 1) % w]) +
                                       0.125 * mean_magnitude(texels[(x + w - 1) % w]);
    }
  }
  rows_.resize(h + 1);
  solid_angles_.resize(h);
  cells_.resize(std::size_t(h) * (w + 1));
  for (int y = 0; y < h; ++y) {
    const double* middle = &across[std::size_t(y) * w];
    const double* above = &across[std::size_t(std::max(y - 1, 0)) * w];
    const double* below = &across[std::size_t(std::min(y + 1, h - 1)) * w];
    for (int x = 0; x < w; ++x) row[x] = 0.75 * middle[x] + 0.125 * (above[x] + below[x]);
    const double share = share_of_row(y, h);
    solid_angles_[y] = static_cast<float>(4 * pi * share / w);
    rows[y] = running_sums(row, &cells_[std::size_t(y) * (w + 1)]) / w * share;
  }
  average_ = static_cast<float>(running_sums(rows, rows_.data()));
}

Vec3 WorldLight::read(const Vec2& uv) const {
  const int w = picture_->width, h = picture_->height;
  const float x = uv.x * static_cast<float>(w) - 0.5F;
  const float y = std::clamp((1 - uv.y) * static_cast<float>(h) - 0.5F, 0.0F, static_cast<float>(h - 1));
  const float left = std::floor(x), top = std::floor(y);
  const float part_x = x - left, part_y = y - top;
  const int x0 = (static_cast<int>(left) % w + w) % w, x1 = (x0 + 1) % w;
  const int y0 = static_cast<int>(top), y1 = std::min(y0 + 1, h - 1);
  const auto row = [&](int line) {
    const Vec3* texels = &picture_->texels[std::size_t(line) * w];
    return texels[x0] * (1 - part_x) + texels[x1] * part_x;
  };
  return row(y0) * (1 - part_y) + row(y1) * part_y;
}

Vec3 WorldLight::radiance(const Vec3& direction) const {
  return picture_ ? read(world_uv(direction)) : constant_;
}

LightSample WorldLight::sample(const Vec3& normal, const Vec2& u, float extra) const {
  LightSample sample = picture_ ? sample_picture(u) : sample_constant(normal, u, extra);
  sample.distance = infinity;
  sample.bsdf_can_hit = true;
  return sample;
}

float WorldLight::pdf(const Vec3& normal, const Vec3& direction) const {
  if (!picture_) return constant_pdf(normal, direction);
  const int w = picture_->width, h = picture_->height;
  const Vec2 uv = world_uv(direction);
  const int x = std::clamp(static_cast<int>((uv.x - std::floor(uv.x)) * static_cast<float>(w)), 0, w - 1);
  const int y = std::clamp(static_cast<int>((1 - uv.y) * static_cast<float>(h)), 0, h - 1);
  const float* row = &cells_[std::size_t(y) * (w + 1)];
  return (rows_[y + 1] - rows_[y]) * (row[x + 1] - row[x]) / solid_angles_[y];
}

LightSample WorldLight::sample_picture(const Vec2& u) const {
  const int w = picture_->width, h = picture_->height;
  Vec2 within(u.x, u.y);
  const int y = find_cell(rows_.data(), h, within.y);
  const float* row = &cells_[std::size_t(y) * (w + 1)];
  const int x = find_cell(row, w, within.x);
  const Vec2 uv((static_cast<float>(x) + within.x) / static_cast<float>(w), v_within(y, h, within.y));
  LightSample sample;
  sample.direction = world_direction(uv);
  sample.radiance = read(uv);
  sample.pdf = (rows_[y + 1] - rows_[y]) * (row[x + 1] - row[x]) / solid_angles_[y];
  return sample;
}

LightSample WorldLight::sample_constant(const Vec3& normal, const Vec2& u, float extra) const {
  LightSample sample;
  sample.radiance = constant_;
  if (normal == Vec3(0, 0, 0)) {
    sample.direction = uniform_cone(2, u);
  } else {
    const Vec3 local = extra < 0.5F ? cosine_hemisphere(u) : uniform_cone(1, u);
    sample.direction = OrthonormalBasis(normal).to_world(local);
  }
  sample.pdf = constant_pdf(normal, sample.direction);
  return sample;
}

float WorldLight::constant_pdf(const Vec3& normal, const Vec3& direction) {
  if (normal == Vec3(0, 0, 0)) return uniform_cone_pdf(2);
  const float cosine = normal.dot(direction);
  return cosine > 0 ? 0.5F * (cosine / pi_f + uniform_cone_pdf(1)) : 0.0F;
}

}  // namespace rnmbake
