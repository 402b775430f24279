#include "base/files.h"
#include "base/hash.h"
#include "base/json.h"
#include "base/read_file.h"
#include "scene/diffuse_scene_parts.h"
#include "scene/survey_parse.h"

#include <string_view>

namespace rnmbake {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

// The file: magic, version, sizes; the JSON part, filled up with blanks; the binary part; the checksum of
// everything before it (docs/rnmscene-format.md). Little-endian.
constexpr std::string_view magic = "rnmscene";
constexpr std::uint32_t format_version = 2, oldest_version = 1;  // version 1 knew no transmittance
constexpr std::size_t alignment = 16;

struct Header {
  char magic[8];
  std::uint32_t version, reserved;
  std::uint64_t json_bytes, data_bytes;
};
static_assert(sizeof(Header) == 32);

constexpr std::size_t checksum_bytes = sizeof(std::uint64_t);

Header read_header(std::string_view bytes, const std::string& name) {
  Header header{};
  if (bytes.size() < sizeof(Header) + checksum_bytes ||
      std::memcmp(bytes.data(), magic.data(), magic.size()) != 0)
    fail(ExitCode::invalid_input, "{}: not a scene that rnmbake export wrote", name);
  std::memcpy(&header, bytes.data(), sizeof(Header));
  if (header.version < oldest_version || header.version > format_version) {
    fail(ExitCode::unsupported,
         "{}: format {} of .rnmscene, this rnmbake reads {} to {}; export the scene again", name,
         header.version, oldest_version, format_version);
  }
  const std::size_t room = bytes.size() - sizeof(Header) - checksum_bytes;
  if (header.json_bytes > room || header.data_bytes != room - header.json_bytes) {
    fail(ExitCode::invalid_input,
         "{}: it has {} bytes where its beginning promises another size; it was cut off or damaged on its "
         "way, "
         "copy or export it again",
         name, bytes.size());
  }
  return header;
}

std::uint64_t checksum(std::string_view bytes) {
  return hash64(bytes);
}

void check_checksum(std::string_view bytes, const std::string& name) {
  const std::size_t covered = bytes.size() - checksum_bytes;
  std::uint64_t promised = 0;
  std::memcpy(&promised, bytes.data() + covered, checksum_bytes);
  if (checksum(bytes.substr(0, covered)) != promised) {
    fail(ExitCode::invalid_input,
         "{}: its checksum is wrong, so it was damaged on its way; copy or export it again", name);
  }
}

/// Runs `parse` with the name of the file in front of whatever goes wrong.
template <typename Parse>
DiffuseScene named(const std::string& name, Parse parse) {
  try {
    return parse();
  } catch (const json::exception& error) {
    fail(ExitCode::invalid_input, "{}: not a scene that this rnmbake can read: {}", name, brief(error));
  } catch (const Error& error) {
    throw Error(error.code(), name + ": " + error.what());
  }
}

DiffuseScene parse(std::string_view bytes, const std::string& name) {
  const Header header = read_header(bytes, name);
  return named(name, [&] {
    const char* text = bytes.data() + sizeof(Header);
    Blob data(text + header.json_bytes, header.data_bytes);
    return parse_diffuse_scene_content(parse_json({text, header.json_bytes}, "its description"), data);
  });
}

}  // namespace

DiffuseScene parse_diffuse_scene(const std::vector<char>& bytes, const std::string& name) {
  return parse({bytes.data(), bytes.size()}, name);
}

DiffuseScene read_diffuse_scene(const fs::path& file) {
  const std::string bytes = read_data(file);
  (void)read_header(bytes, file.string());  // first, since it says more of a file that was cut off
  check_checksum(bytes, file.string());
  return parse(bytes, file.string());
}

DiffuseScene read_exported(const fs::path& json_file) {
  const std::string text = read_text(json_file);
  return named(json_file.string(), [&] {
    const json content = parse_json(text, "its description");
    const std::string bytes = read_data(data_file(content, json_file.parent_path()));
    if (bytes.size() != count_at(content, "data_bytes"))
      fail(ExitCode::invalid_input, "its data has {} bytes, {} were written; is the disk full?", bytes.size(),
           count_at(content, "data_bytes"));
    Blob data(bytes.data(), bytes.size());
    return parse_diffuse_scene_content(content, data);
  });
}

std::string diffuse_scene_bytes(const DiffuseScene& scene) {
  std::string data;
  std::string text = store_diffuse_scene(scene, data).dump(-1, ' ', false, json::error_handler_t::replace);
  text.append((alignment - text.size() % alignment) % alignment, ' ');
  Header header{{}, format_version, 0, text.size(), data.size()};
  magic.copy(header.magic, magic.size());
  std::string bytes(reinterpret_cast<const char*>(&header), sizeof(Header));
  bytes += text;
  bytes += data;
  const std::uint64_t sum = checksum(bytes);
  bytes.append(reinterpret_cast<const char*>(&sum), sizeof(sum));
  return bytes;
}

std::string light_hash(const DiffuseScene& scene) {
  std::string data;
  json content = store_diffuse_scene(scene, data);
  for (const char* other : {"scene_file", "scene_name", "warnings", "probe_places"}) content.erase(other);
  for (const char* other : {"camera", "outside"}) content["exchange"].erase(other);
  return hash128_hex(content.dump(-1, ' ', false, json::error_handler_t::replace) + hash128_hex(data));
}

void write_diffuse_scene(const fs::path& file, const DiffuseScene& scene) {
  write_atomically(file, diffuse_scene_bytes(scene));
}

}  // namespace rnmbake
