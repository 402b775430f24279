#include "probes/formats/makers.h"

#include "base/error.h"
#include "base/names.h"

#include <algorithm>
#include <bit>
#include <utility>

#include <half.h>
#include <nlohmann/json.hpp>

namespace rnmbake {

/// The files of shipped/, name and text.
const std::vector<std::pair<const char*, const char*>>& embedded_probe_files();

namespace {

template <typename Number>
void append_little_endian(std::string& bytes, Number value) {
  for (std::size_t i = 0; i < sizeof(Number); ++i)
    bytes.push_back(static_cast<char>(static_cast<unsigned char>(value >> (8 * i))));
}

}  // namespace

FormatFile shipped_file(const std::string& name) {
  const auto& files = embedded_probe_files();
  const auto found = std::ranges::find_if(files, [&](const auto& file) { return name == file.first; });
  if (found == files.end()) throw std::logic_error("no file of shipped/ is called " + name);
  return {name, found->second};
}

std::vector<std::string> volume_stems(std::span<const ProbeVolume> volumes) {
  FileStems stems;
  std::vector<std::string> found;
  for (const ProbeVolume& volume : volumes)
    found.push_back(stems.take(volume.name.empty() ? "probes" : volume.name));
  return found;
}

void append_half(std::string& bytes, float value) {
  append_u16(bytes, half(std::clamp(value, -65504.0F, 65504.0F)).bits());
}

void append_float(std::string& bytes, float value) {
  append_u32(bytes, std::bit_cast<std::uint32_t>(value));
}

void append_double(std::string& bytes, double value) {
  append_u64(bytes, std::bit_cast<std::uint64_t>(value));
}

void append_u16(std::string& bytes, std::uint16_t value) {
  append_little_endian(bytes, value);
}

void append_u32(std::string& bytes, std::uint32_t value) {
  append_little_endian(bytes, value);
}

void append_u64(std::string& bytes, std::uint64_t value) {
  append_little_endian(bytes, value);
}

std::string decimal(double value) {
  std::string text = fmt::format("{}", static_cast<float>(value));
  if (text.find_first_of(".en") == std::string::npos) text += ".0";
  return text;
}

std::string string_literal(std::string_view text) {
  return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace rnmbake
