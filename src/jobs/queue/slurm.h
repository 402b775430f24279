// jobs/queue/slurm.h - the commands of Slurm: jobs handed in, asked after and taken back.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace rnmbake {

/// One job, or one element of an array, as the queue has it.
struct SlurmJob {
  std::string id;                    // of the job, or of its array
  std::optional<std::size_t> index;  // in its array
  std::string state;                 // "PENDING", "RUNNING", "NODE_FAIL", ...
  std::string nodes;                 // "n[1-4]"; "": none yet
  std::string reason;                // of its waiting

  /// Whether it may still run, or runs.
  [[nodiscard]] bool is_alive() const;
  /// Waits for a person: held by somebody, or by Slurm, which could not start it.
  [[nodiscard]] bool is_held() const;
};

/// What a command printed, and how it ended. nothing: there is no such command.
struct CommandAnswer {
  int exit_code = 0;
  std::string text;
};
using RunCommand = std::function<std::optional<CommandAnswer>(const std::vector<std::string>& argv)>;

class Slurm {
 public:
  /// By the commands on PATH.
  Slurm();
  explicit Slurm(RunCommand run) : run_(std::move(run)) {}

  /// MaxArraySize: indices of an array are below it. Throws Error(environment) where there is no Slurm, its
  /// controller does not answer, or it takes no arrays.
  [[nodiscard]] std::size_t array_limit() const;

  /// `sbatch --parsable WORDS`; the id of the job. Throws Error(environment) with Slurm's words where it
  /// refuses.
  [[nodiscard]] std::string submit(const std::vector<std::string>& words) const;

  /// All jobs of that name that the controller remembers, ended ones too; nothing where it does not answer.
  [[nodiscard]] std::optional<std::vector<SlurmJob>> jobs_named(const std::string& name) const;

  /// Asks for the end of all jobs of that name. Throws Error(environment).
  void cancel(const std::string& name) const;

 private:
  /// What it printed. Throws Error(environment), which ends with `remedy`.
  [[nodiscard]] std::string must(const std::vector<std::string>& argv, const std::string& remedy) const;

  RunCommand run_;
};

}  // namespace rnmbake
