// base/owner.h - whose a temporary file or process is, written into its name, so that what a killed run left
// can be told from what a living one needs.
#pragma once

#include <string>
#include <string_view>

namespace rnmbake {

/// This process: host, start of the machine, number and start time, as a word of letters, digits and dashes.
[[nodiscard]] const std::string& owner_word();

/// Whether the process that an owner's word names has ended. False for what cannot be known: processes of
/// other hosts or containers, and what is no owner's word.
[[nodiscard]] bool owner_is_gone(std::string_view word);

}  // namespace rnmbake
