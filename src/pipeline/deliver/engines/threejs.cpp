#include "pipeline/deliver/engines/threejs.h"

#include "pipeline/deliver/engines/web_decoder.h"

#include <utility>

namespace rnmbake {

/// Name and text of each file of web/threejs/.
const std::vector<std::pair<const char*, const char*>>& embedded_threejs_files();

const std::vector<std::string>& ThreeJs::encodings() const {
  return web_encodings();
}

void ThreeJs::add_files(DeliveryFiles& files, nlohmann::ordered_json& record) const {
  record["decoder"] = web_decoder(record);
  for (const auto& [name, text] : embedded_threejs_files()) files.add(name, text);
}

}  // namespace rnmbake
