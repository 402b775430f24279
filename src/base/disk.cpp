#include "base/disk.h"

#include <cstdint>

#include <unistd.h>

namespace rnmbake {

bool disk_is_full(const std::filesystem::path& folder) {
  constexpr std::uintmax_t least = 1 << 16;
  std::error_code error;
  const std::filesystem::space_info space = std::filesystem::space(folder, error);
  return !error && (::geteuid() == 0 ? space.free : space.available) < least;
}

}  // namespace rnmbake
