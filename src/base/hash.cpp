#include "base/hash.h"

#define XXH_INLINE_ALL
#include <spdlog/fmt/fmt.h>
#include <xxhash.h>

namespace rnmbake {

std::uint64_t hash64(std::string_view bytes) {
  return XXH3_64bits(bytes.data(), bytes.size());
}

std::string short_hash(std::string_view bytes, int digits) {
  return fmt::format("{:016x}", hash64(bytes)).substr(0, static_cast<std::size_t>(digits));
}

std::string hash128_hex(std::string_view bytes) {
  const XXH128_hash_t hash = XXH3_128bits(bytes.data(), bytes.size());
  return fmt::format("{:016x}{:016x}", hash.high64, hash.low64);
}

}  // namespace rnmbake
