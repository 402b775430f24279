#include "pipeline/deliver/engines/gltf.h"

#include "pipeline/deliver/engines/web_decoder.h"

#include <algorithm>
#include <iterator>

namespace rnmbake {

const std::vector<std::string>& Gltf::encodings() const {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all{flat};
    std::ranges::copy(web_encodings(), std::back_inserter(all));
    return all;
  }();
  return names;
}

}  // namespace rnmbake
