// Godot's LightmapGIData as a text resource: probes as points of tetrahedra, which a tree of planes finds.
// Godot bakes one by a Delaunay triangulation; a box needs none: each cell is cut into the six tetrahedra of
// equal order of its coordinates (Kuhn 1960, "Some combinatorial lemmas in topology"), and the planes between
// cells, then those between orders, are a tree in which no tetrahedron is cut.
#include "base/error.h"
#include "probes/formats/engine_box.h"
#include "probes/formats/makers.h"

#include <bit>

namespace rnmbake {
namespace {

/// A box with at least two layers along each axis; one alone becomes two, half a step to either side.
struct Lattice {
  std::array<int, 3> counts{};
  Vec3d first;
  std::array<Vec3d, 3> steps;
  std::array<Vec3d, 3> reciprocals;  // coordinate k of a place: reciprocals[k] . (place - first)

  explicit Lattice(const EngineBox& box) : counts(box.counts), first(box.first), steps(box.steps) {
    const double space = steps[0].dot(steps[1].cross(steps[2]));
    for (std::size_t k = 0; k < 3; ++k) {
      reciprocals[k] = steps[(k + 1) % 3].cross(steps[(k + 2) % 3]) / space;
      if (counts[k] > 1) continue;
      counts[k] = 2;
      first -= steps[k] / 2.0;
    }
  }
  [[nodiscard]] Vec3d place(const std::array<int, 3>& at) const {
    return first + steps[0] * at[0] + steps[1] * at[1] + steps[2] * at[2];
  }
  [[nodiscard]] int point(const std::array<int, 3>& at) const {
    return at[0] + counts[0] * (at[1] + counts[1] * at[2]);
  }
};

class Tetrahedra {
 public:
  explicit Tetrahedra(const Lattice& lattice) : lattice_(lattice) {
    split({0, 0, 0}, {lattice.counts[0] - 1, lattice.counts[1] - 1, lattice.counts[2] - 1});
  }

  std::vector<int> points;          // four of each tetrahedron
  std::vector<std::int32_t> nodes;  // plane as four floats' bits, over, under: a node, or -1 - a tetrahedron

 private:
  int node(const Vec3d& normal, const Vec3d& through) {
    const Vec3d unit_normal = normal.normalized();
    for (int c = 0; c < 3; ++c) nodes.push_back(std::bit_cast<std::int32_t>(float(unit_normal[c])));
    nodes.push_back(std::bit_cast<std::int32_t>(float(unit_normal.dot(through))));
    nodes.insert(nodes.end(), {0, 0});
    return static_cast<int>(nodes.size() / 6) - 1;
  }

  void children(int node_index, int over, int under) {
    nodes[static_cast<std::size_t>(node_index) * 6 + 4] = over;
    nodes[static_cast<std::size_t>(node_index) * 6 + 5] = under;
  }

  /// Cells from `low` to before `high`. Parents come before their children, as Godot asks for.
  int split(const std::array<int, 3>& low, const std::array<int, 3>& high) {
    std::size_t axis = 0;
    for (std::size_t k = 1; k < 3; ++k)
      if (high[k] - low[k] > high[axis] - low[axis]) axis = k;
    if (high[axis] - low[axis] == 1) return cell(low);
    std::array<int, 3> middle = low, end = high;
    middle[axis] = end[axis] = (low[axis] + high[axis]) / 2;
    const int found = node(lattice_.reciprocals[axis], lattice_.place(middle));
    const int over = split(middle, high);
    children(found, over, split(low, end));
    return found;
  }

  int cell(const std::array<int, 3>& low) {
    const Vec3d corner = lattice_.place(low);
    const auto greater = [&](std::size_t a, std::size_t b) {
      return node(lattice_.reciprocals[a] - lattice_.reciprocals[b], corner);
    };
    const auto leaf = [&](std::size_t a, std::size_t b) {
      std::array<int, 3> at = low, last{low[0] + 1, low[1] + 1, low[2] + 1};
      points.push_back(lattice_.point(at));
      for (const std::size_t axis : {a, b}) {
        ++at[axis];
        points.push_back(lattice_.point(at));
      }
      points.push_back(lattice_.point(last));
      return -static_cast<int>(points.size() / 4);
    };
    // Coordinates within the cell by size: the greatest and the next name the tetrahedron.
    const auto half = [&](std::size_t a, std::size_t b, std::size_t c) {  // a > b
      const int b_before_c = greater(b, c);
      const int above = leaf(a, b), a_before_c = greater(a, c);
      const int between = leaf(a, c);
      children(a_before_c, between, leaf(c, a));
      children(b_before_c, above, a_before_c);
      return b_before_c;
    };
    const int found = greater(0, 1);
    const int over = half(0, 1, 2);
    children(found, over, half(1, 0, 2));
    return found;
  }

  const Lattice& lattice_;
};

template <typename Numbers>
std::string list_of(std::string_view type, const Numbers& numbers) {
  return fmt::format("{}({})", type, fmt::join(numbers, ", "));
}

std::string resource(const ProbeVolume& volume, const EngineBox& box) {
  const Lattice lattice(box);
  const Tetrahedra tetrahedra(lattice);
  std::vector<float> points, light;
  for (int z = 0; z < lattice.counts[2]; ++z) {
    for (int y = 0; y < lattice.counts[1]; ++y) {
      for (int x = 0; x < lattice.counts[0]; ++x) {
        const Vec3d place = lattice.place({x, y, z});
        for (int c = 0; c < 3; ++c) points.push_back(static_cast<float>(place[c]));
        const std::size_t index = box.index(std::min(x, box.counts[0] - 1), std::min(y, box.counts[1] - 1),
                                            std::min(z, box.counts[2] - 1));
        for (const Vec3& coefficient : turned(y_up_axes(), volume.probes[index].harmonics)) {
          for (int c = 0; c < 3; ++c) light.push_back(coefficient[c] / static_cast<float>(pi));
          light.push_back(1);
        }
      }
    }
  }
  Vec3d least = lattice.first, greatest = lattice.first;
  for (int corner = 0; corner < 8; ++corner) {
    std::array<int, 3> at{};
    for (std::size_t k = 0; k < 3; ++k)
      if ((corner >> k & 1) != 0) at[k] = lattice.counts[k] - 1;
    const Vec3d place = lattice.place(at);
    for (int c = 0; c < 3; ++c) {
      least[c] = std::min(least[c], place[c]);
      greatest[c] = std::max(greatest[c], place[c]);
    }
  }
  const Vec3d size = greatest - least;
  const std::array<float, 6> bounds{float(least.x), float(least.y), float(least.z),
                                    float(size.x),  float(size.y),  float(size.z)};
  return "[gd_resource type=\"LightmapGIData\" format=3]\n\n[resource]\nprobe_data = {\n"
         "\"baked_exposure\": 1.0,\n\"bounds\": " +
         list_of("AABB", bounds) + ",\n\"bsp\": " + list_of("PackedInt32Array", tetrahedra.nodes) +
         ",\n\"interior\": true,\n\"points\": " + list_of("PackedVector3Array", points) +
         ",\n\"sh\": " + list_of("PackedColorArray", light) +
         ",\n\"tetrahedra\": " + list_of("PackedInt32Array", tetrahedra.points) + "\n}\n";
}

}  // namespace

std::vector<FormatFile> godot_files(std::span<const ProbeVolume> volumes) {
  const std::vector<std::string> stems = volume_stems(volumes);
  std::vector<FormatFile> files;
  for (std::size_t i = 0; i < volumes.size(); ++i)
    files.push_back({stems[i] + ".tres", resource(volumes[i], engine_box(volumes[i], y_up_axes(), "godot"))});
  return files;
}

}  // namespace rnmbake
