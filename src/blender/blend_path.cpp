#include "blender/blend_path.h"

#include "base/text.h"

#include <stdexcept>

namespace rnmbake {

namespace fs = std::filesystem;

bool is_blend(const fs::path& file) {
  return lower_extension(file) == ".blend";
}

BlendPath::BlendPath(const fs::path& file) : path_(fs::absolute(file)) {
  if (!is_blend(file)) throw std::invalid_argument(file.string() + " is no .blend");
}

}  // namespace rnmbake
