#include "pipeline/deliver/engine_target.h"

#include "image/layered_exr.h"

#include <utility>

#include <spdlog/fmt/fmt.h>

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

}  // namespace rnmbake
