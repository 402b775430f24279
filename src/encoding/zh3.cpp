#include "encoding/zh3.h"

#include "encoding/zh3-inl.h"

namespace rnmbake {

LobeValue zh3_lobe(double a, const Vec3d& v, const Vec3d& normal) {
  if (!(a > 0)) return {a + v.dot(normal), 1, normal};
  return HWY_NAMESPACE::Zh3()(a, v, normal);
}

}  // namespace rnmbake
