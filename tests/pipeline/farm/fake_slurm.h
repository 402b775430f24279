// tests/pipeline/farm/fake_slurm.h - Slurm's commands that remember what they were told.
#pragma once

#include "jobs/queue/slurm.h"
#include "pipeline/farm/farm_plan.h"

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace rnmbake {

struct FakeSlurm {
  std::vector<std::vector<std::string>> told;
  std::size_t array_limit = 3;
  std::size_t refused_submission = 0;              // the how manieth sbatch is refused; 0: none
  std::vector<std::optional<std::string>> queues;  // what squeue prints, one after the other; the last stays
  std::size_t submissions = 0, questions = 0;

  [[nodiscard]] Slurm slurm() {
    return Slurm([this](const std::vector<std::string>& argv) { return answer(argv); });
  }

  [[nodiscard]] std::size_t count(const std::string& program) const {
    std::size_t times = 0;
    for (const auto& argv : told) times += argv.front() == program ? 1 : 0;
    return times;
  }

 private:
  CommandAnswer answer(const std::vector<std::string>& argv) {
    told.push_back(argv);
    if (argv[0] == "scontrol") return {0, "MaxArraySize = " + std::to_string(array_limit) + "\n"};
    if (argv[0] == "sbatch") {
      if (++submissions == refused_submission) return {1, "sbatch: error: over the limit\n"};
      return {0, std::to_string(100 + submissions) + "\n"};
    }
    if (argv[0] != "squeue" || queues.empty()) return {0, ""};
    const auto& text = queues[std::min(questions++, queues.size() - 1)];
    return text ? CommandAnswer{0, *text} : CommandAnswer{1, "no controller"};
  }
};

/// A plan of so many tasks that bake nothing.
inline FarmPlan plan_of_tasks(const std::filesystem::path& folder, std::size_t count) {
  FarmPlan plan;
  plan.folder = folder;
  plan.output = folder / "out";
  plan.id = "0123456789abcdef0123456789abcdef";
  plan.tasks.assign(count, FarmTask{{}, 10});
  return plan;
}

}  // namespace rnmbake
