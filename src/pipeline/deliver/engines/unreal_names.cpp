#include "pipeline/deliver/engines/unreal_names.h"

#include "base/error.h"
#include "base/text.h"

#include <algorithm>
#include <iterator>

#include <spdlog/fmt/fmt.h>

namespace rnmbake {

std::string unreal_name(std::string_view name) {
  std::string valid(name);
  std::ranges::replace_if(
      valid,
      [](char c) {
        return std::string_view("\"' ,/.:|&!~\n\r\t@#(){}[]=;^%$`\\*?<>").find(c) != std::string_view::npos;
      },
      '_');
  return valid;
}

UnrealNames::UnrealNames(const GlbNodes& nodes) : nodes_(nodes) {
  for (std::size_t node = 0; node < nodes.size(); ++node)
    nodes_by_name_.emplace(lower_case(unreal_name(nodes.name(node))), node);
}

void UnrealNames::check(std::size_t node) const {
  const auto [first, end] = nodes_by_name_.equal_range(lower_case(unreal_name(nodes_.name(node))));
  if (std::distance(first, end) > 1)
    fail(ExitCode::unsupported,
         "Unreal calls the objects '{}' and '{}' the same, '{}', but for letters' case; rename one",
         nodes_.name(first->second), nodes_.name(std::next(first)->second), unreal_name(nodes_.name(node)));
}

}  // namespace rnmbake
