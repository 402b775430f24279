// tests/bake/fixture.h - small surfaces, targets and plans whose properties are known.
#pragma once

#include "bake/plan.h"
#include "bake/receiver.h"
#include "bake/targets.h"
#include "base/error.h"
#include "scene/surface.h"
#include "scene/survey.h"

#include <array>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace rnmbake {

/// A frame with this normal; the tangent is as near to +x as it can be.
inline Frame frame_of(const Vec3& direction) {
  const Vec3 normal = direction.normalized();
  const Vec3 tangent = (Vec3(1, 0, 0) - normal * normal.x).normalized();
  return {tangent, normal.cross(tangent), normal, 1};
}

/// A triangle in the plane z = 0 that faces up, with the given shading normals and UVs = x, y.
inline SurfaceTriangle floor_triangle(const std::array<Vec2, 3>& place, const std::array<Vec3, 3>& normals) {
  SurfaceTriangle triangle;
  triangle.normal = Vec3(0, 0, 1);
  for (std::size_t k = 0; k < 3; ++k)
    triangle.corners[k] = {Vec3(place[k].x, place[k].y, 0), frame_of(normals[k]), place[k]};
  return triangle;
}

inline double uv_area(const ReceiverCorner* corners) {
  const Vec2 a = corners[1].uv - corners[0].uv, b = corners[2].uv - corners[0].uv;
  return 0.5 * std::abs(double(a.x) * b.y - double(a.y) * b.x);
}

inline double uv_area(const ReceiverPass& pass) {
  double sum = 0;
  for (std::size_t i = 0; i < pass.corners.size(); i += 3) sum += uv_area(&pass.corners[i]);
  return sum;
}

inline Target make_target(const std::string& key, int width, int height, std::size_t object = 0) {
  Target target;
  target.object = object;
  target.key = key;
  target.uv = std::make_shared<const std::vector<Vec2>>();
  target.tangent_uv = target.uv;
  target.uv_layer = target.tangent_layer = "Lightmap";
  target.width = width;
  target.height = height;
  return target;
}

inline PlanTarget planned(const Target& target) {
  return {target.key, {target.width, target.height}, ""};
}

/// A sheet of one triangle over the lower left half of the square [low, high]^2.
inline ReceiverPass sheet_over(float low, float high, ReceiverPass::Role role = ReceiverPass::Role::basis,
                               std::size_t basis = 0) {
  const Vec3 up(0, 0, 1);
  return {role,
          basis,
          {{Vec3(low, low, 0), up, Vec2(low, low)},
           {Vec3(high, low, 0), up, Vec2(high, low)},
           {Vec3(low, high, 0), up, Vec2(low, high)}}};
}

/// ReceiverPasses of a target that needs no identity: one triangle for each basis.
inline ReceiverPasses plain_sheets(std::size_t bases, float low = 0, float high = 1) {
  ReceiverPasses passes;
  for (std::size_t b = 0; b < bases; ++b)
    passes.passes.push_back(sheet_over(low, high, ReceiverPass::Role::basis, b));
  return passes;
}

/// What the action's Error says; fails the test where it throws none or one with another code.
template <typename Action>
std::string error_of(ExitCode code, Action action) {
  try {
    action();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), code) << error.what();
    return error.what();
  }
  ADD_FAILURE() << "no error";
  return {};
}

}  // namespace rnmbake
