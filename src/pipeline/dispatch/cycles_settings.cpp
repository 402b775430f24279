#include "pipeline/dispatch/cycles_settings.h"

namespace rnmbake {
namespace {

const char* name_of(BakingSettings::Device device) {
  using Device = BakingSettings::Device;
  switch (device) {
    case Device::cpu:
      return "CPU";
    case Device::cuda:
      return "CUDA";
    case Device::optix:
      return "OPTIX";
    case Device::hip:
      return "HIP";
    case Device::metal:
      return "METAL";
    case Device::oneapi:
      return "ONEAPI";
  }
  return "CPU";
}

}  // namespace

CyclesSettings cycles_settings(const BakingSettings& bake, const ObjectSettings& object) {
  CyclesSettings cycles{object.samples, bake.bounces, object.seed, object.clamp, name_of(bake.device)};
  cycles.noise = object.noise / 100;
  return cycles;
}

}  // namespace rnmbake
