#include "scene/scene_places.h"

#include "scene/survey_parse.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace rnmbake {
namespace {

using nlohmann::json;
using Names = std::set<std::string>;

constexpr double least_light = 1.0 / 256;  // of E/pi: a step of a picture of 8 bits

Box box_of(const Mesh& mesh, const Mat44& to_world) {
  Box local, box;
  for (const Vec3& position : mesh.positions) local.extendBy(Vec3d(position));
  if (local.isEmpty()) return box;
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3d at((corner & 1) != 0 ? local.max.x : local.min.x,
                   (corner & 2) != 0 ? local.max.y : local.min.y,
                   (corner & 4) != 0 ? local.max.z : local.min.z);
    box.extendBy(at * to_world);
  }
  return box;
}

double size_or(const LightInfo& light, const char* name, double otherwise) {
  const auto found = light.sizes.find(name);
  return found == light.sizes.end() ? otherwise : found->second;
}

/// Watts per steradian in the brightest direction and channel; < 0: not known, or from infinitely far off.
double intensity(const LightInfo& light) {
  const bool is_plain = light.outside_model.empty() && size_or(light, "normalize", 1) != 0;
  if (!is_plain || light.type == "SUN" || size_or(light, "spread", pi) < pi * (1 - 1e-6)) return -1;
  double brightest = 0;
  for (const double channel : light.color) brightest = std::max(brightest, std::abs(channel * light.energy));
  return brightest / (light.type == "AREA" ? pi : 4 * pi);
}

/// E/pi at distance r is at most intensity / (pi r^2).
double reach_of(const LightInfo& light) {
  const double strongest = intensity(light);
  return strongest < 0 ? -1 : std::sqrt(strongest / (pi * least_light));
}

std::string object_part(const std::string& name) {
  return "object '" + name + "'";
}

/// A digest by the names of its parts.
class Parts {
 public:
  explicit Parts(const SceneDigest& digest) {
    for (const DigestEntry& entry : digest.entries) by_name_.emplace(entry.what, &entry);
  }

  [[nodiscard]] bool has(const std::string& what) const { return by_name_.contains(what); }
  [[nodiscard]] const std::map<std::string, const DigestEntry*>& all() const { return by_name_; }

  /// These and all that they use, those that the digest has.
  [[nodiscard]] Names closure(const std::vector<std::string>& roots) const {
    Names found;
    std::vector<std::string> waiting = roots;
    while (!waiting.empty()) {
      const std::string what = std::move(waiting.back());
      waiting.pop_back();
      const auto entry = by_name_.find(what);
      if (entry == by_name_.end() || !found.insert(what).second) continue;
      waiting.insert(waiting.end(), entry->second->uses.begin(), entry->second->uses.end());
    }
    return found;
  }

 private:
  std::map<std::string, const DigestEntry*> by_name_;
};

Names differing(const Parts& before, const Parts& after) {
  Names parts;
  for (const auto* side : {&before, &after}) {
    const Parts& other = side == &before ? after : before;
    for (const auto& [what, entry] : side->all()) {
      const auto there = other.all().find(what);
      if (there == other.all().end() || there->second->hash != entry->hash) parts.insert(what);
    }
  }
  return parts;
}

bool share(const Names& names, const std::vector<std::string>& others) {
  return std::ranges::any_of(others, [&](const std::string& one) { return names.contains(one); });
}

/// Parts that the world, the settings of the scene, or anything else uses that is neither object nor lamp.
Names of_no_place(const PlacedScene& scene, const Parts& parts) {
  std::vector<std::string> roots;
  Names placed;
  for (const PlacedObject& object : scene.objects) placed.insert(object.parts.begin(), object.parts.end());
  for (const PlacedLamp& lamp : scene.lamps) placed.merge(parts.closure({lamp.part}));
  for (const auto& [what, entry] : parts.all()) {
    if (!placed.contains(what)) roots.push_back(what);
  }
  return parts.closure(roots);
}

void add_lamp(const PlacedLamp& lamp, PlacedChanges& changes) {
  if (lamp.reach < 0)
    changes.everywhere.push_back(lamp.part);
  else
    changes.lamps.push_back(lamp);
}

/// Changes of one of two scenes, out of the parts that differ.
void add_changes(const PlacedScene& scene, const PlacedScene& other, const Names& differ,
                 PlacedChanges& changes) {
  const Parts parts(scene.digest);
  for (const std::string& what : of_no_place(scene, parts)) {
    if (differ.contains(what)) changes.everywhere.push_back(what);
  }
  for (const PlacedObject& object : scene.objects) {
    if (share(differ, object.parts)) changes.boxes.push_back(object.box);
  }
  for (const PlacedLamp& lamp : scene.lamps) {
    const Names closure = parts.closure({lamp.part});
    const bool is_elsewhere = std::ranges::find(other.lamps, lamp) == other.lamps.end();
    if (is_elsewhere || share(differ, {closure.begin(), closure.end()})) add_lamp(lamp, changes);
  }
}

double distance(const Box& box, const Vec3d& point) {
  Vec3d gap;
  for (int axis = 0; axis < 3; ++axis)
    gap[axis] = std::max({box.min[axis] - point[axis], point[axis] - box.max[axis], 0.0});
  return gap.length();
}

double distance(const Box& a, const Box& b) {
  Vec3d gap;
  for (int axis = 0; axis < 3; ++axis)
    gap[axis] = std::max({a.min[axis] - b.max[axis], b.min[axis] - a.max[axis], 0.0});
  return gap.length();
}

json numbers(const Vec3d& v) {
  return {v.x, v.y, v.z};
}

Vec3d vector_from(const json& list) {
  return {list.at(0).get<double>(), list.at(1).get<double>(), list.at(2).get<double>()};
}

}  // namespace

PlacedScene place_scene(const SceneSurvey& survey) {
  PlacedScene scene{survey.digest, {}, {}};
  const Parts parts(survey.digest);
  for (const SceneObject& object : survey.objects) {
    std::vector<std::string> roots{object_part(object.name)};
    if (!object.instancer.empty()) roots.push_back("instances of '" + object.instancer + "'");
    const Names closure = parts.closure(roots);
    scene.objects.push_back(
        {object.key, {closure.begin(), closure.end()}, box_of(survey.mesh_of(object), object.to_world)});
  }
  for (const LightInfo& light : survey.lights) {
    const auto* at = light.to_world[3];
    scene.lamps.push_back({object_part(light.name), Vec3d(at[0], at[1], at[2]), reach_of(light)});
  }
  return scene;
}

json to_json(const PlacedScene& scene) {
  json objects = json::array(), lamps = json::array();
  for (const PlacedObject& object : scene.objects)
    objects.push_back({object.key, object.parts, numbers(object.box.min), numbers(object.box.max)});
  for (const PlacedLamp& lamp : scene.lamps) lamps.push_back({lamp.part, numbers(lamp.position), lamp.reach});
  return {{"parts", to_json(scene.digest)}, {"objects", objects}, {"lamps", lamps}};
}

PlacedScene placed_scene_from(const json& text) {
  PlacedScene scene;
  scene.digest = read_digest(text.at("parts"));
  for (const json& one : text.at("objects"))
    scene.objects.push_back({one.at(0).get<std::string>(), one.at(1).get<std::vector<std::string>>(),
                             Box(vector_from(one.at(2)), vector_from(one.at(3)))});
  for (const json& one : text.at("lamps"))
    scene.lamps.push_back({one.at(0).get<std::string>(), vector_from(one.at(1)), one.at(2).get<double>()});
  return scene;
}

bool PlacedChanges::reach(const Box& box, double within) const {
  return !everywhere.empty() ||
         std::ranges::any_of(boxes, [&](const Box& one) { return distance(one, box) <= within; }) ||
         std::ranges::any_of(lamps, [&](const PlacedLamp& lamp) {
           return distance(box, lamp.position) <= std::max(lamp.reach, within);
         });
}

PlacedChanges placed_changes(const PlacedScene& before, const PlacedScene& after) {
  PlacedChanges changes;
  const Names differ = differing(Parts(before.digest), Parts(after.digest));
  add_changes(before, after, differ, changes);
  add_changes(after, before, differ, changes);
  return changes;
}

}  // namespace rnmbake
