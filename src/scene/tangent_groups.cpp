#include "scene/tangent_groups.h"

#include <algorithm>
#include <array>
#include <tuple>

namespace rnmbake {
namespace {

using Corner = std::uint32_t;
constexpr std::uint32_t no_neighbour = ~std::uint32_t{0};

Corner next_in_triangle(Corner corner) {
  return corner % 3 == 2 ? corner - 2 : corner + 1;
}
Corner previous_in_triangle(Corner corner) {
  return corner % 3 == 0 ? corner + 2 : corner - 1;
}

/// The edge from a corner to the next one of its triangle.
struct Edge {
  std::uint32_t low, high;  // vertices
  Corner corner;
  bool upward;  // runs from low to high
};

std::vector<Edge> sorted_edges(const std::vector<std::uint32_t>& vertex,
                               const std::vector<TriangleUv>& triangles) {
  std::vector<Edge> edges;
  edges.reserve(vertex.size());
  for (Corner corner = 0; corner < vertex.size(); ++corner) {
    const std::uint32_t a = vertex[corner], b = vertex[next_in_triangle(corner)];
    if (!triangles[corner / 3].flat) {
      edges.push_back(Edge{std::min(a, b), std::max(a, b), corner, a < b});
    }
  }
  std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) {
    return std::tie(a.low, a.high, a.corner) < std::tie(b.low, b.high, b.corner);
  });
  return edges;
}

/// For the edge that starts at each corner, the corner where the neighbour's edge starts.
/// Where more than two triangles meet, each takes the first free one of opposite direction.
std::vector<Corner> neighbours(const std::vector<std::uint32_t>& vertex,
                               const std::vector<TriangleUv>& triangles) {
  const std::vector<Edge> edges = sorted_edges(vertex, triangles);
  std::vector<Corner> across(vertex.size(), no_neighbour);
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const Edge& edge = edges[i];
    for (std::size_t j = i + 1; j < edges.size() && across[edge.corner] == no_neighbour; ++j) {
      const Edge& other = edges[j];
      if (other.low != edge.low || other.high != edge.high) {
        break;
      }
      if (other.upward != edge.upward && across[other.corner] == no_neighbour) {
        across[edge.corner] = other.corner;
        across[other.corner] = edge.corner;
      }
    }
  }
  return across;
}

class Grouping {
 public:
  Grouping(const std::vector<std::uint32_t>& vertex, std::vector<TriangleUv>& triangles)
      : triangles_(triangles), across_(neighbours(vertex, triangles)), group_(vertex.size(), no_group) {}

  std::vector<std::uint32_t> run() {
    std::uint32_t groups = 0;
    for (Corner corner = 0; corner < group_.size(); ++corner) {
      const TriangleUv& triangle = triangles_[corner / 3];
      if (!triangle.flat && !triangle.any && group_[corner] == no_group) {
        grow(corner, groups++, triangle.preserving);
      }
    }
    return group_;
  }

 private:
  /// Walks the fan of triangles around the corner's vertex, both ways.
  void grow(Corner start, std::uint32_t group, bool preserving) {
    std::vector<Corner> work{start};
    while (!work.empty()) {
      const Corner corner = work.back();
      work.pop_back();
      if (!accept(corner, preserving)) {
        continue;
      }
      group_[corner] = group;
      const Corner before = previous_in_triangle(corner);
      if (across_[before] != no_neighbour) {  // the neighbour's edge starts at our vertex
        work.push_back(across_[before]);
      }
      if (across_[corner] != no_neighbour) {  // the neighbour's edge ends at our vertex
        work.push_back(next_in_triangle(across_[corner]));
      }
    }
  }

  bool accept(Corner corner, bool preserving) {
    TriangleUv& triangle = triangles_[corner / 3];
    if (group_[corner] != no_group) {
      return false;
    }
    const Corner first = corner - corner % 3;
    const bool untouched = std::all_of(group_.begin() + first, group_.begin() + first + 3,
                                       [](std::uint32_t group) { return group == no_group; });
    if (triangle.any && untouched) {
      triangle.preserving = preserving;
    }
    return triangle.preserving == preserving;
  }

  std::vector<TriangleUv>& triangles_;
  std::vector<Corner> across_;
  std::vector<std::uint32_t> group_;
};

}  // namespace

std::vector<std::uint32_t> tangent_groups(const std::vector<std::uint32_t>& corner_vertex,
                                          std::vector<TriangleUv>& triangles) {
  return Grouping(corner_vertex, triangles).run();
}

}  // namespace rnmbake
