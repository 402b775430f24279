// pipeline/gather/indirect_light.h - recipe gather: light that bounced, out of mirrors that Cycles bakes.
//
// E(b)/pi = direct + indirect. Direct light comes from plain receivers that may not bounce (bake/receiver.h);
// here is the rest: mirrors for rays of ours (bake/mirrors.h), and what arrives along them shared among
// texels (trace/mirror_gather.h).
#pragma once

#include "bake/fences.h"
#include "bake/plan.h"
#include "bake/targets.h"
#include "blender/blender_info.h"
#include "config/bake_settings.h"
#include "pipeline/lightmaps/bounced_light.h"
#include "scene/diffuse_scene.h"
#include "trace/mirror_gather.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <vector>

namespace rnmbake {

class IndirectLight : public BouncedLightSource {
 public:
  /// Keeps a copy of the survey's geometry, and references to the rest.
  IndirectLight(const SceneSurvey& survey, const std::vector<BasisDirection>& bases,
                const BlenderVersion& version);

  /// Adds the mirrors of a target, number plan.targets.size() - 1 of the plan. `cycles`: of a plain receiver
  /// with as many samples. Call group_mirrors() when all are there.
  void plan(Plan& plan, const Target& target, const CyclesSettings& cycles);

  [[nodiscard]] BouncedLight gather(std::size_t target, const Plan& plan,
                                    const std::map<std::size_t, BakedPicture>& pictures) const override;

 private:
  struct Member {
    Surface surface;  // relative to the scene's origin
    GatherOptions options;
    GatherTarget target;
    std::array<std::vector<std::uint32_t>, 2> rays;  // [halves] number of the ray of each mirror, as planned
  };
  /// What a ray meets first.
  enum class Meets { nothing, surface, light };
  [[nodiscard]] Meets meets(const PrimaryRay& ray) const;
  [[nodiscard]] MirrorGather half_of(const Member& member, std::size_t half) const;

  const std::vector<BasisDirection>& bases_;
  GatherOptions common_;
  std::vector<char> even_, glows_;  // [materials of the scene]
  bool is_complete_;                // the survey holds all that a ray may meet
  std::vector<LightBall> lamps_;    // places relative to the scene's origin
  DiffuseScene scene_;
  std::unique_ptr<TraceScene> trace_scene_;
  std::map<std::size_t, Member> members_;
};

}  // namespace rnmbake
