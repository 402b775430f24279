#include "base/hash.h"

#include "base/error.h"

#include <fstream>
#include <iterator>
#include <vector>

#define XXH_INLINE_ALL
#include <spdlog/fmt/fmt.h>
#include <xxhash.h>

namespace rnmbake {
namespace {

std::string hex(const XXH128_hash_t& hash) {
  return fmt::format("{:016x}{:016x}", hash.high64, hash.low64);
}

}  // namespace

std::uint64_t hash64(std::string_view bytes) {
  return XXH3_64bits(bytes.data(), bytes.size());
}

std::string short_hash(std::string_view bytes, int digits) {
  return fmt::format("{:016x}", hash64(bytes)).substr(0, static_cast<std::size_t>(digits));
}

std::string hash128_hex(std::string_view bytes) {
  const XXH128_hash_t hash = XXH3_128bits(bytes.data(), bytes.size());
  return hex(hash);
}

std::string file_hash128_hex(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  XXH3_state_t state;
  XXH3_128bits_reset(&state);
  std::vector<char> block(1 << 20);
  while (in) {
    in.read(block.data(), std::ssize(block));
    XXH3_128bits_update(&state, block.data(), static_cast<std::size_t>(in.gcount()));
  }
  if (!in.eof())
    fail(ExitCode::io, "{}: cannot be read; check that it exists and its permissions", file.string());
  return hex(XXH3_128bits_digest(&state));
}

}  // namespace rnmbake
