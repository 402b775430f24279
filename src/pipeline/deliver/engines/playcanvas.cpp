#include "pipeline/deliver/engines/playcanvas.h"

namespace rnmbake {

/// Name and text of each file of web/playcanvas/.
const std::vector<std::pair<const char*, const char*>>& embedded_playcanvas_files();

const std::vector<std::pair<const char*, const char*>>& PlayCanvas::web_files() const {
  return embedded_playcanvas_files();
}

}  // namespace rnmbake
