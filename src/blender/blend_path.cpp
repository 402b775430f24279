#include "blender/blend_path.h"

#include <algorithm>
#include <cctype>
#include <stdexcept>

namespace rnmbake {

namespace fs = std::filesystem;

bool is_blend(const fs::path& file) {
  std::string ending = file.extension().string();
  std::ranges::transform(ending, ending.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending == ".blend";
}

BlendPath::BlendPath(const fs::path& file) : path_(fs::absolute(file)) {
  if (!is_blend(file)) throw std::invalid_argument(file.string() + " is no .blend");
}

}  // namespace rnmbake
