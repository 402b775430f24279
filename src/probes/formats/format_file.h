// probes/formats/format_file.h - a file in the making.
#pragma once

#include <string>

namespace rnmbake {

/// `name` has no folders.
struct FormatFile {
  std::string name, bytes;
};

}  // namespace rnmbake
