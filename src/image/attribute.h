// image/attribute.h - values in the headers of pictures.
#pragma once

#include <string>
#include <variant>
#include <vector>

namespace rnmbake {

/// A header attribute: text, a number, or a list of numbers (written as a float array where the format
/// has one, read back as the same). OpenImageIO drops empty texts when it reads.
using Attribute = std::variant<std::string, int, float, std::vector<float>>;

}  // namespace rnmbake
