#include "pipeline/deliver/engine_target.h"

namespace rnmbake {

const std::vector<PageFormat>& EngineTarget::formats() const {
  static const std::vector<PageFormat> none;
  return none;
}

nlohmann::ordered_json EngineTarget::write_page(DeliveryFiles& files, std::size_t number, Page page) const {
  return PageWriter(files, {.format = PageFormat::exr}).write(number, page);
}

}  // namespace rnmbake
