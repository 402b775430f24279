#include "pipeline/probes/picture_probe.h"

#include "base/error.h"
#include "base/text_table.h"
#include "encoding/codecs/ambient_cube_fit.h"
#include "encoding/sh.h"
#include "image/layered_exr.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include <spdlog/fmt/fmt.h>

namespace rnmbake {
namespace {

/// Direction of a face's texel, in Blender's axes. `s` from the left, `t` from the top, both in [-1, 1].
Vec3 face_direction(std::size_t face, float s, float t) {
  const std::array<Vec3, 6> y_up{Vec3(1, -t, -s), Vec3(-1, -t, s), Vec3(s, 1, t),
                                 Vec3(s, -1, -t), Vec3(s, -t, 1),  Vec3(-s, -t, -1)};
  const Vec3 d = unit(y_up[face]);
  return {d.x, -d.z, d.y};
}

/// Solid angle of the face's part from its middle to (x, y), half sizes of 1.
double corner_angle(double x, double y) {
  return std::atan2(x * y, std::sqrt(x * x + y * y + 1));
}

double texel_angle(int x, int y, int side) {
  const auto at = [&](int i) { return 2.0 * i / side - 1; };
  return corner_angle(at(x + 1), at(y + 1)) - corner_angle(at(x), at(y + 1)) -
         corner_angle(at(x + 1), at(y)) + corner_angle(at(x), at(y));
}

FloatImage read_face(const std::filesystem::path& file, int side) {
  FloatImage colours = read_colours(file);
  if (colours.width() != colours.height() || (side > 0 && colours.width() != side)) {
    fail(ExitCode::invalid_input, "{} is {} x {}; the faces of a cube map are square and of one size",
         file.string(), colours.width(), colours.height());
  }
  return colours;
}

}  // namespace

DistantLight read_cube_map(const std::array<std::filesystem::path, 6>& faces) {
  DistantLight light;
  int side = 0;
  for (std::size_t face = 0; face < faces.size(); ++face) {
    const FloatImage picture = read_face(faces[face], side);
    side = picture.width();
    for (int y = 0; y < side; ++y) {
      for (int x = 0; x < side; ++x) {
        const auto at = [&](int i) { return float(2 * i + 1) / float(side) - 1; };
        const auto share = static_cast<float>(texel_angle(x, y, side) / pi);
        light.add(face_direction(face, at(x), at(y)), vec3_at(picture, x, y) * share);
      }
    }
  }
  return light;
}

DistantLight read_light(const std::vector<std::filesystem::path>& files) {
  if (files.size() == 1) return probe_light(read_probe(files.front()));
  if (files.size() != 6) {
    fail(ExitCode::usage,
         "--from {} pictures: give one in latitudes and longitudes, or the six faces px,nx,py,ny,pz,nz of a "
         "cube map",
         files.size());
  }
  std::array<std::filesystem::path, 6> faces;
  std::ranges::copy(files, faces.begin());
  return read_cube_map(faces);
}

LightProbe probe_of(const DistantLight& light) {
  LightProbe probe;
  std::ranges::copy(irradiance(light, Vec3(0), probe_directions()), probe.irradiance.begin());
  for (std::size_t i = 0; i < light.directions.size(); ++i) {
    const auto basis = sh_basis(light.directions[i]);
    for (std::size_t k = 0; k < 9; ++k)
      probe.harmonics[k] += light.powers[i] * (static_cast<float>(pi) * basis[k]);
  }
  return probe;
}

PictureCubes cubes_of(const DistantLight& light) {
  constexpr std::size_t normals = 2048;
  std::vector<Vec3> spread;
  for (std::size_t i = 0; i < normals; ++i) {  // a spiral, evenly spread
    const double z = 1 - (2.0 * double(i) + 1) / double(normals),
                 azimuth = double(i) * pi * (3 - std::sqrt(5.0));
    spread.emplace_back(direction_at(std::acos(z), azimuth));
  }
  return {face_means(light), ambient_cube_of([&](const Vec3& axis) {
            return irradiance(light, Vec3(0), std::array{axis}).front();
          }),
          fit_ambient_cube(spread, irradiance(light, Vec3(0), spread))};
}

std::string picture_text(const PictureCubes& cubes, const ProbeTable& table) {
  const auto colour = [](const Vec3& c) { return fmt::format("{:.4g} {:.4g} {:.4g}", c.x, c.y, c.z); };
  TextTable sides;
  sides.add({"side", "exact (E/pi)", "least squares", "mean of the face", "off by %"});
  for (std::size_t side = 0; side < 6; ++side) {
    const Vec3 exact = cubes.exact[side], off = cubes.faces[side] - exact;
    const double light = double(exact.x + exact.y + exact.z);
    sides.add({probe_direction_names()[side], colour(exact), colour(cubes.fitted[side]),
               colour(cubes.faces[side]),
               light > 0 ? fmt::format("{:+.1f}", 100 * double(off.x + off.y + off.z) / light) : "-"});
  }
  std::ostringstream out;
  out << "Ambient cube, RGB:\n";
  sides.write(out);
  out << "\nErrors over all normals:\n" << probe_table(table);
  return out.str();
}

}  // namespace rnmbake
