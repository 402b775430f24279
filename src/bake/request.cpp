#include "bake/request.h"

#include "bake/mirrors.h"
#include "base/error.h"
#include "base/numeric/row_order.h"
#include "config/recipe_names.h"

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

std::string pixels_name(std::size_t pass, std::size_t picture) {
  return "pass" + std::to_string(pass) + "-" + std::to_string(picture) + ".f32";
}

/// Corner arrays of several rectangles as one mesh over one atlas: all positions, then all normals, then all
/// UVs. Goes through the rectangles once for each, so that no second copy of them is held.
class JoinedCorners {
 public:
  void add(const AtlasRect& rect, const RectSize& map, const Placement& place) {
    const RectSize& of = rect.pass.mirrors.empty() ? map : rect.size;
    parts_.push_back({&rect, Vec2(static_cast<float>(of.width), static_cast<float>(of.height)),
                      Vec2(static_cast<float>(place.x - rect.x), static_cast<float>(place.y - rect.y))});
    count_ += 3 * rect.pass.triangles();
  }
  [[nodiscard]] std::size_t count() const { return count_; }

  void write(ArrayFile& out, const RectSize& atlas) const {
    const Vec2 whole(static_cast<float>(atlas.width), static_cast<float>(atlas.height));
    write_each<Vec3>(out, [](const Part&, const ReceiverCorner& corner) { return corner.position; });
    write_each<Vec3>(out, [](const Part&, const ReceiverCorner& corner) { return corner.normal; });
    write_each<Vec2>(out, [&](const Part& part, const ReceiverCorner& corner) {
      return (corner.uv * part.size + part.shift) / whole;
    });
  }

 private:
  struct Part {
    const AtlasRect* rect;
    Vec2 size, shift;  // texels that UVs count in; from there to the atlas
  };

  template <typename T, typename Value>
  void write_each(ArrayFile& out, Value value) const {
    std::vector<T> values;
    for (const Part& part : parts_) {
      values.clear();
      const ReceiverPass& pass = part.rect->pass;
      for (const ReceiverCorner& corner : pass.corners) values.push_back(value(part, corner));
      for (std::size_t i = 0; i < pass.mirrors.size(); ++i) {
        for (const ReceiverCorner& corner : mirror_triangle(pass.mirrors[i], i, part.rect->size))
          values.push_back(value(part, corner));
      }
      out.write(std::span<const T>(values));
    }
  }

  std::vector<Part> parts_;
  std::size_t count_ = 0;
};

std::vector<std::size_t> rects_of(const Batch& batch, const Plan& plan) {
  std::vector<std::size_t> rects;
  for (const std::size_t task : batch.tasks) {
    const auto& more = plan.tasks[task].rects;
    rects.insert(rects.end(), more.begin(), more.end());
  }
  return rects;
}

json base_request(const Batch& batch, const Plan& plan, const char* recipe) {
  return {{"recipe", recipe}, {"cycles", to_json(plan.tasks[batch.tasks.front()].cycles)}};
}

/// Writes one atlas; receivers that share a light-linking group are one mesh.
json write_atlas(const Plan& plan, const BatchLayout& layout, std::size_t atlas, const fs::path& folder) {
  const RectSize size = layout.atlas.atlases[atlas];
  std::map<std::string, std::vector<std::size_t>> by_group;  // light group -> positions in layout.rects
  std::int64_t texels = 0;
  for (std::size_t i = 0; i < layout.rects.size(); ++i) {
    if (layout.atlas.placements[i].atlas != atlas) continue;
    const AtlasRect& rect = plan.rects[layout.rects[i]];
    by_group[plan.targets[rect.target].light_group].push_back(i);
    texels += std::int64_t(rect.size.width) * rect.size.height;
  }
  const std::string arrays = "receivers" + std::to_string(atlas) + ".f32";
  ArrayFile out(folder / arrays);
  json groups = json::array();
  for (const auto& [group, members] : by_group) {
    JoinedCorners joined;
    for (const std::size_t i : members) {
      const AtlasRect& rect = plan.rects[layout.rects[i]];
      joined.add(rect, plan.targets[rect.target].map, layout.atlas.placements[i]);
    }
    if (joined.count() == 0) continue;  // all its triangles lie between the centres of texels
    joined.write(out, size);
    json parts = json::array();
    for (const std::size_t i : members)
      parts.push_back({i, 3 * plan.rects[layout.rects[i]].pass.triangles()});
    groups.push_back({{"corners", joined.count()}, {"light_group", group}, {"parts", parts}});
  }
  out.close();
  return {{"width", size.width},
          {"height", size.height},
          {"arrays", arrays},
          {"groups", groups},
          {"covered_texels", texels}};
}

/// The fences of all targets of a batch: their corners, then `up` once for each corner.
json write_fences(const std::vector<std::vector<Fence>>& fences, const Batch& batch, const Plan& plan,
                  const fs::path& folder) {
  std::set<std::size_t> targets;
  if (!fences.empty()) {
    for (const std::size_t task : batch.tasks) targets.insert(plan.tasks[task].target);
  }
  std::vector<Vec3> corners, ups;
  for (const std::size_t target : targets) {
    for (const Fence& fence : fences[target]) {
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
               const RectSize& size) {
  FloatImage rect(size.width, size.height, 4);
  const std::size_t row = std::size_t(size.width) * 4;
  for (int y = 0; y < size.height; ++y) {
    const auto* from = &atlas[(std::size_t(place.y + y) * atlas_width + place.x) * 4];
    std::copy_n(from, row, &rect.data()[std::size_t(other_row(y, size.height)) * row]);
  }
  return rect;
}

std::vector<float> read_pixels(const fs::path& file, const RectSize& size) {
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
  return {{"samples", settings.samples}, {"bounces", settings.bounces}, {"seed", settings.seed},
          {"clamp", settings.clamp},     {"device", settings.device},   {"lamps", settings.lamps},
          {"mirrors", settings.mirrors}};
}

BakeRequest receiver_request(const Plan& plan, const Batch& batch, std::int64_t max_pixels,
                             const fs::path& folder) {
  BakeRequest request{base_request(batch, plan, name_of(BakingSettings::Recipe::receiver)),
                      {rects_of(batch, plan), {}}};
  request.json["absent"] = plan.absent;
  if (plan.guards && !plan.tasks[batch.tasks.front()].cycles.mirrors) {
    request.json["guards"] = {{"glow_heights", plan.guards->glow_heights},
                              {"fences", write_fences(plan.guards->fences, batch, plan, folder)}};
  }
  std::vector<RectSize> sizes;
  for (const std::size_t rect : request.layout.rects) sizes.push_back(plan.rects[rect].size);
  request.layout.atlas = pack(sizes, max_pixels);
  request.json["meets_light"] = json::array();
  for (std::size_t i = 0; i < request.layout.rects.size(); ++i) {
    if (plan.rects[request.layout.rects[i]].pass.meets_light) request.json["meets_light"].push_back(i);
  }
  request.json["atlases"] = json::array();
  for (std::size_t atlas = 0; atlas < request.layout.atlas.atlases.size(); ++atlas) {
    request.json["atlases"].push_back(write_atlas(plan, request.layout, atlas, folder));
  }
  return request;
}

BakeRequest object_request(const BakeContext& context, const Batch& batch, bool correct_bump,
                           const fs::path& folder) {
  BakeRequest request{base_request(batch, context.plan, flat_normal_map_name),
                      {rects_of(batch, context.plan), {}}};
  request.json["correct_bump"] = correct_bump;
  std::map<std::size_t, json> described;
  for (std::size_t i = 0; i < request.layout.rects.size(); ++i) {
    const AtlasRect& rect = context.plan.rects[request.layout.rects[i]];
    request.layout.atlas.atlases.push_back(rect.size);  // each bake is a picture of its own
    request.layout.atlas.placements.push_back({i, 0, 0});
    auto [entry, is_new] = described.try_emplace(rect.target);
    if (is_new) entry->second = describe_target(context, rect.target, folder);
    const BasisDirection& basis = context.bases[rect.pass.basis];
    const Vec3 direction = in_frame(basis.direction, context.targets[rect.target]);
    entry->second["bakes"].push_back({{"basis", basis.name},
                                      {"direction", {direction.x, direction.y, direction.z}},
                                      {"pixels", pixels_name(0, i)}});
  }
  request.json["targets"] = json::array();
  for (auto& [index, description] : described) request.json["targets"].push_back(std::move(description));
  return request;
}

nlohmann::json pass_request(const SamplePass& pass, std::size_t number, const BatchLayout& layout, int seed) {
  return {{"number", number},    {"seed", seed_of_half(seed, pass.half)},
          {"first", pass.first}, {"count", pass.count},
          {"of", pass.of},       {"pixels", pass_files(number, layout)}};
}

std::vector<std::string> pass_files(std::size_t number, const BatchLayout& layout) {
  std::vector<std::string> names;
  for (std::size_t atlas = 0; atlas < layout.atlas.atlases.size(); ++atlas)
    names.push_back(pixels_name(number, atlas));
  return names;
}

std::vector<FloatImage> read_rects(const BatchLayout& layout, const Plan& plan, const fs::path& folder,
                                   std::size_t number) {
  std::vector<FloatImage> rects(layout.rects.size());
  for (std::size_t atlas = 0; atlas < layout.atlas.atlases.size(); ++atlas) {
    const RectSize size = layout.atlas.atlases[atlas];
    const std::vector<float> pixels = read_pixels(folder / pixels_name(number, atlas), size);
    for (std::size_t i = 0; i < rects.size(); ++i) {
      const Placement& place = layout.atlas.placements[i];
      if (place.atlas == atlas) rects[i] = cut(pixels, size.width, place, plan.rects[layout.rects[i]].size);
    }
  }
  return rects;
}

}  // namespace rnmbake
