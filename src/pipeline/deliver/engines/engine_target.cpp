#include "pipeline/deliver/engines/engine_target.h"

#include "base/error.h"
#include "image/layered_exr.h"
#include "pipeline/deliver/engines/gltf.h"
#include "pipeline/deliver/engines/threejs.h"

#include <algorithm>
#include <utility>

namespace rnmbake {

nlohmann::ordered_json EngineTarget::write_page(DeliveryFiles& files, std::size_t number, Page page) const {
  nlohmann::ordered_json names = nlohmann::ordered_json::object();
  for (Layer& layer : page.layers) {
    const std::string said = layer.name.empty() ? flat : layer.name;
    const std::string file = fmt::format("page{}.{}.exr", number, said);
    layer.name.clear();
    write_exr(files.add(file), {{std::move(layer)}, {}}, Depth::half);
    names[said] = file;
  }
  return names;
}

const std::vector<const EngineTarget*>& engine_targets() {
  static const Gltf gltf;
  static const ThreeJs threejs;
  static const std::vector<const EngineTarget*> all{&gltf, &threejs};
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
