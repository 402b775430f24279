#include "encoding/geomerics.h"

#include "encoding/geomerics-inl.h"

namespace rnmbake {

LobeValue geomerics_lobe(double a, const Vec3d& v, const Vec3d& normal) {
  if (!(a > 0)) return {a, 1, Vec3d(0)};
  return HWY_NAMESPACE::Geomerics()(a, v, normal);
}

}  // namespace rnmbake
