// pipeline/deliver/web_files.h - what goes with a delivery for three.js: the module and the page of web/, and
// a decoder for them.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

namespace rnmbake {

/// Encodings that web/threejs/rnmbake_lightmaps.js can be given a decoder for.
[[nodiscard]] const std::vector<std::string>& web_encodings();

/// "layers": their names, in the order of the decoder's arguments; "function": its name; "text": GLSL.
[[nodiscard]] nlohmann::json web_decoder(const std::string& encoding, const std::vector<std::string>& layers);

/// Name and text of each file.
[[nodiscard]] const std::vector<std::pair<const char*, const char*>>& web_files();

}  // namespace rnmbake
