#include "trace/lights/light_units.h"

#include "sampling/maps.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace rnmbake {
namespace {

/// 304 for "3.4.1"; the newest where it says nothing.
int version_number(const std::string& version) {
  char* rest = nullptr;
  const long major = std::strtol(version.c_str(), &rest, 10);
  const long minor = *rest == '.' ? std::strtol(rest + 1, nullptr, 10) : 0;
  return major > 0 ? static_cast<int>(100 * major + minor) : 9999;
}

double size_or(const LightInfo& light, const std::string& name, double otherwise) {
  const auto found = light.sizes.find(name);
  return found == light.sizes.end() ? otherwise : found->second;
}

Vec3 column(const LightInfo& light, int axis) {
  const auto* row = light.to_world[axis];
  return Vec3(Vec3d(row[0], row[1], row[2]));
}

Vec3 colour(const LightInfo& light, double factor) {
  const auto& c = light.color;
  return Vec3(Vec3d(c[0], c[1], c[2]) * (light.energy * factor));
}

/// Since 4.5 the energy may be per unit of a lamp's area.
double unless_normalized(const LightInfo& light, double area) {
  return size_or(light, "normalize", 1) != 0 ? 1.0 : area;
}

class Reader {
 public:
  Reader(int version, const Vec3d& origin) : version_(version), origin_(origin) {}

  [[nodiscard]] Lamp read(const LightInfo& light) const {
    Lamp lamp;
    const auto* translation = light.to_world[3];
    lamp.position = Vec3(Vec3d(translation[0], translation[1], translation[2]) - origin_);
    lamp.axis = -column(light, 2).normalized();
    lamp.max_bounces = light.max_bounces;
    if (light.type == "SUN")
      read_sun(light, lamp);
    else if (light.type == "AREA")
      read_area(light, lamp);
    else
      read_point(light, lamp);
    return lamp;
  }

 private:
  /// P / 4 pi watts per steradian, whatever the size. Since 4.0 a lamp may be a real sphere.
  void read_point(const LightInfo& light, Lamp& lamp) const {
    const double radius = size_or(light, "shadow_soft_size", 0);
    lamp.radiance =
        colour(light, unless_normalized(light, radius > 0 ? 4 * pi * radius * radius : 4) / (4 * pi));
    if (radius > 0) {
      const bool soft = size_or(light, "use_soft_falloff", version_ < 400 ? 1 : 0) != 0;
      lamp.kind = soft ? Lamp::Kind::disk : Lamp::Kind::sphere;
      lamp.radius = static_cast<float>(radius);
      lamp.radiance /= static_cast<float>(pi * radius * radius);
    }
    if (light.type == "SPOT") read_cone(light, lamp);
  }

  void read_cone(const LightInfo& light, Lamp& lamp) const {
    SpotCone& cone = lamp.spot;
    cone.used = true;
    cone.by_cosine = version_ < 305;
    const double cosine = std::cos(size_or(light, "spot_size", pi / 4) / 2);
    const double fade = (1 - cosine) * size_or(light, "spot_blend", 0.15);
    cone.cosine = static_cast<float>(cosine);
    cone.sharpness = fade > 0 ? static_cast<float>(1 / fade) : 0.0F;
    const Vec3 axes[3] = {column(light, 0), column(light, 1), column(light, 2)};
    cone.x = axes[0] / axes[0].length2();
    cone.y = axes[1] / axes[1].length2();
    cone.z = -axes[2] / axes[2].length2();
    if (cone.by_cosine) {
      cone.x = axes[0].normalized();
      cone.y = axes[1].normalized();
      cone.z = lamp.axis;
    }
  }

  void read_sun(const LightInfo& light, Lamp& lamp) const {
    lamp.kind = Lamp::Kind::sun;
    lamp.flat_sun = version_ < 400;
    const double half = size_or(light, "angle", 0) / 2;
    lamp.radius = static_cast<float>(std::tan(half));
    const double r = lamp.radius;
    // Of all directions of the disk together; narrowed by the angle to the middle where it is a flat disk.
    const double measure = pi * (lamp.flat_sun ? r * r : r * r / (1 + r * r));
    lamp.radiance = colour(light, r > 0 ? unless_normalized(light, measure) / measure : 1.0);
  }

  void read_area(const LightInfo& light, Lamp& lamp) const {
    const bool round = light.shape == "DISK" || light.shape == "ELLIPSE";
    const bool oblong = light.shape == "RECTANGLE" || light.shape == "ELLIPSE";
    lamp.kind = round ? Lamp::Kind::ellipse : Lamp::Kind::rectangle;
    const double size = size_or(light, "size", 1);
    lamp.u = column(light, 0) * static_cast<float>(size / 2);
    lamp.v = column(light, 1) * static_cast<float>((oblong ? size_or(light, "size_y", size) : size) / 2);
    const double area = lamp.area();
    const double of_power = unless_normalized(light, area) / (version_ < 400 ? 4 : pi);
    lamp.radiance = area > 0 ? colour(light, of_power / area) : Vec3(0, 0, 0);
    const double half = size_or(light, "spread", pi) / 2;
    if (half < pi / 2 * (1 - 1e-6)) {
      const double tangent = std::tan(std::max(half, 1e-3));
      lamp.spread_tangent = static_cast<float>(tangent);
      lamp.spread_scale = static_cast<float>(tangent / (tangent - std::atan(tangent)));
    }
  }

  int version_;
  Vec3d origin_;
};

}  // namespace

std::vector<Lamp> read_lamps(const SceneSurvey& survey, const std::string& blender_version,
                             const Vec3d& origin) {
  const Reader reader(version_number(blender_version), origin);
  std::vector<Lamp> lamps;
  for (const LightInfo& light : survey.lights) {
    const Lamp lamp = reader.read(light);
    if (lamp.radiance != Vec3(0, 0, 0)) lamps.push_back(lamp);
  }
  return lamps;
}

}  // namespace rnmbake
