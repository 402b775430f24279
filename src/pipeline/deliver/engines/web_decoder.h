// pipeline/deliver/engines/web_decoder.h - what engines whose shaders are made when they run decode
// the pages by: functions of shaders/.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace rnmbake {

/// Directional encodings that there is a decoder for, the best use of a bake's memory first.
[[nodiscard]] const std::vector<std::string>& web_encodings();

/// Of a delivery's record with its pages. "layers": their names, in the order of the decoder's arguments;
/// "function": its name; "text": GLSL, or what --engine of `rnmbake shaders` stands for (not for flat pages).
[[nodiscard]] nlohmann::json web_decoder(const nlohmann::ordered_json& record,
                                         const std::string& shader_engine = "glsl");

}  // namespace rnmbake
