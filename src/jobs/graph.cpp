#include "jobs/graph.h"

#include <algorithm>
#include <condition_variable>
#include <deque>
#include <exception>
#include <mutex>
#include <optional>
#include <set>
#include <thread>
#include <tuple>
#include <utility>

#include <spdlog/fmt/fmt.h>

namespace rnmbake {

namespace {

struct Node {
  Task task;
  std::size_t missing = 0;  // needs that are not done yet
  std::vector<TaskNumber> dependents;
  std::optional<TaskOutcome> outcome;
};

/// Of a task that is ready, in the order in which they begin.
struct Turn {
  double cost = 0;
  TaskNumber number = 0;
  bool operator<(const Turn& other) const {
    return std::tie(other.cost, number) < std::tie(cost, other.number);
  }
};

/// What dependents of a task are told; nothing where it is done.
std::optional<std::string> obstacle(const Node& node) {
  if (const auto* failed = std::get_if<Failed>(&*node.outcome))
    return fmt::format("'{}' failed: {}", node.task.name, failed->reason);
  if (const auto* skipped = std::get_if<Skipped>(&*node.outcome)) return skipped->reason;
  return std::nullopt;
}

}  // namespace

class TaskGraph::State {
 public:
  explicit State(TaskGraphOptions options) : options_(std::move(options)) {}

  TaskNumber add(Task task) {
    const std::lock_guard lock(mutex_);
    const TaskNumber number = nodes_.size();
    for (const TaskNumber need : task.needs) (void)nodes_.at(need);
    std::sort(task.needs.begin(), task.needs.end());
    task.needs.erase(std::unique(task.needs.begin(), task.needs.end()), task.needs.end());
    Node& node = nodes_.emplace_back();
    node.task = std::move(task);
    for (const TaskNumber need : node.task.needs) {
      Node& needed = nodes_[need];
      if (!needed.outcome) {
        needed.dependents.push_back(number);
        ++node.missing;
      } else if (auto why = obstacle(needed); why && !node.outcome) {
        node.outcome = Skipped{*std::move(why)};
      }
    }
    if (!node.outcome && node.missing == 0) make_ready(number);
    return number;
  }

  std::vector<TaskOutcome> run() {
    std::vector<std::thread> threads;
    try {
      for (int i = 1; i < options_.workers; ++i) threads.emplace_back([this] { work(); });
    } catch (const std::system_error&) {  // fewer threads than wished for will do
    }
    work();
    for (std::thread& thread : threads) thread.join();
    if (hopeless_) std::rethrow_exception(hopeless_);
    std::vector<TaskOutcome> outcomes;
    for (Node& node : nodes_)
      outcomes.push_back(node.outcome ? *std::move(node.outcome) : Skipped{"stopped"});
    return outcomes;
  }

 private:
  void work() {
    std::unique_lock lock(mutex_);
    while (true) {
      changed_.wait(lock, [&] { return ended_ || !ready_.empty() || running_ == 0; });
      if (!ended_ && !ready_.empty()) end_if_asked();
      if (ended_ || ready_.empty()) break;  // none is ready and none runs that could make one so
      const TaskNumber number = ready_.begin()->number;
      ready_.erase(ready_.begin());
      ++running_;
      const std::function<void()> work = std::move(nodes_[number].task.work);
      lock.unlock();
      TaskOutcome outcome = outcome_of(work);
      lock.lock();
      --running_;
      settle(number, std::move(outcome));
      if (running_ == 0) changed_.notify_all();
    }
    changed_.notify_all();
  }

  void end_if_asked() {
    try {
      ended_ = options_.stop && options_.stop();
    } catch (...) {
      give_up(std::current_exception());
    }
  }

  /// Without the lock.
  TaskOutcome outcome_of(const std::function<void()>& work) {
    try {
      work();
      return Done{};
    } catch (const std::exception& error) {
      const bool is_hopeless = dynamic_cast<const Hopeless*>(&error) != nullptr ||
                               (options_.is_hopeless && options_.is_hopeless(error));
      if (is_hopeless) give_up_now(std::current_exception());
      return Failed{error.what()};
    } catch (...) {  // no failure of a task: the user stopped the program, a thread was cancelled
      give_up_now(std::current_exception());
      return Failed{"it was stopped"};
    }
  }

  void give_up_now(std::exception_ptr error) {
    const std::lock_guard lock(mutex_);
    give_up(std::move(error));
  }

  /// With the lock, as all below.
  void give_up(std::exception_ptr error) {
    if (!hopeless_) hopeless_ = std::move(error);
    ended_ = true;
    changed_.notify_all();
  }

  void make_ready(TaskNumber number) {
    ready_.insert({nodes_[number].task.cost, number});
    changed_.notify_one();
  }

  /// Of a task and, where it is not done, of all that need it, directly or not.
  void settle(TaskNumber number, TaskOutcome outcome) {
    std::deque<std::pair<TaskNumber, TaskOutcome>> queue;
    queue.emplace_back(number, std::move(outcome));
    for (; !queue.empty(); queue.pop_front()) {
      Node& node = nodes_[queue.front().first];
      if (node.outcome) continue;  // skipped for another reason before
      node.outcome = std::move(queue.front().second);
      const auto why = obstacle(node);
      for (const TaskNumber dependent : node.dependents) {
        if (why) {
          queue.emplace_back(dependent, Skipped{*why});
        } else if (--nodes_[dependent].missing == 0 && !nodes_[dependent].outcome) {
          make_ready(dependent);
        }
      }
    }
  }

  TaskGraphOptions options_;
  std::mutex mutex_;  // of all below
  std::condition_variable changed_;
  std::deque<Node> nodes_;  // of which none moves when others are added
  std::set<Turn> ready_;
  std::size_t running_ = 0;
  bool ended_ = false;
  std::exception_ptr hopeless_;
};

TaskGraph::TaskGraph(TaskGraphOptions options) : state_(std::make_unique<State>(std::move(options))) {}

TaskGraph::~TaskGraph() = default;

TaskNumber TaskGraph::add(Task task) {
  return state_->add(std::move(task));
}

std::vector<TaskOutcome> TaskGraph::run() {
  return state_->run();
}

}  // namespace rnmbake
