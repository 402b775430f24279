#include "pipeline/scene/scene_key.h"

#include "blender/scripts.h"

namespace rnmbake {

ResultKey scene_key(const BlenderSession& session, const SceneSurvey& survey) {
  const BakeSettings& settings = session.settings();
  const BlenderInfo& blender = session.blender().info();
  KeyMaker key;
  key.add("content", survey.digest.hash());
  key.add("materials", std::int64_t(settings.scene.materials));
  key.add("blender", blender.version_text).add("build", blender.build);
  key.add("scripts", scripts_hash(settings.run.scripts));
  return key.make("scene");
}

}  // namespace rnmbake
