// rays/embree.h - the little that differs between Embree 3 and 4.
#pragma once

#include "base/math.h"

#if RNMBAKE_EMBREE_MAJOR >= 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

namespace rnmbake {

inline constexpr unsigned all_rays =
    0xffffffff;  // the mask of geometries and rays: version 4's defaults differ

/// In [from, to] along `direction`.
inline RTCRay embree_ray(const Vec3& origin, const Vec3& direction, float to, float from = 0) {
  RTCRay ray{};
  ray.org_x = origin.x;
  ray.org_y = origin.y;
  ray.org_z = origin.z;
  ray.dir_x = direction.x;
  ray.dir_y = direction.y;
  ray.dir_z = direction.z;
  ray.tnear = from;
  ray.tfar = to;
  ray.mask = all_rays;
  return ray;
}

/// The same, which has met nothing yet.
inline RTCRayHit embree_ray_hit(const Vec3& origin, const Vec3& direction, float to, float from = 0) {
  RTCRayHit query;
  query.ray = embree_ray(origin, direction, to, from);
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  return query;
}

inline void embree_intersect(RTCScene scene, RTCRayHit& query) {
#if RNMBAKE_EMBREE_MAJOR >= 4
  rtcIntersect1(scene, &query);
#else
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(scene, &context, &query);
#endif
}

inline void embree_occluded(RTCScene scene, RTCRay& ray) {
#if RNMBAKE_EMBREE_MAJOR >= 4
  rtcOccluded1(scene, &ray);
#else
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded1(scene, &context, &ray);
#endif
}

/// A query's context with something of its caller's, which filters find again.
struct EmbreeContext {
#if RNMBAKE_EMBREE_MAJOR >= 4
  RTCRayQueryContext base;
#else
  RTCIntersectContext base;
#endif
  void* user;
};

/// What the query that a filter works for was given.
inline void* embree_user(const RTCFilterFunctionNArguments& filter) {
  return reinterpret_cast<const EmbreeContext*>(filter.context)->user;
}

/// With filters: every query of a scene whose geometries have some must be one of these two.
inline void embree_intersect(RTCScene scene, RTCRayHit& query, void* user) {
  EmbreeContext context;
  context.user = user;
#if RNMBAKE_EMBREE_MAJOR >= 4
  rtcInitRayQueryContext(&context.base);
  RTCIntersectArguments arguments;
  rtcInitIntersectArguments(&arguments);
  arguments.context = &context.base;
  rtcIntersect1(scene, &query, &arguments);
#else
  rtcInitIntersectContext(&context.base);
  rtcIntersect1(scene, &context.base, &query);
#endif
}

inline void embree_occluded(RTCScene scene, RTCRay& ray, void* user) {
  EmbreeContext context;
  context.user = user;
#if RNMBAKE_EMBREE_MAJOR >= 4
  rtcInitRayQueryContext(&context.base);
  RTCOccludedArguments arguments;
  rtcInitOccludedArguments(&arguments);
  arguments.context = &context.base;
  rtcOccluded1(scene, &ray, &arguments);
#else
  rtcInitIntersectContext(&context.base);
  rtcOccluded1(scene, &context.base, &ray);
#endif
}

/// `valid`: -1 for each of the eight rays that is there, else 0.
inline void embree_occluded8(const int* valid, RTCScene scene, RTCRay8& rays) {
#if RNMBAKE_EMBREE_MAJOR >= 4
  rtcOccluded8(valid, scene, &rays);
#else
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded8(valid, scene, &context, &rays);
#endif
}

}  // namespace rnmbake
