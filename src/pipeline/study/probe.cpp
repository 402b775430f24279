#include "pipeline/study/probe.h"

#include "base/error.h"
#include "base/text_table.h"
#include "encoding/codecs/ambient_cube_fit.h"
#include "encoding/geomerics.h"
#include "encoding/sh.h"
#include "encoding/zh3.h"
#include "image/layered_exr.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <sstream>
#include <utility>

#include <spdlog/fmt/fmt.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace rnmbake {
namespace {

/// Of each texel of a row.
double solid_angle(int y, int width, int height) {
  return 2 * pi / width * (std::cos(pi * y / height) - std::cos(pi * (y + 1) / height));
}

const FloatImage& colours_of(const LayeredImage& picture, const std::string& file) {
  for (const Layer& layer : picture.layers)
    if (layer.pixels.channels() >= 3) return layer.pixels;
  fail(ExitCode::invalid_input, "{} holds no colours; a probe has R, G and B", file);
}

/// Coefficients of one colour's radiance, summed over the sources.
using Harmonics = std::array<double, 9>;

std::array<Harmonics, 3> harmonics_of(const DistantLight& light) {
  std::array<Harmonics, 3> sums{};
  for (std::size_t i = 0; i < light.directions.size(); ++i) {
    const auto basis = sh_basis(light.directions[i]);
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t k = 0; k < 9; ++k)
        sums[c][k] += pi * double(light.powers[i][int(c)]) * double(basis[k]);
  }
  return sums;
}

/// Decoders of one colour, by its harmonics; the value at a normal.
using Decoder = double (*)(const Harmonics&, const Vec3d& normal);

double decoded_sh(const Harmonics& c, const Vec3d& normal, std::size_t bands) {
  const auto basis = sh_irradiance_basis(Vec3(normal));
  double sum = 0;
  for (std::size_t i = 0; i < bands * bands; ++i) sum += c[i] * double(basis[i]);
  return sum;
}

double lobe_value(Lobe lobe, const Harmonics& c, const Vec3d& normal) {
  constexpr double y0 = 0.28209479, y1 = 0.48860251 * 2 / 3;
  return lobe(c[0] * y0, Vec3d(c[3], c[1], c[2]) * y1, normal).value;
}

/// Takes the orthonormal coefficients for the mean radiance and the flow of light, as Probulator does: 13 %
/// too bright, and too blunt.
double decoded_by_coefficients(const Harmonics& c, const Vec3d& normal) {
  constexpr double over_pi = 1 / pi;
  return geomerics_lobe(c[0] * over_pi, Vec3d(c[3], c[1], c[2]) * over_pi, normal).value;
}

struct SphereCodec {
  const char* label;
  int numbers;
  Decoder decode;
};

constexpr std::array sphere_codecs{
    SphereCodec{"sh2", 4, [](const Harmonics& c, const Vec3d& n) { return decoded_sh(c, n, 2); }},
    SphereCodec{"zh3", 4, [](const Harmonics& c, const Vec3d& n) { return lobe_value(zh3_lobe, c, n); }},
    SphereCodec{"geomerics", 4,
                [](const Harmonics& c, const Vec3d& n) { return lobe_value(geomerics_lobe, c, n); }},
    SphereCodec{"geomerics, as Probulator feeds it", 4, decoded_by_coefficients},
    SphereCodec{"sh3", 9, [](const Harmonics& c, const Vec3d& n) { return decoded_sh(c, n, 3); }}};

/// Normals in the middle of texels, with what a texel weighs.
struct SphereNormals {
  std::vector<Vec3> normals;
  std::vector<float> solid_angles;
  std::vector<Vec3> truth;  // E/pi
};

SphereNormals sphere_normals(const DistantLight& light, int rows) {
  SphereNormals sphere;
  for (int y = 0; y < rows; ++y) {
    for (int x = 0; x < 2 * rows; ++x) {
      sphere.normals.push_back(probe_direction(x, y, 2 * rows, rows));
      sphere.solid_angles.push_back(float(solid_angle(y, 2 * rows, rows)));
    }
  }
  sphere.truth.resize(sphere.normals.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, sphere.normals.size(), 256),
                    [&](const tbb::blocked_range<std::size_t>& range) {
                      const auto part =
                          std::span<const Vec3>(sphere.normals).subspan(range.begin(), range.size());
                      std::ranges::copy(irradiance(light, Vec3(0), part),
                                        sphere.truth.begin() + std::ptrdiff_t(range.begin()));
                    });
  return sphere;
}

ProbeErrors errors_of(std::string label, int numbers, const SphereNormals& sphere,
                      const std::function<Vec3(const Vec3& normal)>& decode) {
  ProbeErrors errors{std::move(label), numbers};
  double texels = 0, angles = 0, whole = 0;
  for (std::size_t i = 0; i < sphere.normals.size(); ++i) {
    const Vec3 error = decode(sphere.normals[i]) - sphere.truth[i];
    const double square = double(error.dot(error)) / 3, angle = double(sphere.solid_angles[i]);
    texels += square;
    angles += angle * square;
    errors.bias += angle * (double(error.x) + error.y + error.z) / 3;
    whole += angle;
  }
  errors.by_texel = std::sqrt(texels / double(sphere.normals.size()));
  errors.by_angle = std::sqrt(angles / whole);
  errors.bias /= whole;
  return errors;
}

TextTable table_of(const ProbeTable& table) {
  TextTable text;
  text.add({"encoding", "numbers", "RMS by texel", "RMS by solid angle", "% of mean", "bias %"});
  for (const ProbeErrors& one : table.errors) {
    text.add({one.label, std::to_string(one.numbers), fmt::format("{:.6f}", one.by_texel),
              fmt::format("{:.6f}", one.by_angle), fmt::format("{:.1f}", 100 * one.by_angle / table.mean),
              fmt::format("{:+.1f}", 100 * one.bias / table.mean)});
  }
  return text;
}

}  // namespace

Vec3 probe_direction(int x, int y, int width, int height) {
  const double azimuth = 2 * pi * ((x + 0.5) / width - 0.5), from_top = pi * (y + 0.5) / height;
  return Vec3(direction_at(from_top, -azimuth));
}

FloatImage read_colours(const std::filesystem::path& file) {
  FloatImage colours = colours_of(read_image(file), file.string());
  for (int y = 0; y < colours.height(); ++y) {
    for (int x = 0; x < colours.width(); ++x) {
      const Vec3 colour = vec3_at(colours, x, y);
      if (!(colour.dot(colour) < 1e30F)) {
        fail(ExitCode::invalid_input, "{} is no number at texel {}, {}, or too great; mend the picture",
             file.string(), x, y);
      }
    }
  }
  return colours;
}

FloatImage read_probe(const std::filesystem::path& file) {
  FloatImage colours = read_colours(file);
  if (colours.width() != 2 * colours.height()) {
    fail(ExitCode::invalid_input,
         "{} is {} x {}; a probe is a picture in latitudes and longitudes, twice as wide as high",
         file.string(), colours.width(), colours.height());
  }
  return colours;
}

DistantLight probe_light(const FloatImage& picture, int rows) {
  const int width = picture.width(), height = picture.height();
  rows = std::min(rows, height);
  DistantLight light;
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < 2 * rows; ++x) light.add(probe_direction(x, y, 2 * rows, rows), Vec3(0));
  for (int y = 0; y < height; ++y) {
    const auto share = float(solid_angle(y, width, height) / pi);
    const auto row = std::size_t(std::int64_t(y) * rows / height);
    for (int x = 0; x < width; ++x) {
      const auto column = std::size_t(std::int64_t(x) * rows / height);
      light.powers[row * 2 * std::size_t(rows) + column] += vec3_at(picture, x, y) * share;
    }
  }
  return light;
}

ProbeTable study_probe_sphere(const DistantLight& light, int rows) {
  const SphereNormals sphere = sphere_normals(light, rows);
  ProbeTable table;
  double whole = 0;
  for (std::size_t i = 0; i < sphere.truth.size(); ++i) {
    const Vec3& truth = sphere.truth[i];
    table.mean += double(sphere.solid_angles[i]) * (double(truth.x) + truth.y + truth.z) / 3;
    whole += double(sphere.solid_angles[i]);
  }
  table.mean /= whole;
  const AmbientCube at_axes =
      ambient_cube_of([&](const Vec3& axis) { return irradiance(light, Vec3(0), std::array{axis}).front(); });
  const AmbientCube nearest = fit_ambient_cube(sphere.normals, sphere.truth);
  for (const auto& [label, cube] : {std::pair{"ambient cube, mean of each face", face_means(light)},
                                    std::pair{"ambient cube, exact at its axes", at_axes},
                                    std::pair{"ambient cube, least squares", nearest}}) {
    table.errors.push_back(errors_of(
        label, 6, sphere, [&cube = cube](const Vec3& normal) { return ambient_cube_decode(cube, normal); }));
  }
  const auto harmonics = harmonics_of(light);
  for (const SphereCodec& codec : sphere_codecs) {
    table.errors.push_back(errors_of(codec.label, codec.numbers, sphere, [&](const Vec3& normal) {
      Vec3 colour;
      for (int c = 0; c < 3; ++c)
        colour[c] = std::max(0.0F, float(codec.decode(harmonics[std::size_t(c)], Vec3d(normal))));
      return colour;
    }));
  }
  return table;
}

std::string probe_table(const ProbeTable& table) {
  std::ostringstream out;
  table_of(table).write(out);
  return out.str();
}

std::string probe_markdown(const ProbeTable& table) {
  std::ostringstream out;
  table_of(table).write_markdown(out);
  return out.str();
}

nlohmann::json probe_json(const ProbeTable& table) {
  auto list = nlohmann::json::array();
  for (const ProbeErrors& one : table.errors) {
    list.push_back({{"encoding", one.label},
                    {"numbers", one.numbers},
                    {"rms_by_texel", one.by_texel},
                    {"rms_by_solid_angle", one.by_angle},
                    {"bias", one.bias}});
  }
  return {{"mean", table.mean}, {"encodings", list}};
}

}  // namespace rnmbake
