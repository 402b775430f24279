#include "pipeline/study/study_finding.h"

#include <algorithm>
#include <cstddef>
#include <tuple>

#include <spdlog/fmt/fmt.h>

namespace rnmbake {
namespace {

/// The first limit from which on, to the last, the encoding is nearer than RNM; the number of limits if none.
std::size_t nearer_from(const EncodingErrors& one, const EncodingErrors& rnm) {
  std::size_t from = tilt_limits.size();
  while (from > 0 && one.rms[from - 1] < rnm.rms[from - 1]) --from;
  return from;
}

/// What takes the least room first, then what is nearest up to 45 degrees.
bool is_better(const EncodingErrors& a, const EncodingErrors& b, const EncodingErrors& rnm) {
  const auto key = [&](const EncodingErrors& one) {
    return std::tuple(nearer_from(one, rnm), one.bytes, one.rms[1]);
  };
  return key(a) < key(b);
}

}  // namespace

std::string rnm_finding(const std::vector<EncodingErrors>& errors) {
  const auto rnm = std::ranges::find(errors, "rnm-vrad", &EncodingErrors::label);
  if (rnm == errors.end() || !rnm->unfit.empty()) return "";
  const EncodingErrors* best = nullptr;
  for (const EncodingErrors& one : errors) {
    const bool fits = one.unfit.empty() && one.bakes <= rnm->bakes && one.bytes <= rnm->bytes;
    if (!fits || nearer_from(one, *rnm) == tilt_limits.size()) continue;
    if (best == nullptr || is_better(one, *best, *rnm)) best = &one;
  }
  if (best == nullptr) {
    return fmt::format(
        "In this light nothing of {} bakes and {} bytes is nearer to the truth than Source's RNM.",
        rnm->bakes, rnm->bytes);
  }
  const std::size_t from = nearer_from(*best, *rnm);
  const std::size_t shown = std::max<std::size_t>(from, 1);
  const std::string where = from == 0 ? "does not pay at any tilt of the normal"
                                      : fmt::format("pays up to {:g} degrees of tilt", tilt_limits[from - 1]);
  return fmt::format(
      "In this light Source's RNM {}: from the same {} bakes '{}' takes {} bytes instead of {} and is off by "
      "{:.1f} % instead of {:.1f} % up to {:g} degrees.",
      where, rnm->bakes, best->label, best->bytes, rnm->bytes, 100 * best->rms[shown], 100 * rnm->rms[shown],
      tilt_limits[shown]);
}

}  // namespace rnmbake
