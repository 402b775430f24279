// image/oiio_bytes.h - encodes a picture in memory, so that every byte's way to the disk can be checked.
// Private to the image room: the only header that shows OpenImageIO's types.
#pragma once

#include <filesystem>
#include <functional>

#include <OpenImageIO/imageio.h>

namespace rnmbake {

/// Encodes with the writer named `format` ("exr", "png") and writes the result whole to `file`.
/// `write_pixels` returns false where the writer refused. The libraries' own file writers lose errors that
/// come late (a full disk at close), hence the detour through memory.
void write_encoded(const std::filesystem::path& file, const char* format, const OIIO::ImageSpec& spec,
                   const std::function<bool(OIIO::ImageOutput&)>& write_pixels);

}  // namespace rnmbake
