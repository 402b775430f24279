#include "blender/blend_header.h"

#include "base/error.h"
#include "base/read_file.h"

#include <array>
#include <charconv>
#include <string_view>
#include <tuple>

#include <zlib.h>
#include <zstd.h>

namespace rnmbake {
namespace {

constexpr std::size_t header_bytes = 17;
constexpr std::size_t compressed_bytes = std::size_t{256} << 10;  // more than a block of zstd
constexpr std::string_view magic = "BLENDER", gzip_magic = "\x1f\x8b", zstd_magic = "\x28\xb5\x2f\xfd";

std::string inflated(const std::string& bytes) {
  std::string out(header_bytes, '\0');
  z_stream stream{};
  if (inflateInit2(&stream, 16 + MAX_WBITS) != Z_OK) return "";
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(out.data());
  stream.avail_out = static_cast<uInt>(out.size());
  (void)inflate(&stream, Z_SYNC_FLUSH);
  out.resize(out.size() - stream.avail_out);
  inflateEnd(&stream);
  return out;
}

std::string unpacked(const std::string& bytes) {
  std::string out(header_bytes, '\0');
  ZSTD_DStream* stream = ZSTD_createDStream();
  ZSTD_inBuffer in{bytes.data(), bytes.size(), 0};
  ZSTD_outBuffer to{out.data(), out.size(), 0};
  while (stream != nullptr && to.pos < to.size && in.pos < in.size) {
    if (ZSTD_isError(ZSTD_decompressStream(stream, &to, &in)) != 0) break;
  }
  ZSTD_freeDStream(stream);
  out.resize(to.pos);
  return out;
}

std::string first_bytes(const std::filesystem::path& file) {
  require_regular_file(file);
  const std::string bytes = read_part(file, 0, compressed_bytes);
  if (bytes.starts_with(gzip_magic)) return inflated(bytes);
  if (bytes.starts_with(zstd_magic)) return unpacked(bytes);
  return bytes.substr(0, header_bytes);
}

/// "304" or "0500": hundreds are the major version.
std::optional<BlendHeader> version_of(std::string_view digits) {
  int number = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  if (error != std::errc() || end != digits.data() + digits.size() || number < 100) return std::nullopt;
  return BlendHeader{number / 100, number % 100};
}

bool is_newer(const BlendHeader& header, const BlenderVersion& version) {
  return std::tie(header.major, header.minor) > std::tie(version.major, version.minor);
}

/// Files of 5.0 and later have a header and blocks that 4.5 was the first to read.
bool is_later_form(const BlendHeader& header, const BlenderVersion& version) {
  return header.major >= 5 && version < BlenderVersion{4, 5, 0};
}

std::string said(const std::filesystem::path& file, const BlendHeader& header, const BlenderInfo& blender,
                 const std::string& which) {
  return fmt::format(
      "{} was saved by Blender {}.{}, this is {}, {}; name Blender {}.{} or newer with --blender",
      file.string(), header.major, header.minor, blender.version_text, which, header.major, header.minor);
}

}  // namespace

std::optional<BlendHeader> read_blend_header(const std::filesystem::path& file) {
  const std::string bytes = first_bytes(file);
  const std::string_view text = bytes;
  if (!text.starts_with(magic)) return std::nullopt;
  if (text.size() >= 12 && (text[8] == 'v' || text[8] == 'V')) return version_of(text.substr(9, 3));
  if (text.size() >= 17 && text[12] == 'v') return version_of(text.substr(13, 4));
  return std::nullopt;
}

std::string unreadable_blend(const std::filesystem::path& file, const BlenderInfo& blender) {
  const auto header = read_blend_header(file);
  if (!header || !is_later_form(*header, blender.version)) return "";
  return said(file, *header, blender, "which cannot read it");
}

std::string newer_blend(const std::filesystem::path& file, const BlenderInfo& blender,
                        const std::string& which) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) return "";  // its reader reports that
  const auto header = read_blend_header(file);
  return header && is_newer(*header, blender.version) ? said(file, *header, blender, which) : "";
}

}  // namespace rnmbake
