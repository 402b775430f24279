#include "pipeline/deliver/engines/engine_targets.h"

#include "base/error.h"
#include "pipeline/deliver/engines/bevy.h"
#include "pipeline/deliver/engines/gltf.h"
#include "pipeline/deliver/engines/godot.h"
#include "pipeline/deliver/engines/raw_pages_target.h"
#include "pipeline/deliver/engines/source.h"
#include "pipeline/deliver/engines/threejs.h"
#include "pipeline/deliver/engines/unity.h"
#include "pipeline/deliver/engines/unreal.h"

#include <algorithm>

namespace rnmbake {

const std::vector<const EngineTarget*>& engine_targets() {
  static const Gltf gltf;
  static const ThreeJs threejs;
  static const RawPagesTarget playcanvas("playcanvas", embedded_playcanvas_files());
  static const RawPagesTarget babylon("babylon", embedded_babylon_files());
  static const Bevy bevy;
  static const Godot godot;
  static const Unity unity;
  static const Unreal unreal;
  static const Source source;
  static const std::vector<const EngineTarget*> all{&gltf,  &threejs, &playcanvas, &babylon, &bevy,
                                                    &godot, &unity,   &unreal,     &source};
  return all;
}

const EngineTarget& engine_target(std::string_view name) {
  for (const EngineTarget* target : engine_targets())
    if (name == target->name()) return *target;
  fail(ExitCode::usage, "'{}' is no engine that rnmbake delivers to", name);
}

std::vector<std::string> delivered_encodings() {
  std::vector<std::string> all;
  for (const EngineTarget* target : engine_targets()) {
    for (const std::string& encoding : target->encodings())
      if (std::ranges::find(all, encoding) == all.end()) all.push_back(encoding);
  }
  return all;
}

}  // namespace rnmbake
