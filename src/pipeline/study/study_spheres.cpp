#include "pipeline/study/study_spheres.h"

#include "encoding/direction_sets.h"
#include "encoding/random_light.h"
#include "encoding/texel_frame.h"
#include "pipeline/study/encoding_study.h"

#include <cmath>
#include <span>

#include <tbb/parallel_for.h>

namespace rnmbake {
namespace {

/// A lobe exp(k (D.axis - 1)) over points of an even spread, of E/pi `power` in all for a surface that faces
/// it.
void add_lamp(DistantLight& light, std::size_t points, const Vec3& axis, float sharpness, const Vec3& power) {
  float whole = 0;
  for (std::size_t i = 0; i < points; ++i) whole += std::exp(sharpness * (light.directions[i].dot(axis) - 1));
  for (std::size_t i = 0; i < points; ++i)
    light.powers[i] += power * (std::exp(sharpness * (light.directions[i].dot(axis) - 1)) / whole);
}

/// Normal of the bumpy sphere in the tangent space of its point.
struct BumpyPoint {
  TexelFrame frame;  // of the smooth sphere, world space
  Vec3 normal;       // of the bumps, tangent space
};

BumpyPoint bumpy_point(const Vec3& p) {
  constexpr float waves = 13, steepness = 1.1917536F;  // tan 50 degrees
  const Vec3 up(0, 0, 1), side = std::abs(p.z) > 0.999F ? Vec3(1, 0, 0) : up.cross(p).normalized();
  const Vec3 w = p * waves, s(std::sin(w.x), std::sin(w.y), std::sin(w.z)),
             c(std::cos(w.x), std::cos(w.y), std::cos(w.z));
  // Of sin x cos y + sin y cos z + sin z cos x, up to 1.
  const Vec3 slope = Vec3(c.x * c.y - s.z * s.x, c.y * c.z - s.x * s.y, c.z * c.x - s.y * s.z) / 1.75F;
  const TexelFrame frame{side, p.cross(side), p};
  const Vec3 tilted(-steepness * slope.dot(frame.tangent), -steepness * slope.dot(frame.bitangent), 1);
  return {frame, tilted.normalized()};
}

bool is_pictured(const EncodingErrors& one) {
  return one.unfit.empty() && (one.codec.bits == 0 || one.codec.mono);
}

}  // namespace

DistantLight sky_and_lamps() {
  constexpr std::size_t points = 1024;
  DistantLight light;
  for (const Vec3d& d : spread_over_hemisphere(points / 2)) {
    for (const double side : {1.0, -1.0}) light.add(Vec3(Vec3d(d.x, d.y, side * d.z)), Vec3(0));
    light.powers[light.powers.size() - 2] = Vec3(0.25F, 0.3F, 0.4F) * (4.0F / points);
    light.powers.back() = Vec3(0.06F, 0.05F, 0.04F) * (4.0F / points);
  }
  add_lamp(light, points, Vec3(-0.6F, -0.5F, 0.6245F), 60, Vec3(1, 0.9F, 0.75F));
  add_lamp(light, points, Vec3(0.9F, -0.3F, -0.3162F), 20, Vec3(0.15F, 0.2F, 0.3F));
  return light;
}

std::vector<SpherePicture> sphere_pictures(const DistantLight& light, int side) {
  const BasisSet fed = direction_set("sh3").value();
  const EncodingStudy study(fed, {});
  const std::vector<EncodingErrors> encodings = study.errors();
  std::vector<SpherePicture> pictures{{"truth", FloatImage(side, side, 3)}};
  std::vector<std::size_t> shown;
  for (std::size_t i = 0; i < encodings.size(); ++i) {
    if (!is_pictured(encodings[i])) continue;
    shown.push_back(i);
    pictures.push_back({encodings[i].label, FloatImage(side, side, 3)});
  }
  tbb::parallel_for(0, side, [&](int row) {
    for (int column = 0; column < side; ++column) {
      const float x = 2 * (float(column) + 0.5F) / float(side) - 1,
                  z = 1 - 2 * (float(row) + 0.5F) / float(side), rest = 1 - x * x - z * z;
      if (rest <= 0) continue;
      const BumpyPoint point = bumpy_point({x, -std::sqrt(rest), z});
      std::vector<Vec3> world;
      for (const BasisDirection& basis : fed.directions) world.push_back(point.frame.stored(basis.direction));
      world.push_back(point.frame.stored(point.normal));
      const std::vector<Vec3> values = irradiance(light, point.frame.normal, world);
      const auto at_fed = std::span(values).first(fed.directions.size());
      set_vec3(pictures.front().pixels, column, row, values.back());
      for (std::size_t i = 0; i < shown.size(); ++i)
        set_vec3(pictures[i + 1].pixels, column, row, study.decoded(shown[i], at_fed, point.normal));
    }
  });
  const std::vector<float>& truth = pictures.front().pixels.data();
  for (SpherePicture& picture : pictures) {
    double squares = 0, errors = 0;
    for (std::size_t i = 0; i < truth.size(); ++i) {
      squares += double(truth[i]) * truth[i];
      errors += std::pow(double(picture.pixels.data()[i]) - truth[i], 2);
    }
    picture.rms = std::sqrt(errors / squares);
  }
  return pictures;
}

}  // namespace rnmbake
