// bench/farm_plan.cpp - a plan of so many objects, made of a smaller one: its batches again and again, cut
// anew.
//
// bench_farm_plan PLAN OBJECTS TASK_MINUTES FOLDER writes it to FOLDER and prints one JSON object: what it
// holds, and processor seconds. Its batches lack the arrays, so that its tasks can be looked at and not be
// run.
#include "pipeline/farm/farm_plan.h"

#include "base/error.h"
#include "pipeline/farm/cut_tasks.h"

#include <ctime>
#include <iostream>
#include <string>

#include <nlohmann/json.hpp>

namespace rnmbake {
namespace {

std::size_t objects_of(const std::vector<FarmBatch>& batches) {
  std::size_t count = 0;
  for (const FarmBatch& batch : batches) count += batch.objects.size();
  return count;
}

std::size_t passes_of(const std::vector<FarmBatch>& batches) {
  std::size_t count = 0;
  for (const FarmBatch& batch : batches) count += batch.passes.size();
  return count;
}

/// With its passes, which tasks read for themselves.
std::vector<FarmBatch> all_of(const FarmPlan& plan) {
  std::vector<FarmBatch> batches = plan.batches;
  for (const FarmTask& task : plan.tasks) {
    for (auto& [batch, passes] : read_passes(plan, task)) batches[batch].passes = passes;
  }
  return batches;
}

/// Whole batches, until there are `wanted` objects.
std::vector<FarmBatch> repeated(const std::vector<FarmBatch>& batches, std::size_t wanted) {
  std::vector<FarmBatch> result;
  for (std::size_t objects = 0, i = 0; objects < wanted; ++i) {
    FarmBatch batch = batches[i % batches.size()];
    for (std::string& name : batch.objects) name += fmt::format(".{:03}", i / batches.size());
    objects += batch.objects.size();
    result.push_back(std::move(batch));
  }
  return result;
}

template <typename Work>
double cpu_seconds(const Work& work) {
  const std::clock_t start = std::clock();
  work();
  return double(std::clock() - start) / CLOCKS_PER_SEC;
}

int run(const std::string& source, std::size_t objects, double minutes, const std::string& folder) {
  FarmPlan plan = read_farm_plan(source);
  plan.batches = repeated(all_of(plan), objects);
  plan.folder = folder;
  const double start = launch_seconds(plan.scene_triangles);
  const double cut = cpu_seconds([&] { plan.tasks = cut_tasks(plan.batches, minutes * 60, start); });
  const double write = cpu_seconds([&] { write_farm_plan(plan); });
  double seconds = 0;
  for (const FarmTask& task : plan.tasks) seconds += task.seconds;
  const double read = cpu_seconds([&] { (void)read_farm_plan(folder); });
  const nlohmann::json text{{"objects", objects_of(plan.batches)},
                            {"batches", plan.batches.size()},
                            {"passes", passes_of(plan.batches)},
                            {"tasks", plan.tasks.size()},
                            {"seconds", seconds},
                            {"imbalance", imbalance(plan.tasks)},
                            {"cut_cpu", cut},
                            {"write_cpu", write},
                            {"read_cpu", read}};
  std::cout << text << "\n";
  return 0;
}

}  // namespace
}  // namespace rnmbake

int main(int argc, char** argv) {
  if (argc != 5) {
    std::cerr << "usage: bench_farm_plan PLAN OBJECTS TASK_MINUTES FOLDER\n";
    return 1;
  }
  try {
    return rnmbake::run(argv[1], std::stoul(argv[2]), std::stod(argv[3]), argv[4]);
  } catch (const std::exception& error) {
    std::cerr << "bench_farm_plan: " << error.what() << "\n";
    return 1;
  }
}
