// sampling/mis.h - multiple importance sampling: weights of two strategies that can find the same direction.
//
// Veach, "Robust Monte Carlo Methods for Light Transport Simulation" (1997). Each takes one sample.
#pragma once

namespace rnmbake {

/// Weight of a sample drawn with `pdf` that the other strategy would draw with `other_pdf`.
[[nodiscard]] inline float balance_heuristic(float pdf, float other_pdf) {
  return pdf / (pdf + other_pdf);
}

/// The same with exponent 2, which is what Cycles weighs by.
[[nodiscard]] inline float power_heuristic(float pdf, float other_pdf) {
  return pdf * pdf / (pdf * pdf + other_pdf * other_pdf);
}

}  // namespace rnmbake
