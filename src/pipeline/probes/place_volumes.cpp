#include "pipeline/probes/place_volumes.h"

#include "base/error.h"
#include "base/names.h"

#include <algorithm>
#include <limits>

namespace rnmbake {
namespace {

ProbeBounds bounds_of(const SceneSurvey& survey, const std::vector<char>& dynamic) {
  constexpr double far = std::numeric_limits<double>::max();
  ProbeBounds bounds{Vec3d(far), Vec3d(-far)};
  for (std::size_t i = 0; i < survey.objects.size(); ++i) {
    if (dynamic[i] != 0) continue;
    const SceneObject& object = survey.objects[i];
    for (const Vec3& position : survey.mesh_of(object).positions) {
      Vec3d world;
      object.to_world.multVecMatrix(Vec3d(position), world);
      for (int axis = 0; axis < 3; ++axis) {
        bounds.low[axis] = std::min(bounds.low[axis], world[axis]);
        bounds.high[axis] = std::max(bounds.high[axis], world[axis]);
      }
    }
  }
  if (bounds.low.x > bounds.high.x)
    fail(ExitCode::invalid_input, "the scene has no geometry to put probes around; give a box by --bounds");
  return bounds;
}

std::vector<std::string> names_of(const std::vector<ProbePlace>& places) {
  std::vector<std::string> names;
  names.reserve(places.size());
  for (const ProbePlace& place : places) names.push_back(place.name);
  return names;
}

/// Volumes as they are, empties together as one list.
std::vector<ProbeVolume> volumes_of(const std::vector<ProbePlace>& places) {
  std::vector<ProbeVolume> volumes;
  std::vector<Vec3d> points;
  for (const ProbePlace& place : places) {
    if (place.is_volume()) {
      volumes.push_back(empty_volume(place.name, grid_in_cube(place.to_world, place.counts)));
    } else {
      points.push_back(place.to_world.translation());
    }
  }
  if (!points.empty()) volumes.push_back(empty_volume("empties", points));
  return volumes;
}

std::vector<ProbePlace> places_at(const SceneSurvey& survey, const std::vector<std::string>& patterns) {
  std::vector<ProbePlace> found;
  for (const std::string& pattern : patterns) {
    const auto fits = [&](const ProbePlace& place) { return glob_match(pattern, place.name); };
    if (std::ranges::none_of(survey.probe_places, fits)) {
      fail(ExitCode::usage, "--at {}: the scene has no empty and no light probe volume of that name{}",
           pattern, did_you_mean(pattern, names_of(survey.probe_places)));
    }
  }
  for (const ProbePlace& place : survey.probe_places) {
    if (std::ranges::any_of(patterns, [&](const std::string& p) { return glob_match(p, place.name); }))
      found.push_back(place);
  }
  return found;
}

}  // namespace

std::vector<ProbeVolume> place_volumes(const SceneSurvey& survey, const PlaceWishes& wishes,
                                       const std::vector<char>& dynamic) {
  const bool is_box = wishes.spacing || wishes.bounds;
  if (int(is_box) + int(!wishes.at.empty()) + int(!wishes.points.empty()) > 1)
    fail(ExitCode::usage, "--at, --points, and a box by --spacing or --bounds exclude each other; give one");
  if (!wishes.points.empty())
    return {empty_volume(wishes.points.stem().string(), read_points(wishes.points))};
  if (!wishes.at.empty()) return volumes_of(places_at(survey, wishes.at));
  if (!is_box) {
    std::vector<ProbePlace> own = survey.probe_places;
    std::erase_if(own, [](const ProbePlace& place) { return !place.is_volume(); });
    if (!own.empty()) return volumes_of(own);
  }
  const ProbeBounds bounds = wishes.bounds ? *wishes.bounds : bounds_of(survey, dynamic);
  constexpr double divided = 8;  // fewer to begin with, as cells are halved where they need it
  const double probes = wishes.levels > 0 ? wishes.probes / divided : wishes.probes;
  return {empty_volume("volume", grid_in(bounds, wishes.spacing, probes, wishes.levels))};
}

std::vector<char> dynamic_objects(const SceneSurvey& survey, const std::vector<std::string>& patterns) {
  std::vector<char> dynamic(survey.objects.size(), 0);
  for (const std::string& pattern : patterns) {
    bool fits_any = false;
    std::vector<std::string> names;
    for (std::size_t i = 0; i < survey.objects.size(); ++i) {
      const SceneObject& object = survey.objects[i];
      names.push_back(object.name);
      if (!glob_match(pattern, object.name) && !glob_match(pattern, object.key)) continue;
      dynamic[i] = 1;
      fits_any = true;
    }
    if (!fits_any)
      fail(ExitCode::usage, "--dynamic {}: the scene has no such object{}", pattern,
           did_you_mean(pattern, names));
  }
  return dynamic;
}

}  // namespace rnmbake
