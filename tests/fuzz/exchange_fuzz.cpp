// Feeds broken .rnmscene files to the reader: every one is read or refused with an Error, and what was read
// can be placed in the world, written, and read again. Run by ./dev fuzz.
#include "base/error.h"
#include "fuzz/parts.h"
#include "scene/diffuse_scene.h"
#include "trace/geometry/triangles.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <random>
#include <vector>

#include <nlohmann/json.hpp>

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t max_size);

namespace {

using nlohmann::json;
using namespace rnmbake;

/// Values that readers stumble over.
json odd_value(std::mt19937& random) {
  static const std::array<json, 18> values{
      0,           1,  -1,  2,     3,       6,      255,           65536,          0x7fffffff,
      0x80000000U, -2, 0.5, 1e300, nullptr, "text", json::array(), json::object(), 0x5555555555555556U};
  return values[random() % values.size()];
}

/// Changes, repeats or removes one value anywhere in the JSON part.
std::string bend_json(const std::string& text, std::mt19937& random) {
  json content = json::parse(text, nullptr, false);
  json* place = &content;
  while (!place->is_discarded() && place->is_structured() && !place->empty() && random() % 8 != 0) {
    auto child = place->begin();
    std::advance(child, random() % place->size());
    if (random() % 32 == 0) {
      place->erase(child);
      return content.dump(-1, ' ', false, json::error_handler_t::replace);
    }
    if (place->is_array() && random() % 32 == 0) {
      place->push_back(json(*child));
      return content.dump(-1, ' ', false, json::error_handler_t::replace);
    }
    place = &*child;
  }
  if (content.is_discarded()) return text;
  if (place->is_number_integer() && random() % 2 == 0) {
    *place = place->get<std::uint64_t>() + random() % 9 - 4;
  } else {
    *place = odd_value(random);
  }
  return content.dump(-1, ' ', false, json::error_handler_t::replace);
}

std::string mutate_bytes(std::string bytes, std::size_t max_size) {
  const std::size_t size = bytes.size();
  bytes.resize(std::max(size, max_size));
  bytes.resize(LLVMFuzzerMutate(reinterpret_cast<std::uint8_t*>(bytes.data()), size, bytes.size()));
  return bytes;
}

void place_in_world(const DiffuseScene& scene) {
  const Triangles triangles = world_triangles(scene);
  if (triangles.position.size() != 3 * triangles.size()) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const std::vector<char> bytes(data, data + size);
    const DiffuseScene scene = parse_diffuse_scene(bytes, "fuzz");
    place_in_world(scene);
    const std::string written = diffuse_scene_bytes(scene);
    const std::vector<char> again(written.begin(), written.end());
    try {
      (void)parse_diffuse_scene(again, "written");
    } catch (const Error&) {
      std::abort();  // what can be read can be written and read
    }
  } catch (const Error&) {
  }
  return 0;
}

/// Three in four inputs keep a sound header, and half of those a sound JSON: else little would get past it.
extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t max_size,
                                               unsigned seed) {
  std::mt19937 random(seed);
  const unsigned way = random() % 8;
  if (way < 2) return LLVMFuzzerMutate(data, size, max_size);
  fuzz::Parts parts = fuzz::take_apart(data, size);
  const std::size_t overhead =
      fuzz::header_bytes + fuzz::checksum_bytes + parts.text.size() + parts.data.size();
  const std::size_t spare = max_size > overhead ? max_size - overhead : 0;
  if (way < 5) {
    parts.text = bend_json(parts.text, random);
  } else if (way < 7) {
    parts.data = mutate_bytes(parts.data, parts.data.size() + spare);
  } else {
    parts.text = mutate_bytes(parts.text, parts.text.size() + spare);
  }
  const std::string file = fuzz::put_together(parts);
  if (file.size() > max_size) return LLVMFuzzerMutate(data, size, max_size);
  std::copy(file.begin(), file.end(), data);
  return file.size();
}
