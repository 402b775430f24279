// cli/ssbump/ssbump_tool_flags.h - flags that the commands below `rnmbake ssbump` share.
#pragma once

#include "ssbump/map/picture.h"

#include <filesystem>
#include <string>

namespace CLI {
class App;
}

namespace rnmbake {

/// Input map, with the encoding to assume for files without metadata.
struct SsbumpInputFlags {
  std::filesystem::path file;
  std::string scale, handed, alpha;

  void add_to(CLI::App& command, const char* what = "self-shadowed bump map");
  [[nodiscard]] SsbumpHints hints() const;
  [[nodiscard]] SsbumpPicture read() const { return read_ssbump(file, hints()); }
};

/// Output file.
struct SsbumpOutputFlags {
  std::filesystem::path file;
  std::string bits;
  bool dither = true;

  void add_to(CLI::App& command, bool with_dither = true);
  /// Throws Error(usage) where no file was named.
  [[nodiscard]] SsbumpOutput output(const SsbumpEncoding& encoding) const;
};

[[nodiscard]] SsbumpBits bits_named(const std::string& text);

}  // namespace rnmbake
