// base/machine.h - how much memory this machine has.
#pragma once

#include <cstdint>

namespace rnmbake {

[[nodiscard]] std::uint64_t machine_memory();

/// The control group's limit, as containers set it; 0: none.
[[nodiscard]] std::uint64_t memory_limit();

/// The smaller of the two.
[[nodiscard]] std::uint64_t usable_memory();

}  // namespace rnmbake
