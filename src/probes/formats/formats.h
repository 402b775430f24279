// probes/formats/formats.h - volumes of light probes as the files that engines read.
#pragma once

#include "probes/formats/format_file.h"
#include "probes/probe_volume.h"

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace rnmbake {

/// A kind of files; docs/probes-formats.md says what is in them, in which units, along which axes.
struct ProbeFormat {
  std::string_view name;     // as after --to
  std::string_view purpose;  // a line of help
  std::string_view files;    // what is written, STEM for a volume's name
  /// Throws Error(unsupported), naming the volume, where the format has no place for what a volume is.
  std::vector<FormatFile> (*make)(std::span<const ProbeVolume> volumes);
};

[[nodiscard]] std::span<const ProbeFormat> probe_formats();

/// Throws Error(usage) with the nearest name where there is none.
[[nodiscard]] const ProbeFormat& probe_format_named(const std::string& name);

/// All files of a format into `folder`, which is made where it is missing, each of them whole or not at all;
/// their paths. Throws what `make` throws before anything is written, and Error(io).
std::vector<std::filesystem::path> write_probe_format(const std::string& name,
                                                      std::span<const ProbeVolume> volumes,
                                                      const std::filesystem::path& folder);

}  // namespace rnmbake
