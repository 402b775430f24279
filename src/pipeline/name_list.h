// pipeline/name_list.h - many names in one line of the log.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include <spdlog/fmt/fmt.h>

namespace rnmbake {

/// "a", "a, b, c" or "a, b, c and 12 more".
inline std::string name_list(const std::vector<std::string>& names, std::size_t most = 3) {
  std::string text;
  for (std::size_t i = 0; i < std::min(most, names.size()); ++i) text += (i > 0 ? ", " : "") + names[i];
  return names.size() > most ? fmt::format("{} and {} more", text, names.size() - most) : text;
}

}  // namespace rnmbake
