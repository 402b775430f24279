#include "pipeline/farm/queue_words.h"

#include "base/error.h"
#include "base/text.h"

#include <algorithm>

namespace rnmbake {

std::string job_name(const FarmPlan& plan) {
  return "rnmbake " + printable(plan.scene.filename().string());
}

void require_queue_words(const std::filesystem::path& plan_folder) {
  const std::string word = plan_folder.string();
  const auto is_control = [](unsigned char c) { return c < 0x20 || c == 0x7F; };
  if (std::ranges::any_of(word, is_control) || valid_utf8(word) != word)
    fail(
        ExitCode::usage,
        "{}: control characters and bytes that are no UTF-8 cannot be put into a job for a queue; rename it, "
        "name another with --plan, or submit without --export",
        printable(word));
}

}  // namespace rnmbake
