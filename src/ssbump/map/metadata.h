// ssbump/map/metadata.h - encoding and origin of a self-shadowed bump map, to and from a file's attributes.
#pragma once

#include "image/layered_exr.h"
#include "image/picture_rows.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>

namespace rnmbake {

/// Value of a channel where light is not occluded. third: 1/3, so that the three sum to 1; ndotb: N . B =
/// 1/sqrt 3; mod2x: half of that, doubled by the shader.
enum class SsbumpScale : std::uint8_t { third, ndotb, mod2x };

/// Direction of y: right-handed up (OpenGL, Blender), left-handed down (Direct3D, Source). The channels keep
/// their axes, so that left is right with channels 2 and 3 swapped.
enum class Handed : std::uint8_t { right, left };

/// The fourth channel. Both are 1 in the open, whatever the scale.
enum class SsbumpAlpha : std::uint8_t { none, up, ao };

[[nodiscard]] float flat_value(SsbumpScale scale);
[[nodiscard]] const char* name_of(SsbumpScale scale);
[[nodiscard]] const char* name_of(Handed handed);
[[nodiscard]] const char* name_of(SsbumpAlpha alpha);

/// Named as on the command line; nothing for a name that does not exist.
[[nodiscard]] std::optional<SsbumpScale> scale_named(const std::string& name);
[[nodiscard]] std::optional<Handed> handed_named(const std::string& name);
[[nodiscard]] std::optional<SsbumpAlpha> alpha_named(const std::string& name);

struct SsbumpMetadata {
  // Encoding.
  SsbumpScale scale = SsbumpScale::third;
  Handed handed = Handed::right;
  SsbumpAlpha alpha = SsbumpAlpha::none;
  double power = 1;
  // Origin: "horizon", "normal map", ... and its settings in words.
  std::string method, settings;
};

/// As attributes of a file: one "ImageDescription", which every format keeps, and "rnmbake:..." for each
/// part.
[[nodiscard]] std::map<std::string, Attribute> attributes_of(const SsbumpMetadata& metadata);

/// Nothing where the attributes are not those of a self-shadowed bump map. Throws Error(invalid_input),
/// naming `file`, where a part is missing or has a value that does not exist.
[[nodiscard]] std::optional<SsbumpMetadata> ssbump_metadata(
    const std::map<std::string, Attribute>& attributes, const std::string& file);

}  // namespace rnmbake
