// tests/support/run_words.h - a program run to its end, with its options left alone.
#pragma once

#include "process/run.h"

#include <string>
#include <utility>
#include <vector>

namespace rnmbake {

inline ProcessResult run_words(std::vector<std::string> argv) {
  ProcessOptions options;
  options.argv = std::move(argv);
  return run_process(options);
}

}  // namespace rnmbake
