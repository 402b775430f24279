// image/oiio_open.h - opens a picture for reading, or says in one line why it cannot be read.
// Private to the image room, as it shows OpenImageIO's types.
#pragma once

#include "image/attribute.h"

#include <filesystem>
#include <map>
#include <memory>
#include <string>

#include <OpenImageIO/imageio.h>

namespace rnmbake {

/// Throws Error(io) where the file cannot be opened, Error(invalid_input) where it is no sound picture,
/// Error(unsupported) for deep pixels. Colours come without their alpha multiplied in.
[[nodiscard]] std::unique_ptr<OIIO::ImageInput> open_picture(const std::filesystem::path& file);

[[noreturn]] void fail_damaged(const std::filesystem::path& file, std::string reason);

/// What the header says, without the library's own remarks.
[[nodiscard]] std::map<std::string, Attribute> attributes_of(const OIIO::ImageSpec& spec);

void set_attribute(OIIO::ImageSpec& spec, const std::string& name, const Attribute& value);

}  // namespace rnmbake
