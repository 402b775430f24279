#include "pipeline/deliver/engines/babylon.h"

namespace rnmbake {

/// Name and text of each file of web/babylon/.
const std::vector<std::pair<const char*, const char*>>& embedded_babylon_files();

const std::vector<std::pair<const char*, const char*>>& Babylon::web_files() const {
  return embedded_babylon_files();
}

}  // namespace rnmbake
