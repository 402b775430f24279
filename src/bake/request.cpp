#include "bake/request.h"

#include "base/error.h"

#include <algorithm>
#include <fstream>
#include <map>
#include <set>
#include <span>
#include <string>

namespace rnmbake {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

/// A file of raw little-endian numbers for array.fromfile.
class ArrayFile {
 public:
  explicit ArrayFile(fs::path file) : file_(std::move(file)), stream_(file_, std::ios::binary) { check(); }

  template <typename T>
  void write(std::span<const T> values) {
    stream_.write(reinterpret_cast<const char*>(values.data()),
                  static_cast<std::streamsize>(values.size_bytes()));
    check();
  }
  void close() {
    stream_.close();
    check();
  }

 private:
  void check() const {
    if (!stream_)
      fail(ExitCode::io, "cannot write {}: is the disk full? (RNMBAKE's temporary files follow TMPDIR)",
           file_.string());
  }
  fs::path file_;
  std::ofstream stream_;
};

template <typename T>
void write_array(const fs::path& file, const std::vector<T>& values) {
  ArrayFile out(file);
  out.write(std::span<const T>(values));
  out.close();
}

std::string pixels_name(std::size_t picture) {
  return "pixels" + std::to_string(picture) + ".f32";
}

/// Corner arrays of several tiles as one mesh over one atlas: all positions, then all normals, then all UVs.
/// Goes through the tiles once for each, so that no second copy of them is held.
class JoinedCorners {
 public:
  void add(const Tile& tile, const Target& target, const Placement& place) {
    parts_.push_back({&tile.sheet.corners,
                      Vec2(static_cast<float>(target.width), static_cast<float>(target.height)),
                      Vec2(static_cast<float>(place.x - tile.x), static_cast<float>(place.y - tile.y))});
    count_ += tile.sheet.corners.size();
  }
  [[nodiscard]] std::size_t count() const { return count_; }

  void write(ArrayFile& out, const TileSize& atlas) const {
    const Vec2 whole(static_cast<float>(atlas.width), static_cast<float>(atlas.height));
    write_each<Vec3>(out, [](const Part&, const ReceiverCorner& corner) { return corner.position; });
    write_each<Vec3>(out, [](const Part&, const ReceiverCorner& corner) { return corner.normal; });
    write_each<Vec2>(out, [&](const Part& part, const ReceiverCorner& corner) {
      return (corner.uv * part.size + part.shift) / whole;
    });
  }

 private:
  struct Part {
    const std::vector<ReceiverCorner>* corners;
    Vec2 size, shift;  // texels of the lightmap; from there to the atlas
  };

  template <typename T, typename Value>
  void write_each(ArrayFile& out, Value value) const {
    std::vector<T> values;
    for (const Part& part : parts_) {
      values.clear();
      for (const ReceiverCorner& corner : *part.corners) values.push_back(value(part, corner));
      out.write(std::span<const T>(values));
    }
  }

  std::vector<Part> parts_;
  std::size_t count_ = 0;
};

std::vector<std::size_t> tiles_of(const Dispatch& dispatch, const Plan& plan) {
  std::vector<std::size_t> tiles;
  for (const std::size_t unit : dispatch.units) {
    const auto& more = plan.units[unit].tiles;
    tiles.insert(tiles.end(), more.begin(), more.end());
  }
  return tiles;
}

json base_request(const Dispatch& dispatch, const Plan& plan, const char* recipe) {
  return {{"recipe", recipe}, {"cycles", to_json(plan.units[dispatch.units.front()].cycles)}};
}

/// Writes one atlas; receivers that share a light-linking group are one mesh.
json write_atlas(const BakeContext& context, const DispatchLayout& layout, std::size_t atlas,
                 const fs::path& folder) {
  const TileSize size = layout.atlas.atlases[atlas];
  std::map<std::string, std::vector<std::size_t>> by_group;  // light group -> positions in layout.tiles
  std::int64_t texels = 0;
  for (std::size_t i = 0; i < layout.tiles.size(); ++i) {
    if (layout.atlas.placements[i].atlas != atlas) continue;
    const Tile& tile = context.plan.tiles[layout.tiles[i]];
    by_group[context.survey.objects[context.targets[tile.target].object].light_group].push_back(i);
    texels += std::int64_t(tile.size.width) * tile.size.height;
  }
  const std::string arrays = "receivers" + std::to_string(atlas) + ".f32";
  ArrayFile out(folder / arrays);
  json groups = json::array();
  for (const auto& [group, members] : by_group) {
    JoinedCorners joined;
    for (const std::size_t i : members) {
      const Tile& tile = context.plan.tiles[layout.tiles[i]];
      joined.add(tile, context.targets[tile.target], layout.atlas.placements[i]);
    }
    joined.write(out, size);
    groups.push_back({{"corners", joined.count()}, {"light_group", group}});
  }
  out.close();
  return {{"width", size.width},          {"height", size.height}, {"arrays", arrays},
          {"pixels", pixels_name(atlas)}, {"groups", groups},      {"covered_texels", texels}};
}

/// The fences of all targets of a dispatch: their corners, then `up` once for each corner.
json write_fences(const Dispatch& dispatch, const Plan& plan, const fs::path& folder) {
  std::set<std::size_t> targets;
  if (!plan.fences.empty()) {
    for (const std::size_t unit : dispatch.units) targets.insert(plan.units[unit].target);
  }
  std::vector<Vec3> corners, ups;
  for (const std::size_t target : targets) {
    for (const Fence& fence : plan.fences[target]) {
      corners.insert(corners.end(), fence.corners.begin(), fence.corners.end());
      ups.insert(ups.end(), 4, fence.up);
    }
  }
  const std::string arrays = "fences.f32";
  if (!corners.empty()) {
    ArrayFile out(folder / arrays);
    out.write(std::span<const Vec3>(corners));
    out.write(std::span<const Vec3>(ups));
    out.close();
  }
  return {{"arrays", arrays}, {"count", corners.size() / 4}};
}

/// Polygons of a target that is a part of its object; the whole object has no list.
std::vector<std::int32_t> part_polygons(const Mesh& mesh, const Part& part) {
  std::vector<std::int32_t> polygons;
  for (const std::uint32_t triangle : part.triangles)
    polygons.push_back(static_cast<std::int32_t>(mesh.triangle_polygon[triangle]));
  std::sort(polygons.begin(), polygons.end());
  polygons.erase(std::unique(polygons.begin(), polygons.end()), polygons.end());
  return polygons;
}

json describe_target(const BakeContext& context, std::size_t index, const fs::path& folder) {
  const Target& target = context.targets[index];
  const SceneObject& object = context.survey.objects[target.object];
  json description{{"key", object.key},
                   {"name", object.name},
                   {"label", target.key},
                   {"width", target.width},
                   {"height", target.height},
                   {"uv_layer", target.uv_layer},
                   {"tangent_layer", target.tangent_layer},
                   {"bakes", json::array()}};
  if (target.unwrapped) {
    description["uv_array"] = "uv" + std::to_string(index) + ".f32";
    write_array(folder / description["uv_array"].get<std::string>(), *target.uv);
  }
  if (!target.part.name.empty()) {
    description["polygons"] = "part" + std::to_string(index) + ".i32";
    write_array(folder / description["polygons"].get<std::string>(),
                part_polygons(context.survey.meshes[std::size_t(object.mesh)], target.part));
  }
  return description;
}

/// Blender's bottom-up rows become top-down ones.
FloatImage cut(const std::vector<float>& atlas, int atlas_width, const Placement& place,
               const TileSize& size) {
  FloatImage tile(size.width, size.height, 4);
  const std::size_t row = std::size_t(size.width) * 4;
  for (int y = 0; y < size.height; ++y) {
    const auto* from = &atlas[(std::size_t(place.y + y) * atlas_width + place.x) * 4];
    std::copy_n(from, row, &tile.data()[std::size_t(size.height - 1 - y) * row]);
  }
  return tile;
}

std::vector<float> read_pixels(const fs::path& file, const TileSize& size) {
  std::vector<float> pixels(std::size_t(size.width) * size.height * 4);
  std::error_code error;
  std::ifstream in;
  if (fs::is_regular_file(file, error)) in.open(file, std::ios::binary | std::ios::ate);
  if (!in.is_open()) fail(ExitCode::tasks_failed, "Blender left no picture {}", file.string());
  const auto bytes = static_cast<std::size_t>(in.tellg());
  if (bytes != pixels.size() * sizeof(float)) {
    fail(ExitCode::tasks_failed, "{} has {} bytes, a picture of {} x {} has {}: is the disk full?",
         file.string(), bytes, size.width, size.height, pixels.size() * sizeof(float));
  }
  in.seekg(0);
  in.read(reinterpret_cast<char*>(pixels.data()), static_cast<std::streamsize>(bytes));
  return pixels;
}

}  // namespace

nlohmann::json to_json(const CyclesSettings& settings) {
  return {{"samples", settings.samples},
          {"bounces", settings.bounces},
          {"seed", settings.seed},
          {"clamp", settings.clamp},
          {"device", settings.device}};
}

BakeRequest receiver_request(const BakeContext& context, const Dispatch& dispatch, std::int64_t max_pixels,
                             const fs::path& folder) {
  BakeRequest request{base_request(dispatch, context.plan, "receiver"),
                      {tiles_of(dispatch, context.plan), {}}};
  request.json["glow_heights"] = context.plan.glow_heights;
  request.json["fences"] = write_fences(dispatch, context.plan, folder);
  std::vector<TileSize> sizes;
  for (const std::size_t tile : request.layout.tiles) sizes.push_back(context.plan.tiles[tile].size);
  request.layout.atlas = pack(sizes, max_pixels);
  request.json["atlases"] = json::array();
  for (std::size_t atlas = 0; atlas < request.layout.atlas.atlases.size(); ++atlas) {
    request.json["atlases"].push_back(write_atlas(context, request.layout, atlas, folder));
  }
  return request;
}

BakeRequest object_request(const BakeContext& context, const Dispatch& dispatch, bool correct_bump,
                           const fs::path& folder) {
  BakeRequest request{base_request(dispatch, context.plan, "flat-normal-map"),
                      {tiles_of(dispatch, context.plan), {}}};
  request.json["correct_bump"] = correct_bump;
  std::map<std::size_t, json> described;
  for (std::size_t i = 0; i < request.layout.tiles.size(); ++i) {
    const Tile& tile = context.plan.tiles[request.layout.tiles[i]];
    request.layout.atlas.atlases.push_back(tile.size);  // each bake is a picture of its own
    request.layout.atlas.placements.push_back({i, 0, 0});
    auto [entry, is_new] = described.try_emplace(tile.target);
    if (is_new) entry->second = describe_target(context, tile.target, folder);
    const BasisDirection& basis = context.bases[tile.sheet.basis];
    const Vec3 direction = in_frame(basis.direction, context.targets[tile.target]);
    entry->second["bakes"].push_back({{"basis", basis.name},
                                      {"direction", {direction.x, direction.y, direction.z}},
                                      {"pixels", pixels_name(i)}});
  }
  request.json["targets"] = json::array();
  for (auto& [index, description] : described) request.json["targets"].push_back(std::move(description));
  return request;
}

std::vector<FloatImage> read_tiles(const DispatchLayout& layout, const Plan& plan, const fs::path& folder) {
  std::vector<FloatImage> tiles(layout.tiles.size());
  for (std::size_t atlas = 0; atlas < layout.atlas.atlases.size(); ++atlas) {
    const TileSize size = layout.atlas.atlases[atlas];
    const std::vector<float> pixels = read_pixels(folder / pixels_name(atlas), size);
    for (std::size_t i = 0; i < tiles.size(); ++i) {
      const Placement& place = layout.atlas.placements[i];
      if (place.atlas == atlas) tiles[i] = cut(pixels, size.width, place, plan.tiles[layout.tiles[i]].size);
    }
  }
  return tiles;
}

}  // namespace rnmbake
