// pipeline/deliver/engines/shipped_files.h - texts that go with a delivery, name and text of each: the
// folders of web/ and engines/, embedded.
#pragma once

#include <utility>
#include <vector>

namespace rnmbake {

using ShippedFiles = std::vector<std::pair<const char*, const char*>>;

[[nodiscard]] const ShippedFiles& embedded_threejs_files();
[[nodiscard]] const ShippedFiles& embedded_playcanvas_files();
[[nodiscard]] const ShippedFiles& embedded_babylon_files();
[[nodiscard]] const ShippedFiles& embedded_unity_files();
[[nodiscard]] const ShippedFiles& embedded_unreal_files();
[[nodiscard]] const ShippedFiles& embedded_source_files();
[[nodiscard]] const ShippedFiles& embedded_bevy_files();

}  // namespace rnmbake
