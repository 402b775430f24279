#include "probes/formats/engine_box.h"

#include "base/error.h"
#include "encoding/ambient_cube.h"
#include "encoding/sh.h"

#include <algorithm>
#include <cmath>

namespace rnmbake {
namespace {

/// Share of a step's length by which it may miss an axis or a right angle: what is left of rotations that
/// were stored as floats.
constexpr double skew = 1e-5;

double determinant(const std::array<Vec3d, 3>& steps) {
  return steps[0].dot(steps[1].cross(steps[2]));
}

/// Which step goes along which of the engine's axes: the order with the greatest sum of shares, so that a
/// turned box keeps a small turn.
std::array<std::size_t, 3> best_order(const std::array<Vec3d, 3>& steps) {
  std::array<std::size_t, 3> order{0, 1, 2}, best = order;
  double greatest = -1;
  do {
    double sum = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const Vec3d& step = steps[order[static_cast<std::size_t>(axis)]];
      sum += std::abs(step[axis]) / step.length();
    }
    if (sum > greatest + 1e-9) {
      greatest = sum;
      best = order;
    }
  } while (std::next_permutation(order.begin(), order.end()));
  return best;
}

}  // namespace

const EngineAxes& y_up_axes() {
  static const EngineAxes axes{Vec3(1, 0, 0), Vec3(0, 0, 1), Vec3(0, -1, 0)};
  return axes;
}

const EngineAxes& unity_axes() {
  static const EngineAxes axes{Vec3(-1, 0, 0), Vec3(0, 0, 1), Vec3(0, -1, 0)};
  return axes;
}

Vec3d to_engine(const EngineAxes& axes, const Vec3d& blender) {
  return {Vec3d(axes[0]).dot(blender), Vec3d(axes[1]).dot(blender), Vec3d(axes[2]).dot(blender)};
}

Vec3 to_engine(const EngineAxes& axes, const Vec3& blender) {
  return {axes[0].dot(blender), axes[1].dot(blender), axes[2].dot(blender)};
}

Vec3 from_engine(const EngineAxes& axes, const Vec3& engine) {
  return axes[0] * engine.x + axes[1] * engine.y + axes[2] * engine.z;
}

std::array<Vec3, 9> turned(const EngineAxes& axes, const std::array<Vec3, 9>& harmonics) {
  // Products of two harmonics have degree 4, which the rule of 14 points integrates exactly.
  std::array<Vec3, 9> found;
  found.fill(Vec3(0));
  for (std::size_t i = 0; i < probe_direction_count; ++i) {
    const Vec3 direction = probe_directions()[i];
    const auto ours = sh_basis(direction), theirs = sh_basis(to_engine(axes, direction));
    Vec3 radiance(0);
    for (std::size_t k = 0; k < 9; ++k) radiance += harmonics[k] * ours[k];
    radiance *= static_cast<float>(4 * pi) * probe_direction_weights()[i];
    for (std::size_t k = 0; k < 9; ++k) found[k] += radiance * theirs[k];
  }
  return found;
}

std::array<Vec3, 6> turned_cube(const EngineAxes& axes, const LightProbe& probe) {
  // Sides of the cube are along axes in either space.
  std::array<Vec3, 6> cube;
  for (std::size_t side = 0; side < cube.size(); ++side) {
    const Vec3 normal = from_engine(axes, ambient_cube_axes()[side]);
    for (std::size_t ours = 0; ours < cube.size(); ++ours)
      if (normal.dot(probe_directions()[ours]) > 0.5F) cube[side] = probe.irradiance[ours];
  }
  return cube;
}

Vec3d EngineBox::centre() const {
  Vec3d found = first;
  for (std::size_t k = 0; k < 3; ++k) found += steps[k] * ((counts[k] - 1) / 2.0);
  return found;
}

Vec3d EngineBox::size() const {
  return {steps[0].length() * counts[0], steps[1].length() * counts[1], steps[2].length() * counts[2]};
}

std::array<double, 4> EngineBox::rotation() const {
  const Vec3d x = steps[0].normalized(), y = steps[1].normalized(), z = steps[2].normalized();
  // The largest of the four squares is divided by, none of which is below 1/4 at once. Shepperd 1978,
  // "Quaternion from rotation matrix".
  const std::array<double, 4> squares{1 + x.x - y.y - z.z, 1 - x.x + y.y - z.z, 1 - x.x - y.y + z.z,
                                      1 + x.x + y.y + z.z};
  const auto largest = std::ranges::max_element(squares) - squares.begin();
  std::array<double, 4> q{};
  switch (largest) {
    case 0:
      q = {squares[0], x.y + y.x, z.x + x.z, y.z - z.y};
      break;
    case 1:
      q = {x.y + y.x, squares[1], y.z + z.y, z.x - x.z};
      break;
    case 2:
      q = {z.x + x.z, y.z + z.y, squares[2], x.y - y.x};
      break;
    default:
      q = {y.z - z.y, z.x - x.z, x.y - y.x, squares[3]};
      break;
  }
  const double length = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  for (double& part : q) part = part / length + 0.0;  // no -0
  return q;
}

bool EngineBox::right_angled() const {
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3d &a = steps[k], &b = steps[(k + 1) % 3];
    if (std::abs(a.dot(b)) > skew * a.length() * b.length()) return false;
  }
  return true;
}

bool EngineBox::along_axes() const {
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3d& step = steps[static_cast<std::size_t>(axis)];
    Vec3d axial(0);
    axial[axis] = step.length();
    if ((step - axial).length() > skew * step.length()) return false;
  }
  return true;
}

EngineBox engine_box(const ProbeVolume& volume, const EngineAxes& axes, std::string_view format) {
  if (!volume.grid)
    fail(ExitCode::unsupported,
         "'{}' is points alone, and {} holds boxes of probes: write it as gltf or unity, or place a box",
         volume.name, format);
  const ProbeGrid& grid = *volume.grid;
  std::array<Vec3d, 3> steps;
  for (std::size_t k = 0; k < 3; ++k) steps[k] = to_engine(axes, grid.steps[k]);
  const std::array<std::size_t, 3> order = best_order(steps);

  EngineBox box{};
  std::array<bool, 3> backwards{};
  for (std::size_t k = 0; k < 3; ++k) {
    box.counts[k] = grid.counts[order[k]];
    box.steps[k] = steps[order[k]];
    backwards[k] = box.steps[k][static_cast<int>(k)] < 0;
    if (backwards[k]) box.steps[k] = -box.steps[k];
  }
  if (determinant(box.steps) < 0) {  // of a box turned so far that no order is close
    backwards[2] = !backwards[2];
    box.steps[2] = -box.steps[2];
  }
  const std::array<std::size_t, 3> strides{grid.index(1, 0, 0), grid.index(0, 1, 0), grid.index(0, 0, 1)};
  box.first = to_engine(axes, grid.first);
  for (std::size_t k = 0; k < 3; ++k) {
    box.strides[k] = strides[order[k]];
    if (!backwards[k]) continue;
    const auto last = static_cast<std::size_t>(box.counts[k] - 1);
    box.origin += box.strides[k] * last;
    box.first -= box.steps[k] * static_cast<double>(last);
    box.strides[k] = std::size_t{0} - box.strides[k];
  }
  return box;
}

EngineBox right_angled_box(const ProbeVolume& volume, const EngineAxes& axes, std::string_view format) {
  EngineBox box = engine_box(volume, axes, format);
  if (!box.right_angled())
    fail(ExitCode::unsupported,
         "the axes of '{}' are not at right angles, which {} cannot say: apply the shear to its object",
         volume.name, format);
  return box;
}

}  // namespace rnmbake
