#include "closed_forms/horizon.h"

#include "base/error.h"
#include "base/math.h"
#include "scene/tangents.h"
#include "scene/uv_raster.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace rnmbake {
namespace {

using Vec2d = Imath::V2d;

/// kit.direction(35, 25): the default sun of scenes/smooth.py.
Vec3d to_sun() {
  return direction_at(35 * pi / 180, 25 * pi / 180);
}

double sun(const Vec3d& b, const Vec3d& n) {
  return to_sun().dot(n) > 0 ? std::max(0.0, to_sun().dot(b)) : 0;
}

double sky(const Vec3d& b, const Vec3d& n) {
  return (1 + b.dot(n)) / 2;
}

/// One triangle with what a texel needs to know about it.
struct Face {
  std::array<Vec2, 3> uv;
  std::array<Frame, 3> frames;
  Vec3d normal;

  /// The interpolated basis normal at a UV, unit length.
  [[nodiscard]] Vec3d basis_normal(const Vec3& basis, double u, double v) const {
    const Vec2d at(u, v), a(uv[0]), e1 = Vec2d(uv[1]) - a, e2 = Vec2d(uv[2]) - a, p = at - a;
    const double area = e1.x * e2.y - e1.y * e2.x;
    const double w1 = (p.x * e2.y - p.y * e2.x) / area, w2 = (e1.x * p.y - e1.y * p.x) / area;
    const std::array<double, 3> weights{1 - w1 - w2, w1, w2};
    Vec3d sum(0);
    for (std::size_t k = 0; k < 3; ++k) sum += Vec3d(frames[k].to_world(basis)) * weights[k];
    return sum.normalized();
  }
};

std::vector<Face> faces_of(const SceneSurvey& survey, const std::string& name) {
  for (const SceneObject& object : survey.objects) {
    if (object.key != name) continue;
    const Mesh& mesh = survey.mesh_of(object);
    const auto layer = [&](const char* wanted) {
      return std::find_if(mesh.uv_layers.begin(), mesh.uv_layers.end(),
                          [&](const UvLayer& l) { return l.name == wanted; })
          ->uv;
    };
    const std::vector<Vec2> lightmap = layer("Lightmap");
    const TangentFrames frames = tangent_frames(mesh, layer("UVMap"), object.to_world);
    std::vector<Face> faces(mesh.triangles());
    for (std::size_t t = 0; t < faces.size(); ++t) {
      std::array<Vec3d, 3> p;
      for (std::size_t k = 0; k < 3; ++k) {
        faces[t].uv[k] = lightmap[mesh.triangle_loops[3 * t + k]];
        faces[t].frames[k] = frames.corners[3 * t + k];
        p[k] = Vec3d(mesh.positions[mesh.corner_vertex(3 * t + k)]) * object.to_world;
      }
      faces[t].normal = (p[1] - p[0]).cross(p[2] - p[0]).normalized();
    }
    return faces;
  }
  fail(ExitCode::tasks_failed, "'{}' is not in the scene", name);
}

/// Collects errors of texels one by one.
class Tally {
 public:
  void add(double value, double truth) {
    const double error = value - truth;
    ++result_.texels;
    truths_ += truth;
    sum_ += error;
    squares_ += error * error;
    result_.largest = std::max(result_.largest, std::abs(error));
  }

  [[nodiscard]] ErrorSummary finish() const {
    ErrorSummary result = result_;
    if (result.texels < 2) return result;
    const double n = double(result.texels);
    result.truth = truths_ / n;
    result.mean = sum_ / n;
    result.rms = std::sqrt(squares_ / n);
    result.standard_error = std::sqrt(std::max(0.0, squares_ / n - result.mean * result.mean) / (n - 1));
    return result;
  }

 private:
  ErrorSummary result_;
  double truths_ = 0, sum_ = 0, squares_ = 0;
};

/// `truth` over the square of `footprint` texels around a texel's centre.
double averaged_truth(const HorizonCase& horizon, const Face& face, const Vec3& basis, Vec2d centre,
                      Vec2d footprint) {
  constexpr int taps = 8;
  double sum = 0;
  for (int i = 0; i < taps * taps; ++i) {
    const double u = centre.x + ((i % taps + 0.5) / taps - 0.5) * footprint.x;
    const double v = centre.y + ((i / taps + 0.5) / taps - 0.5) * footprint.y;
    sum += horizon.truth(face.basis_normal(basis, u, v), face.normal);
  }
  return sum / (taps * taps);
}

}  // namespace

std::vector<HorizonCase> horizon_cases() {
  std::vector<HorizonCase> cases;
  for (const auto& [solid, title] :
       {std::pair("smooth_box", "box"), std::pair("smooth_cylinder", "cylinder")}) {
    const std::string name = std::string(solid) == "smooth_box" ? "Box" : "Cylinder";
    cases.push_back({name + "Sun", std::string(title) + ", sun", {solid, {"light=sun"}}, solid, true, sun});
    cases.push_back({name + "Sky", std::string(title) + ", sky", {solid, {"light=sky"}}, solid, false, sky});
  }
  return cases;
}

Words horizon_flags() {
  return {"--resolution", "64", "--samples", "100", "--bounces", "0"};
}

HorizonOutcome compare_horizon(const HorizonCase& horizon, const SceneSurvey& survey,
                               const LayeredImage& lightmap, double footprint) {
  const std::vector<Face> faces = faces_of(survey, horizon.object);
  std::vector<Vec2> corners;
  for (const Face& face : faces) corners.insert(corners.end(), face.uv.begin(), face.uv.end());
  const FloatImage& coverage = lightmap.find("coverage")->pixels;
  const int width = coverage.width(), height = coverage.height();
  const UvRaster raster = rasterize(corners, width, height);
  const Vec2d texel(1.0 / width, 1.0 / height);

  Tally above, below;
  for (const BasisDirection& basis : baked_bases()) {
    const FloatImage& values = lightmap.find(basis.name == "flat" ? "" : basis.name)->pixels;
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const std::int32_t index = raster.at(x, y).triangle;
        if (index < 0 || coverage.texel(x, y)[0] == 0) continue;
        const Face& face = faces[std::size_t(index)];
        const Vec2d centre((x + 0.5) * texel.x, 1 - (y + 0.5) * texel.y);
        const bool under = face.basis_normal(basis.direction, centre.x, centre.y).dot(face.normal) < 0;
        (under ? below : above)
            .add(values.texel(x, y)[0],
                 averaged_truth(horizon, face, basis.direction, centre, texel * footprint));
      }
    }
  }
  return {above.finish(), below.finish()};
}

double footprint_of(const BlenderVersion& version) {
  return version.major >= 5 ? 1 : 0.5;
}

}  // namespace rnmbake
