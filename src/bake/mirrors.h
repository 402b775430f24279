// bake/mirrors.h - mirrors: receivers that show the radiance that arrives along one ray each.
//
// A bake looks at a receiver along its corner normal, so a perfect mirror whose corner normals are a
// direction shows the radiance that arrives from there, and nothing is sampled at it. Each is a triangle of
// its own texel, small enough to count as a point, and off its surface as receivers are.
#pragma once

#include "bake/plan.h"
#include "bake/receiver.h"

#include <array>
#include <cstddef>
#include <vector>

namespace rnmbake {

/// Where a mirror stands for a ray that starts at `place` (world space, off a face by less than a receiver):
/// as high over the face as a receiver, so that no corner of it is below.
[[nodiscard]] Vec3 mirror_position(const Vec3d& place, const Vec3& face);

/// The triangle of a mirror; UVs in texels of a picture of `map` texels, over its size.
[[nodiscard]] std::array<ReceiverCorner, 3> mirror_triangle(const Mirror& mirror, std::size_t texel,
                                                            const RectSize& map);

/// Adds mirrors of a target of the plan as tasks. `half`: of the target's samples. `meets_light`: some of
/// them may show a lamp, the sky or what glows at once, which costs another bake.
void add_mirror_tasks(Plan& plan, std::size_t target, std::size_t half, bool meets_light,
                      const std::vector<Mirror>& mirrors, const CyclesSettings& cycles);

/// Groups the tasks of mirrors, which belong to no batch yet, into batches.
void group_mirrors(Plan& plan);

}  // namespace rnmbake
