// pipeline/scene/kept_scene.h - a scene for the tracer as an earlier run exported it, kept in the cache.
#pragma once

#include "blender/blender_session.h"
#include "jobs/store.h"
#include "pipeline/scene/scene_survey.h"
#include "scene/diffuse_scene.h"

#include <optional>

namespace rnmbake {

struct ExportedScene {
  DiffuseScene diffuse_scene;
  SceneBlends blends;
};

/// An export under the content of the scene's file, what is chosen in it, Blender and its scripts. It holds
/// as long as every other file that Blender read is as it was; scenes whose scripts run are not kept, for
/// they may read anything.
class KeptScene {
 public:
  /// `anew`: what is there is not used, but replaced.
  KeptScene(BlenderSession& session, bool anew);

  /// Its .blend files lie in a folder of the session. Nothing where something changed.
  [[nodiscard]] std::optional<ExportedScene> find();

  /// Of the file as it was when this object was made.
  void keep(const ExportedScene& exported);

 private:
  BlenderSession& session_;
  Store store_;
  bool is_on_, anew_;
  ResultKey key_;
};

}  // namespace rnmbake
