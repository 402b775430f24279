// pipeline/deliver/engines/web_decoder.h - what engines in a browser decode the pages by: GLSL of shaders/.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace rnmbake {

/// Directional encodings that there is a decoder for, the best use of a bake's memory first.
[[nodiscard]] const std::vector<std::string>& web_encodings();

/// Of a delivery's record with its pages. "layers": their names, in the order of the decoder's arguments;
/// "function": its name; "text": GLSL.
[[nodiscard]] nlohmann::json web_decoder(const nlohmann::ordered_json& record);

}  // namespace rnmbake
