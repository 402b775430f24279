#include "ssbump/horizon/horizon_sums.h"

#include <array>

// What follows is compiled for each set of instructions; the order matters.
// clang-format off
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "ssbump/horizon/horizon_sums.cpp"
#include <hwy/foreach_target.h>

#include "ssbump/horizon/elevation-inl.h"
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace rnmbake::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

using D = hn::CappedTag<float, most_lines_at_once>;
using V = hn::Vec<D>;
constexpr D d{};

V sines_at(const std::uint16_t* at) {
  const hn::Rebind<std::uint16_t, D> shorts;
  const hn::Rebind<std::int32_t, D> integers;
  const V scaled = hn::ConvertTo(d, hn::PromoteTo(integers, hn::LoadU(shorts, at)));
  return hn::Mul(scaled, hn::Set(d, 1 / whole_sine));
}

HWY_INLINE void add_linear(std::array<V, 4>& sums, const AzimuthLobes& lobes, V sine) {
  const Elevation<V> seen = look_above(d, sine);
  for (std::size_t c = 0; c < 3; ++c) {
    const AzimuthLobes::Linear& lobe = lobes.linear[c];
    const V part = hn::MulAdd(seen.up, hn::Set(d, lobe.up), hn::Mul(seen.along, hn::Set(d, lobe.along)));
    const auto whole = hn::Lt(sine, hn::Set(d, lobe.begins));
    sums[c] = hn::Add(sums[c], hn::IfThenElse(whole, hn::Set(d, lobe.at_most), part));
  }
  sums[3] = hn::MulAdd(seen.up, hn::Set(d, lobes.linear[SsbumpWeights::up].up), sums[3]);
}

HWY_INLINE V tabled(const float* table, V sine) {
  const hn::Rebind<std::int32_t, D> integers;
  const V scaled = hn::Mul(sine, hn::Set(d, float{AzimuthLobes::table_steps}));
  const auto index = hn::ConvertTo(integers, scaled);
  const V part = hn::Sub(scaled, hn::ConvertTo(d, index));
  const V low = hn::GatherIndex(d, table, index), high = hn::GatherIndex(d, table + 1, index);
  return hn::MulAdd(part, hn::Sub(high, low), low);
}

void add_linear_here(SweepTarget& target, const HorizonSines& all, std::span<const Azimuth> azimuths,
                     int step, bool are_first) {
  const std::size_t plane = target.plane(), row = static_cast<std::size_t>(step) * target.pitch();
  for (std::size_t i = row; i < row + target.pitch(); i += hn::Lanes(d)) {
    std::array<V, 4> sums;
    for (std::size_t c = 0; c < sums.size(); ++c)
      sums[c] = are_first ? hn::Zero(d) : hn::LoadU(d, &target.sums[c * plane + i]);
    const std::uint16_t* sines = &all.values[i];
    for (const Azimuth& azimuth : azimuths) {
      for (const Azimuth::Way& way : azimuth.ways) {
        add_linear(sums, way.lobes, sines_at(sines));
        sines += plane;
      }
    }
    for (std::size_t c = 0; c < sums.size(); ++c) hn::StoreU(sums[c], d, &target.sums[c * plane + i]);
  }
}

void add_tabled_here(SweepTarget& target, const HorizonSines& all, std::span<const Azimuth> azimuths,
                     int step, bool are_first) {
  constexpr std::size_t entries = AzimuthLobes::table_steps + 2;
  const std::size_t plane = target.plane(), row = static_cast<std::size_t>(step) * target.pitch();
  for (std::size_t c = 0; c < SsbumpWeights::channels; ++c) {
    for (std::size_t i = row; i < row + target.pitch(); i += hn::Lanes(d)) {
      V sum = are_first ? hn::Zero(d) : hn::LoadU(d, &target.sums[c * plane + i]);
      const std::uint16_t* sines = &all.values[i];
      for (const Azimuth& azimuth : azimuths) {
        for (const Azimuth::Way& way : azimuth.ways) {
          const V sine = sines_at(sines);
          sum = hn::Add(sum, c == SsbumpWeights::ambient
                                 ? hn::Mul(look_above(d, sine).up, hn::Set(d, way.lobes.linear[c].up))
                                 : tabled(way.lobes.table.data() + c * entries, sine));
          sines += plane;
        }
      }
      hn::StoreU(sum, d, &target.sums[c * plane + i]);
    }
  }
}

}  // namespace
}  // namespace rnmbake::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rnmbake {
namespace {

HWY_EXPORT(add_linear_here);
HWY_EXPORT(add_tabled_here);

}  // namespace

void add_seen(SweepTarget& target, const HorizonSines& sines, std::span<const Azimuth> azimuths, int step,
              bool are_first) {
  if (target.planes == SsbumpWeights::channels)
    HWY_DYNAMIC_DISPATCH(add_tabled_here)(target, sines, azimuths, step, are_first);
  else
    HWY_DYNAMIC_DISPATCH(add_linear_here)(target, sines, azimuths, step, are_first);
}

}  // namespace rnmbake
#endif
