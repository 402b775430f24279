// base/hash.h - short stable fingerprints (xxHash). Not for secrets.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace rnmbake {

/// XXH3, 64 bit; the same on every machine and in every release.
std::uint64_t hash64(std::string_view bytes);

/// The first `digits` (at most 16) hexadecimal digits of hash64.
std::string short_hash(std::string_view bytes, int digits = 8);

/// XXH3, 128 bit, as 32 hexadecimal digits.
std::string hash128_hex(std::string_view bytes);

/// The same over a file, whatever its size. Throws Error(io).
std::string file_hash128_hex(const std::filesystem::path& file);

}  // namespace rnmbake
