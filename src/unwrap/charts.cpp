#include "unwrap/charts.h"

#include "scene/flat_triangle.h"
#include "scene/weld.h"
#include "unwrap/chart_samples.h"
#include "unwrap/upright.h"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>
#include <tuple>

namespace rnmbake {
namespace {

constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
constexpr double packing_guess = 0.6;  // share of the square that charts fill
constexpr double samples_per_texel = 2;

struct Face {
  Vec3d normal{0, 0, 0};  // unit, or 0
  double area = 0;        // of its triangles that have any
  double longest2 = 0;
};

/// Polygons by their triangles. One that is folded so far that its triangles cancel out takes the largest's
/// normal.
std::vector<Face> find_faces(const Mesh& mesh, const Mat44& to_world) {
  std::vector<Face> faces(mesh.polygon_start.size());
  std::vector<TriangleShape> largest(faces.size());
  for (std::size_t triangle = 0; triangle < mesh.triangles(); ++triangle) {
    const TriangleShape shape = triangle_shape(mesh, triangle, to_world);
    if (shape.flat()) continue;
    const std::uint32_t polygon = mesh.triangle_polygon[triangle];
    Face& face = faces[polygon];
    face.normal += shape.normal;
    face.area += shape.area;
    face.longest2 = std::max(face.longest2, shape.longest2);
    if (shape.area > largest[polygon].area) largest[polygon] = shape;
  }
  for (std::size_t i = 0; i < faces.size(); ++i) {
    if (faces[i].normal.length() < 0.2 * faces[i].area) faces[i].normal = largest[i].normal;
    faces[i].normal.normalize();
  }
  return faces;
}

/// An edge of a polygon between two places.
struct Edge {
  std::uint32_t low, high;
  std::uint32_t loop, polygon;
  bool forward;  // from low to high
};

std::vector<Edge> sorted_edges(const Mesh& mesh) {
  const std::vector<std::uint32_t> place = weld<3>(mesh.positions.size(), [&](std::size_t i) {
    const Vec3& p = mesh.positions[i];
    return std::array{weld_bits(p.x), weld_bits(p.y), weld_bits(p.z)};
  });
  std::vector<Edge> edges;
  edges.reserve(mesh.loop_vertex.size());
  for (std::uint32_t polygon = 0; polygon < mesh.polygon_start.size(); ++polygon) {
    const std::uint32_t start = mesh.polygon_start[polygon], size = mesh.polygon_size[polygon];
    for (std::uint32_t i = 0; i < size; ++i) {
      const std::uint32_t a = place[mesh.loop_vertex[start + i]];
      const std::uint32_t b = place[mesh.loop_vertex[start + (i + 1) % size]];
      if (a != b) edges.push_back({std::min(a, b), std::max(a, b), start + i, polygon, a < b});
    }
  }
  std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) {
    return std::tie(a.low, a.high, a.loop) < std::tie(b.low, b.high, b.loop);
  });
  return edges;
}

/// [loops] -> the polygon on the other side of the edge that begins there. Edges of one or of three and more
/// polygons have none, nor those between polygons that face opposite ways.
std::vector<std::uint32_t> find_neighbours(const Mesh& mesh) {
  const std::vector<Edge> edges = sorted_edges(mesh);
  std::vector<std::uint32_t> neighbours(mesh.loop_vertex.size(), none);
  for (std::size_t first = 0, last = 0; first < edges.size(); first = last) {
    const auto same = [&](const Edge& e) { return e.low == edges[first].low && e.high == edges[first].high; };
    for (last = first; last < edges.size() && same(edges[last]);) ++last;
    const Edge &a = edges[first], &b = edges[last - 1];
    if (last - first != 2 || a.forward == b.forward || a.polygon == b.polygon) continue;
    neighbours[a.loop] = b.polygon;
    neighbours[b.loop] = a.polygon;
  }
  return neighbours;
}

/// [vertices] in world scale; where the object stands does not matter to its charts.
std::vector<Vec3d> scaled_positions(const Mesh& mesh, const Mat44& to_world) {
  std::vector<Vec3d> positions;
  positions.reserve(mesh.positions.size());
  for (const Vec3& position : mesh.positions) {
    Vec3d scaled;
    to_world.multDirMatrix(Vec3d(position) - Vec3d(mesh.positions.front()), scaled);
    positions.push_back(scaled);
  }
  return positions;
}

class ChartMaker {
 public:
  ChartMaker(const Mesh& mesh, const Mat44& to_world, int side)
      : mesh_(mesh),
        faces_(find_faces(mesh, to_world)),
        neighbours_(find_neighbours(mesh)),
        positions_(scaled_positions(mesh, to_world)),
        first_triangle_(faces_.size() + 1),
        taken_(faces_.size()) {
    for (const std::uint32_t polygon : mesh.triangle_polygon) ++first_triangle_[polygon + 1];
    std::partial_sum(first_triangle_.begin(), first_triangle_.end(), first_triangle_.begin());
    triangles_.resize(mesh.triangles());
    std::vector<std::uint32_t> next(first_triangle_.begin(), first_triangle_.end() - 1);
    for (std::uint32_t t = 0; t < mesh.triangles(); ++t) triangles_[next[mesh.triangle_polygon[t]]++] = t;
    double longest2 = 0;
    for (const Face& face : faces_) {
      result_.world_area += face.area;
      longest2 = std::max(longest2, face.longest2);
    }
    if (longest2 == 0) return;
    // No map shows an edge longer than itself, however small the area is.
    density_ = samples_per_texel * side *
               std::min(std::sqrt(packing_guess / result_.world_area), 1 / std::sqrt(longest2));
  }

  Charts make() {
    result_.at.assign(mesh_.loop_vertex.size(), Vec2d(0, 0));
    std::vector<std::uint32_t> seeds(faces_.size());
    std::iota(seeds.begin(), seeds.end(), 0U);
    std::erase_if(seeds, [&](std::uint32_t polygon) { return faces_[polygon].area <= 0; });
    std::stable_sort(seeds.begin(), seeds.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return faces_[a].area > faces_[b].area; });
    for (const std::uint32_t seed : seeds) {
      if (!taken_[seed]) grow(seed);
    }
    return std::move(result_);
  }

 private:
  void grow(std::uint32_t seed) {
    const Vec3d normal = faces_[seed].normal;
    right_ = (std::abs(normal.z) < 0.9 ? Vec3d(0, 0, 1) : Vec3d(1, 0, 0)).cross(normal).normalized();
    up_ = normal.cross(right_);
    samples_.clear();
    Chart chart;
    consider(seed, chart);
    for (std::size_t i = 0; i < chart.polygons.size(); ++i) {
      const std::uint32_t polygon = chart.polygons[i];
      for (std::uint32_t k = 0; k < mesh_.polygon_size[polygon]; ++k) {
        const std::uint32_t next = neighbours_[mesh_.polygon_start[polygon] + k];
        if (next == none || taken_[next] || faces_[next].area <= 0) continue;
        if (faces_[next].normal.dot(normal) >= std::cos(widest_angle)) consider(next, chart);
      }
    }
    chart.size = stand_upright(chart.polygons);
    result_.charts.push_back(std::move(chart));
  }

  /// Takes the polygon in, unless it would lie on top of those that are there.
  void consider(std::uint32_t polygon, Chart& chart) {
    const std::uint32_t start = mesh_.polygon_start[polygon];
    for (std::uint32_t k = 0; k < mesh_.polygon_size[polygon]; ++k) {
      const Vec3d& p = positions_[mesh_.loop_vertex[start + k]];
      result_.at[start + k] = {p.dot(right_), p.dot(up_)};
    }
    corners_.clear();
    for (std::uint32_t i = first_triangle_[polygon]; i < first_triangle_[polygon + 1]; ++i) {
      for (std::size_t k = 0; k < 3; ++k)
        corners_.push_back(result_.at[mesh_.triangle_loops[3 * std::size_t(triangles_[i]) + k]] * density_);
    }
    if (!chart.polygons.empty() && samples_.any(corners_)) return;
    samples_.add(corners_);
    taken_[polygon] = true;
    chart.polygons.push_back(polygon);
  }

  Vec2d stand_upright(const std::vector<std::uint32_t>& polygons) {
    std::vector<std::uint32_t> loops;
    for (const std::uint32_t polygon : polygons) {
      for (std::uint32_t k = 0; k < mesh_.polygon_size[polygon]; ++k)
        loops.push_back(mesh_.polygon_start[polygon] + k);
    }
    std::vector<Vec2d> points;
    points.reserve(loops.size());
    for (const std::uint32_t loop : loops) points.push_back(result_.at[loop]);
    const Vec2d size = upright(points);
    for (std::size_t i = 0; i < loops.size(); ++i) result_.at[loops[i]] = points[i];
    return size;
  }

  const Mesh& mesh_;
  std::vector<Face> faces_;
  std::vector<std::uint32_t> neighbours_;
  std::vector<Vec3d> positions_;
  std::vector<std::uint32_t> first_triangle_;  // [polygons + 1] -> triangles_
  std::vector<std::uint32_t> triangles_;
  std::vector<bool> taken_;
  double density_ = 0;  // samples along a world unit
  Vec3d right_, up_;    // of the chart in work
  ChartSamples samples_;
  std::vector<Vec2d> corners_;
  Charts result_;
};

}  // namespace

Charts make_charts(const Mesh& mesh, const Mat44& to_world, int side) {
  return ChartMaker(mesh, to_world, side).make();
}

}  // namespace rnmbake
