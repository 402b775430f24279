// scene/diffuse_scene_parts.h - the steps between the bytes of a .rnmscene file and an Exchange.
#pragma once

#include "scene/blob.h"
#include "scene/diffuse_scene.h"

#include <string>
#include <vector>

namespace rnmbake {

/// From the JSON part (a survey with the key "exchange") and the binary part. Throws Error without the file's
/// name and nlohmann's exceptions.
[[nodiscard]] Exchange parse_exchange_content(const nlohmann::json& content, Blob& data);

/// Whether indices, sizes and values fit each other. Throws Error(invalid_input) naming the owner.
void check_exchange(const Exchange& scene);

/// One picture from its entry, every texel checked. Throws Error(invalid_input) naming it.
[[nodiscard]] Picture parse_picture(const nlohmann::json& entry, Blob& data);

/// The entry of a picture whose texels are appended to `data`, in the smallest form that loses nothing.
[[nodiscard]] nlohmann::json store_picture(const Picture& picture, std::string& data);

/// The JSON part; what it refers to is appended to `data`.
[[nodiscard]] nlohmann::json store_exchange(const Exchange& scene, std::string& data);

}  // namespace rnmbake
