// pipeline/lightmaps/bounced_light.h - light of a target beside what its receivers show, where recipe gather
// bakes it apart (pipeline/gather).
#pragma once

#include "bake/baked_picture.h"
#include "bake/plan.h"
#include "image/bakes.h"
#include "trace/gather_options.h"

#include <array>
#include <cstddef>
#include <map>

namespace rnmbake {

/// Two independent halves, without directions where nothing bounces. Texels that are not covered have their
/// neighbours' light: the programs round edges differently.
using BouncedLight = std::array<Gathered, 2>;

class BouncedLightSource {
 public:
  virtual ~BouncedLightSource() = default;
  /// Of one target. `pictures`: by the plan's rectangles, all of the target's. Thread-safe.
  [[nodiscard]] virtual BouncedLight gather(std::size_t target, const Plan& plan,
                                            const std::map<std::size_t, BakedPicture>& pictures) const = 0;

 protected:
  BouncedLightSource() = default;
  BouncedLightSource(const BouncedLightSource&) = default;
  BouncedLightSource& operator=(const BouncedLightSource&) = default;
};

/// Adds `share` of light that bounced to what came directly.
void add_light(const Gathered& gathered, float share, TargetBakes& bakes);

}  // namespace rnmbake
