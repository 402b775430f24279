// rays/embree.h - the little that differs between Embree 3 and 4.
#pragma once

#if RNMBAKE_EMBREE_MAJOR >= 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

namespace rnmbake {

inline constexpr unsigned all_rays =
    0xffffffff;  // the mask of geometries and rays: version 4's defaults differ

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
