#include "ssbump/mesh/triangle_tree.h"

#include "rays/embree_scene.h"

#include <algorithm>
#include <numeric>

namespace rnmbake {

TriangleTree::TriangleTree(const std::vector<Vec3>& corners) : embree_(std::make_unique<EmbreeScene>()) {
  rtcSetSceneFlags(embree_->scene(), RTC_SCENE_FLAG_ROBUST);  // rays that meet a vertex must not slip through
  if (!corners.empty()) {
    const EmbreeScene::Mesh mesh = embree_->new_mesh(corners.size(), corners.size() / 3);
    std::copy(corners.begin(), corners.end(), mesh.points);
    std::iota(mesh.corners, mesh.corners + corners.size(), 0U);
    embree_->attach(mesh.geometry, 0);
  }
  embree_->build(corners.size() / 3);
}

TriangleTree::~TriangleTree() = default;

std::optional<TriangleHit> TriangleTree::first(const Vec3& origin, const Vec3& direction, float near,
                                               float far) const {
  RTCRayHit query = embree_ray_hit(origin, direction, far, near);
  embree_intersect(embree_->scene(), query);
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
  return TriangleHit{query.hit.primID, query.ray.tfar, query.hit.u, query.hit.v};
}

bool TriangleTree::blocked(const Vec3& origin, const Vec3& direction, float far) const {
  RTCRay ray = embree_ray(origin, direction, far);
  embree_occluded(embree_->scene(), ray);
  return ray.tfar < 0;
}

}  // namespace rnmbake
