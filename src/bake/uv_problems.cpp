#include "bake/uv_problems.h"

#include "base/text.h"

#include <cmath>

#include <spdlog/fmt/fmt.h>

namespace rnmbake {
namespace {

/// Fewer are slips of modelling that cost next to nothing.
constexpr std::size_t fewest_doubled = 50;  // one of these

}  // namespace

std::vector<UvProblem> uv_problems(const UvReport& report, int side, int wanted_side) {
  using Kind = UvProblem::Kind;
  std::vector<UvProblem> problems;
  const auto add = [&](Kind kind, std::size_t count) {
    if (count > 0) problems.push_back({kind, count});
  };
  const bool in_tiles = report.tile_triangles > 0;
  add(Kind::overlap, report.overlap_texels);
  add(Kind::tiles, report.tile_triangles);
  add(Kind::outside, in_tiles ? 0 : static_cast<std::size_t>(std::lround(report.outside_texels)));
  add(Kind::no_uv_area, report.degenerate_uv);
  add(Kind::no_area, report.degenerate_world);
  add(Kind::doubled, report.doubled * fewest_doubled > report.triangles ? report.doubled : 0);
  add(Kind::capped, wanted_side > side ? static_cast<std::size_t>(wanted_side) : 0);
  add(Kind::mirrored, report.mirrored_charts);
  return problems;
}

std::string spoken(const UvProblem& problem) {
  using Kind = UvProblem::Kind;
  switch (problem.kind) {
    case Kind::overlap:
      return counted(problem.count, "texel") + (problem.count == 1 ? " overlaps" : " overlap");
    case Kind::tiles:
      return counted(problem.count, "triangle") + " in another UDIM tile";
    case Kind::outside:
      return counted(problem.count, "texel") + " outside [0,1]";
    case Kind::no_uv_area:
      return counted(problem.count, "triangle") + " without UV area";
    case Kind::no_area:
      return counted(problem.count, "triangle") + " without area";
    case Kind::doubled:
      return counted(problem.count, "triangle") +
             (problem.count == 1 ? " lies on another" : " lie on others");
    case Kind::capped:
      return fmt::format("texels_per_unit wants {0} x {0}", problem.count);
    case Kind::mirrored:
      break;
  }
  return counted(problem.count, "mirrored chart");
}

const char* remedy(UvProblem::Kind kind) {
  using Kind = UvProblem::Kind;
  switch (kind) {
    case Kind::overlap:
      return "several faces share texels and the last one wins: give each a place of its own, or pass "
             "--unwrap always";
    case Kind::tiles:
      return "only the square [0,1] is baked, these faces get no light: move them into it, split the object, "
             "or pass --unwrap always";
    case Kind::outside:
      return "what lies outside is lost: scale the UVs into the square, or pass --unwrap always";
    case Kind::no_uv_area:
      return "these faces get no texel: unwrap them, or pass --unwrap always";
    case Kind::doubled:
      return "engines flicker between the two, and both take texels: keep one of them (Merge by Distance in "
             "Blender)";
    case Kind::capped:
      return "the lightmap is coarser than asked for: raise --max-resolution, or split the object";
    case Kind::no_area:
    case Kind::mirrored:
      break;
  }
  return "";
}

}  // namespace rnmbake
