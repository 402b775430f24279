// scene/scene_places.h - where the objects and lamps of a scene are, which parts of its digest each is made
// of, and what of it a change concerns.
#pragma once

#include "base/math.h"
#include "scene/scene_digest.h"
#include "scene/survey.h"

#include <set>
#include <string>
#include <vector>

#include <ImathBox.h>
#include <nlohmann/json.hpp>

namespace rnmbake {

using Box = Imath::Box3d;

struct PlacedObject {
  std::string key;                 // of the survey
  std::vector<std::string> parts;  // of the digest, with all that they use: what the object is
  Box box;                         // axis-aligned, world space
};

struct PlacedLamp {
  std::string part;  // object 'Lamp'
  Vec3d position;
  double reach =
      0;  // scene units: beyond it, it gives no texel 1/256 of E/pi; < 0: there is no such distance
  bool operator==(const PlacedLamp&) const = default;
};

/// A scene as it was baked, for comparison with the next.
struct PlacedScene {
  SceneDigest digest;
  std::vector<PlacedObject> objects;
  std::vector<PlacedLamp> lamps;
};

[[nodiscard]] PlacedScene place_scene(const SceneSurvey& survey);

[[nodiscard]] nlohmann::json to_json(const PlacedScene& scene);
/// Throws nlohmann::json::exception where it is none, else as read_digest().
[[nodiscard]] PlacedScene placed_scene_from(const nlohmann::json& json);

/// What differs between two scenes, by where it is, before and after.
struct PlacedChanges {
  std::vector<std::string> everywhere;  // parts that belong to no object or lamp with an end to its reach
  std::vector<Box> boxes;               // of objects that changed, came or went
  std::vector<PlacedLamp> lamps;        // likewise

  [[nodiscard]] bool empty() const { return everywhere.empty() && boxes.empty() && lamps.empty(); }
  /// Whether a change is within `distance` of the box, or the box in reach of a lamp that changed.
  [[nodiscard]] bool reach(const Box& box, double distance) const;
};

[[nodiscard]] PlacedChanges placed_changes(const PlacedScene& before, const PlacedScene& after);

}  // namespace rnmbake
