#include "pipeline/deliver/engines/threejs.h"

#include "pipeline/deliver/engines/shipped_files.h"
#include "pipeline/deliver/engines/web_decoder.h"

namespace rnmbake {

const std::vector<std::string>& ThreeJs::encodings() const {
  return web_encodings();
}

const std::vector<PageFormat>& ThreeJs::formats() const {
  static const std::vector<PageFormat> all{PageFormat::exr,           PageFormat::hdr,
                                           PageFormat::ktx2_rgba16f,  PageFormat::ktx2_b10g11r11,
                                           PageFormat::ktx2_e5b9g9r9, PageFormat::ktx2_bc6h};
  return all;
}

void ThreeJs::add_files(DeliveryFiles& files, nlohmann::ordered_json& record) const {
  record["decoder"] = web_decoder(record);
  for (const auto& [name, text] : embedded_threejs_files()) files.add(name, text);
}

}  // namespace rnmbake
