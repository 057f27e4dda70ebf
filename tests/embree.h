// Embree 3 or 4, whichever the system has, as one interface for tests and benchmarks: 4 took the
// ray streams away and moved the context into arguments behind the ray.
#pragma once
#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

/// Does this Embree trace streams of any number of rays?
#define GLINTMARK_RAY_STREAMS (RTC_VERSION_MAJOR < 4)

namespace glintmark::test {

/// Are the rays of one call neighbours on the screen, or just any?
enum class RayOrder { kAny, kCoherent };

#if RTC_VERSION_MAJOR >= 4

inline RTCIntersectArguments intersectArguments(RayOrder order) {
  RTCIntersectArguments arguments;
  rtcInitIntersectArguments(&arguments);
  if (order == RayOrder::kCoherent) arguments.flags = RTC_RAY_QUERY_FLAG_COHERENT;
  return arguments;
}

/// The first hit of one ray, in `hit`.
inline void intersect(RTCScene scene, RTCRayHit& hit, RayOrder order = RayOrder::kAny) {
  RTCIntersectArguments arguments = intersectArguments(order);
  rtcIntersect1(scene, &hit, &arguments);
}

/// The same for those of 16 rays whose entry of `valid` is -1, not 0.
inline void intersect16(RTCScene scene, const int* valid, RTCRayHit16& hit, RayOrder order) {
  RTCIntersectArguments arguments = intersectArguments(order);
  rtcIntersect16(valid, scene, &hit, &arguments);
}

#else

inline RTCIntersectContext intersectContext(RayOrder order) {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  if (order == RayOrder::kCoherent) context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  return context;
}

/// The first hit of one ray, in `hit`.
inline void intersect(RTCScene scene, RTCRayHit& hit, RayOrder order = RayOrder::kAny) {
  RTCIntersectContext context = intersectContext(order);
  rtcIntersect1(scene, &context, &hit);
}

/// The same for those of 16 rays whose entry of `valid` is -1, not 0.
inline void intersect16(RTCScene scene, const int* valid, RTCRayHit16& hit, RayOrder order) {
  RTCIntersectContext context = intersectContext(order);
  rtcIntersect16(valid, scene, &context, &hit);
}

/// The same for `count` rays in a row.
inline void intersectStream(RTCScene scene, RTCRayHit* hits, unsigned count, RayOrder order) {
  RTCIntersectContext context = intersectContext(order);
  rtcIntersect1M(scene, &context, hits, count, sizeof(RTCRayHit));
}

#endif

}  // namespace glintmark::test
