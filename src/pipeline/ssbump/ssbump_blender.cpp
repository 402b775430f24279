#include "pipeline/ssbump/ssbump_blender.h"

#include "bake/plan.h"
#include "bake/request.h"
#include "base/error.h"
#include "base/log.h"
#include "base/read_file.h"
#include "encoding/rnm.h"
#include "ssbump/heights/height_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace rnmbake {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr int most_texels = 1024 * 1024;
constexpr std::size_t finely_cut = 256 * 256;
constexpr double lamp_distance = 50;  // sizes of the map
constexpr float least_quad = 1e-5F;   // texels, half the side of a receiver
constexpr float steps_across = 2;     // of floating point, half the side of a receiver at least
/// Raw little-endian numbers in a file of the launch.
class RawFile {
 public:
  explicit RawFile(fs::path file) : file_(std::move(file)), stream_(file_, std::ios::binary) {}

  template <typename T>
  void write(const std::vector<T>& values) {
    stream_.write(reinterpret_cast<const char*>(values.data()),
                  static_cast<std::streamsize>(values.size() * sizeof(T)));
  }
  void close() {
    stream_.close();
    if (!stream_) fail(ExitCode::io, "cannot write {}: is the disk full?", file_.string());
  }

 private:
  fs::path file_;
  std::ofstream stream_;
};

/// Atlas with one rectangle of the map's size for each direction, two in a row.
struct DirectionAtlas {
  std::vector<Vec3> directions;
  int width = 0, height = 0;  // pixels of each rectangle

  [[nodiscard]] int across() const { return directions.size() > 1 ? 2 : 1; }
  [[nodiscard]] int down() const { return (static_cast<int>(directions.size()) + 1) / 2; }
  [[nodiscard]] int left(std::size_t rectangle) const { return width * (static_cast<int>(rectangle) % 2); }
  [[nodiscard]] int top(std::size_t rectangle) const { return height * (static_cast<int>(rectangle) / 2); }
};

/// Blender's scene has the middle of the map at its origin, where floats are finest.
Vec3 middle_of(const HeightField& field) {
  return {0.5F * static_cast<float>(field.width() - 1), -0.5F * static_cast<float>(field.height() - 1), 0};
}

/// Tiny quads over the texels' centres: Cycles averages over a texel, and the weights are defined at a point.
class PointReceivers {
 public:
  PointReceivers(const HeightField& field, const DirectionAtlas& atlas) : field_(field), atlas_(atlas) {
    const auto extent = static_cast<float>(std::max(field.width(), field.height())) / 2;
    half_ = std::max(least_quad, steps_across * std::numeric_limits<float>::epsilon() * extent);
    for (std::size_t rectangle = 0; rectangle < atlas.directions.size(); ++rectangle) {
      for (int y = 0; y < field.height(); ++y) {
        for (int x = 0; x < field.width(); ++x) add(rectangle, x, y);
      }
    }
  }

  /// All positions, all normals, all UVs, as bake/receivers.py wants them. Returns the corners.
  std::size_t write(const fs::path& file) const {
    RawFile out(file);
    out.write(positions_);
    out.write(normals_);
    out.write(uvs_);
    out.close();
    return positions_.size();
  }

 private:
  /// Height over the surface, texels, that clears the steepest slope to a neighbour.
  [[nodiscard]] float lift(int x, int y) const {
    const float here = field_.heights.texel(x, y)[0];
    float steepest = 0;
    for (int j = -1; j <= 1; ++j) {
      for (int i = -1; i <= 1; ++i) {
        const int nx = (x + i + field_.width()) % field_.width(),
                  ny = (y + j + field_.height()) % field_.height();
        steepest = std::max(steepest, std::abs(field_.heights.texel(nx, ny)[0] - here));
      }
    }
    return half_ * (1 + 2 * steepest);
  }

  void add(std::size_t rectangle, int x, int y) {
    const Vec3 place(static_cast<float>(x), static_cast<float>(-y),
                     field_.heights.texel(x, y)[0] + lift(x, y));
    const Vec3 middle = place - middle_of(field_);
    const auto across = static_cast<float>(atlas_.width * atlas_.across());
    const auto down = static_cast<float>(atlas_.height * atlas_.down());
    for (const auto& [right, up] : {std::pair(0, 0), {1, 0}, {1, 1}, {0, 0}, {1, 1}, {0, 1}}) {
      positions_.push_back(middle + Vec3(right != 0 ? half_ : -half_, up != 0 ? half_ : -half_, 0));
      normals_.push_back(atlas_.directions[rectangle]);
      uvs_.emplace_back(static_cast<float>(atlas_.left(rectangle) + x + right) / across,
                        1 - static_cast<float>(atlas_.top(rectangle) + y + 1 - up) / down);
    }
  }

  const HeightField& field_;
  const DirectionAtlas& atlas_;
  float half_ = 0;
  std::vector<Vec3> positions_, normals_;
  std::vector<Vec2> uvs_;
};

/// Finest cuts that keep the mesh to some millions of triangles.
PatchCuts cuts_of(const HeightField& field) {
  const std::size_t texels = field.heights.texels();
  if (texels <= finely_cut) return PatchCuts::five;
  return texels <= 4 * finely_cut ? PatchCuts::three : PatchCuts::one;
}

json write_surface(const HeightField& field, const fs::path& folder) {
  HeightMesh mesh = height_mesh(field, cuts_of(field));
  for (Vec3& position : mesh.positions) position -= middle_of(field);
  RawFile out(folder / "surface.bin");
  out.write(mesh.positions);
  out.write(mesh.triangles);
  out.close();
  return {{"file", "surface.bin"}, {"vertices", mesh.positions.size()}, {"triangles", mesh.triangles.size()}};
}

json lamps() {
  json list = json::array();
  const auto basis = rnm_basis();
  for (std::size_t i = 0; i < basis.size(); ++i) {
    std::array<int, 3> color{};
    color[i] = 1;
    list.push_back({{"direction", {basis[i].x, basis[i].y, basis[i].z}}, {"color", color}});
  }
  return list;
}

/// RGBA, row 0 on top.
FloatImage read_pixels(const fs::path& file, int width, int height) {
  FloatImage picture(width, height, 4);
  require_regular_file(file);
  std::ifstream in(file, std::ios::binary);
  const std::size_t row = std::size_t(width) * 4;
  for (int y = height - 1; y >= 0; --y)
    in.read(reinterpret_cast<char*>(&picture.data()[std::size_t(y) * row]),
            static_cast<std::streamsize>(row * sizeof(float)));
  if (!in)
    fail(ExitCode::tasks_failed, "Blender's picture {} is too short: is the disk full?", file.string());
  for (std::size_t i = 0; i < picture.data().size(); i += 4) {
    if (picture.data()[i + 3] > 0 && std::isfinite(picture.data()[i])) continue;
    fail(ExitCode::tasks_failed, "Blender left texels of the height map unbaked; try another with --blender");
  }
  return picture;
}

class HeightMapBake {
 public:
  HeightMapBake(BlenderSession& session, const HeightField& field, const SsbumpBlenderOptions& options)
      : session_(session), field_(field), options_(options) {
    atlas_.width = field.width();
    atlas_.height = field.height();
    atlas_.directions.emplace_back(0, 0, 1);
    if (by_sky()) {
      for (const Vec3& axis : rnm_basis()) atlas_.directions.push_back(axis);
    }
  }

  SsbumpWeights run() {
    folder_ = session_.new_folder("height-map");
    Launch launch;
    launch.entry = "height_map_entry.py";
    launch.folder = folder_;
    launch.request = request();
    (void)session_.run(std::move(launch));
    SsbumpWeights weights{FloatImage(field_.width(), field_.height(), SsbumpWeights::channels)};
    take_sky(weights.image);
    if (!by_sky()) take_lamps(weights.image);
    return weights;
  }

 private:
  [[nodiscard]] bool by_sky() const { return options_.lights == SsbumpBlenderOptions::Lights::sky; }
  [[nodiscard]] int across() const { return atlas_.width * atlas_.across(); }
  [[nodiscard]] int down() const { return atlas_.height * atlas_.down(); }

  [[nodiscard]] json request() const {
    json copies = json::array();
    const Vec3 middle = middle_of(field_);
    for (const HeightCopy& copy : height_copies(field_, useful_reach(field_))) {
      copies.push_back({copy.sign_x, copy.sign_y, copy.shift_x + float(copy.sign_x - 1) * middle.x,
                        copy.shift_y + float(copy.sign_y - 1) * middle.y});
    }
    const std::size_t corners = PointReceivers(field_, atlas_).write(folder_ / "receivers.f32");
    const double distance = lamp_distance * std::max(field_.width(), field_.height());
    json bakes = json::array({bake("sky", false), bake("sky", true)});
    if (!by_sky()) {
      bakes.push_back(bake("lamps", false));
      bakes.push_back(bake("lamps", true));
    }
    const CyclesSettings cycles{options_.samples, 2, options_.seed, 0, "CPU"};
    return {{"surface", write_surface(field_, folder_)},
            {"copies", copies},
            {"receivers", {{"file", "receivers.f32"}, {"corners", corners}}},
            {"width", across()},
            {"height", down()},
            {"cycles", to_json(cycles)},
            {"lamps", by_sky() ? json::array() : lamps()},
            {"lamp_distance", distance},
            {"lamp_radius", distance * std::tan(area_light_half_angle * pi / 180)},
            {"bakes", bakes}};
  }

  [[nodiscard]] static json bake(const std::string& light, bool open) {
    return {{"light", light}, {"open", open}, {"pixels", light + (open ? "-open" : "") + ".f32"}};
  }

  /// Ratio of light with the surface to light without it. Both have the same samples, so that unoccluded
  /// texels are exactly 1.
  [[nodiscard]] FloatImage share(const std::string& light) const {
    FloatImage shaded = read_pixels(folder_ / (light + ".f32"), across(), down());
    const FloatImage open = read_pixels(folder_ / (light + "-open.f32"), across(), down());
    for (std::size_t i = 0; i < shaded.data().size(); ++i)
      shaded.data()[i] = open.data()[i] > 0 ? std::min(1.0F, shaded.data()[i] / open.data()[i]) : 1.0F;
    return shaded;
  }

  void take_sky(FloatImage& weights) const {
    const FloatImage picture = share("sky");
    for (int y = 0; y < field_.height(); ++y) {
      for (int x = 0; x < field_.width(); ++x) {
        const auto out = weights.texel(x, y);
        for (std::size_t rectangle = 0; rectangle < atlas_.directions.size(); ++rectangle) {
          const float value = picture.texel(atlas_.left(rectangle) + x, atlas_.top(rectangle) + y)[0];
          if (rectangle > 0) out[rectangle - 1] = value;
          if (rectangle == 0) out[SsbumpWeights::up] = out[SsbumpWeights::ambient] = value;
        }
      }
    }
  }

  void take_lamps(FloatImage& weights) const {
    const FloatImage picture = share("lamps");
    for (int y = 0; y < field_.height(); ++y) {
      for (int x = 0; x < field_.width(); ++x)
        std::copy_n(picture.texel(x, y).begin(), 3, weights.texel(x, y).begin());
    }
  }

  BlenderSession& session_;
  const HeightField& field_;
  const SsbumpBlenderOptions& options_;
  DirectionAtlas atlas_;
  fs::path folder_;
};

}  // namespace

SsbumpWeights bake_height_map(BlenderSession& session, const HeightField& field,
                              const SsbumpBlenderOptions& options) {
  if (field.heights.texels() > most_texels) {
    fail(ExitCode::unsupported,
         "{} x {} texels are too many for --method blender (at most 1024 x 1024); use --method trace",
         field.width(), field.height());
  }
  log::info("baking a height map of {} x {} texels with Blender {}", field.width(), field.height(),
            session.blender().info().version_text);
  return HeightMapBake(session, field, options).run();
}

}  // namespace rnmbake
