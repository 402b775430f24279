// cli/app.h - the whole program as one call.
#pragma once

namespace rnmbake {

/// Parses the command line, runs the command, turns errors into one line on stderr.
/// Returns the exit code; see base/error.h and docs/exit-codes.md. Never throws.
int run(int argc, const char* const* argv) noexcept;

}  // namespace rnmbake
