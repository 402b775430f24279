// jobs/graph.h - tasks that wait for each other, run by some workers.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

namespace rnmbake {

/// Outcome of a task.
struct Done {};
struct Failed {
  std::string reason;
};
struct Skipped {
  std::string reason;  // "'unwrap floor' failed: ..." or "stopped"
};
using TaskOutcome = std::variant<Done, Failed, Skipped>;

/// Number of a task in the order in which they were added.
using TaskNumber = std::size_t;

/// Thrown by a task where no other task has a chance either (the disk is full, Blender is gone): the graph
/// ends and run() rethrows it.
class Hopeless : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct TaskGraphOptions {
  int workers = 1;
  /// Looked at before each task is begun, by one thread at a time; true: none is begun any more. May be
  /// empty.
  std::function<bool()> stop;
  /// Whether an exception counts as Hopeless beside that type itself. May be empty.
  std::function<bool(const std::exception&)> is_hopeless;
};

struct Task {
  std::string name;  // for the reasons of others
  std::function<void()> work;
  std::vector<TaskNumber> needs;  // tasks that were added before; no circles, therefore
  double cost = 0;                // predicted, in any unit
};

/// Of the tasks whose needs are done, the most costly one is begun first, of equal ones that which was added
/// first; with one worker the order is always the same. A task that throws fails, and all that need it are
/// skipped and told why; the others go on.
class TaskGraph {
 public:
  explicit TaskGraph(TaskGraphOptions options);
  ~TaskGraph();
  TaskGraph(const TaskGraph&) = delete;
  TaskGraph& operator=(const TaskGraph&) = delete;

  /// Before run(), or by tasks while they run. Throws std::out_of_range where it needs a task that is not
  /// there.
  TaskNumber add(Task task);

  /// Runs all tasks; the outcome of each by its number. Once only. Rethrows what was hopeless, when the tasks
  /// that ran at that time have ended.
  std::vector<TaskOutcome> run();

 private:
  class State;
  std::unique_ptr<State> state_;
};

}  // namespace rnmbake
