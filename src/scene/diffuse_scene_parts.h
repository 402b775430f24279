// scene/diffuse_scene_parts.h - the steps between the bytes of a .rnmscene file and an DiffuseScene.
#pragma once

#include "scene/blob.h"
#include "scene/diffuse_scene.h"

#include <string>
#include <vector>

namespace rnmbake {

/// From the JSON part (a survey with the key "exchange") and the binary part. Throws Error without the file's
/// name and nlohmann's exceptions.
[[nodiscard]] DiffuseScene parse_diffuse_scene_content(const nlohmann::json& content, Blob& data);

/// Whether indices, sizes and values fit each other. Throws Error(invalid_input) naming the owner.
void check_diffuse_scene(const DiffuseScene& scene);

/// One picture from its entry, every texel checked. Throws Error(invalid_input) naming it.
[[nodiscard]] Texture parse_picture(const nlohmann::json& entry, Blob& data);

/// The entry of a picture whose texels are appended to `data`, in the smallest form that loses nothing.
[[nodiscard]] nlohmann::json store_picture(const Texture& picture, std::string& data);

/// The JSON part; what it refers to is appended to `data`.
[[nodiscard]] nlohmann::json store_diffuse_scene(const DiffuseScene& scene, std::string& data);

}  // namespace rnmbake
