#include "base/error.h"
#include "base/files.h"
#include "pipeline/farm/fake_slurm.h"
#include "pipeline/farm/queue/plan_jobs.h"
#include "pipeline/farm/queue/queue_view.h"
#include "pipeline/farm/queue/wait_merge.h"
#include "pipeline/farm/task_result.h"

#include <algorithm>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

constexpr WaitPauses hurried{0.01, 0.02, 0.02};

bool has(const std::vector<std::string>& words, const std::string& word) {
  return std::ranges::find(words, word) != words.end();
}

class Queue : public testing::Test {
 protected:
  TempFolder folder_;
  FakeSlurm fake_;
  FarmPlan plan_ = plan_of_tasks(folder_.path(), 7);

  std::string refusal(ExitCode code, const std::function<void()>& action) {
    try {
      action();
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), code) << error.what();
      return error.what();
    }
    return "no refusal";
  }
};

TEST_F(Queue, CutsTasksIntoArraysAndMergesBehindThem) {
  const PlanJobs jobs = submit_jobs(plan_, fake_.slurm(), {{"--partition=bake"}, "/opt/rnmbake"});
  ASSERT_EQ(fake_.count("sbatch"), 4U);
  const auto& array = fake_.told[3];
  EXPECT_TRUE(has(array, "--array=0-0"));
  EXPECT_TRUE(has(array, "--partition=bake"));
  EXPECT_EQ(array.back(), "6");
  const auto& merge = fake_.told[4];
  EXPECT_TRUE(has(merge, "--dependency=afterany:101:102:103"));
  EXPECT_EQ(merge.back(), plan_.id);
  const auto kept = read_jobs(plan_.folder);
  ASSERT_TRUE(kept);
  EXPECT_EQ(kept->merge, "104");
  EXPECT_EQ(kept->arrays.size(), 3U);
  EXPECT_EQ(kept->task_of({"102", 2, "RUNNING", "n1", ""}), 5U);
  EXPECT_FALSE(kept->task_of({"103", 1, "RUNNING", "n1", ""}));
  EXPECT_FALSE(kept->task_of({"104", std::nullopt, "RUNNING", "n1", ""}));
  EXPECT_EQ(jobs.name, kept->name);
}

TEST_F(Queue, TheUsersWordsDecideOnlyWhatIsTheirs) {
  (void)submit_jobs(plan_, fake_.slurm(), {{"--array=0-999", "--output=mine"}, "/opt/rnmbake"});
  const auto& words = fake_.told[1];
  const auto place = [&](const std::string& word) { return std::ranges::find(words, word) - words.begin(); };
  EXPECT_LT(place("--array=0-999"), place("--array=0-2"));  // the last one counts
  EXPECT_LT(place("--requeue"), place("--output=mine"));
}

TEST_F(Queue, TakesBackWhatWasHandedInBeforeARefusal) {
  fake_.refused_submission = 3;
  const std::string said = refusal(ExitCode::environment, [&] {
    (void)submit_jobs(plan_, fake_.slurm(), {{}, "/opt/rnmbake"});
  });
  EXPECT_NE(said.find("over the limit"), std::string::npos) << said;
  ASSERT_EQ(fake_.count("scancel"), 1U);
  EXPECT_TRUE(has(fake_.told.back(), "--name=" + read_jobs(plan_.folder)->name));
}

TEST_F(Queue, APlanWithoutTasksIsMergedAtOnce) {
  plan_.tasks.clear();
  (void)submit_jobs(plan_, fake_.slurm(), {{}, "/opt/rnmbake"});
  ASSERT_EQ(fake_.count("sbatch"), 1U);
  for (const std::string& word : fake_.told.back()) EXPECT_FALSE(word.starts_with("--dependency")) << word;
}

TEST_F(Queue, AFolderWhoseJobsLiveIsNotTaken) {
  (void)submit_jobs(plan_, fake_.slurm(), {{}, "/opt/rnmbake"});
  fake_.queues = {"101|0|COMPLETED|n1|None\n104|N/A|PENDING||Dependency\n", "104|N/A|CANCELLED||\n"};
  const std::string said =
      refusal(ExitCode::lock_held, [&] { require_no_jobs(plan_.folder, fake_.slurm()); });
  EXPECT_NE(said.find("1 job of an earlier plan"), std::string::npos) << said;
  require_no_jobs(plan_.folder, fake_.slurm());
}

TEST_F(Queue, CancelWaitsForTheEnd) {
  const PlanJobs jobs = submit_jobs(plan_, fake_.slurm(), {{}, "/opt/rnmbake"});
  fake_.queues = {"101|0|RUNNING|n1|None\n", "101|0|COMPLETING|n1|None\n", "101|0|CANCELLED|n1|None\n"};
  EXPECT_EQ(cancel_jobs(plan_, jobs, fake_.slurm()), 1U);
  EXPECT_EQ(fake_.questions, 3U);
  EXPECT_TRUE(read_jobs(plan_.folder)->cancelled);
  EXPECT_EQ(cancel_jobs(plan_, jobs, fake_.slurm()), 0U);
}

TEST_F(Queue, WaitGivesTheExitCodeOfTheMerge) {
  const PlanJobs jobs = submit_jobs(plan_, fake_.slurm(), {{}, "/opt/rnmbake"});
  fake_.queues = {"101|0|RUNNING|n1|None\n"};
  std::jthread merge([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    note_merged(plan_, {6, ""});
  });
  EXPECT_EQ(wait_for_merge(plan_, jobs, fake_.slurm(), hurried), 6);
}

TEST_F(Queue, WaitEndsWhereTheJobsAreGone) {
  const PlanJobs jobs = submit_jobs(plan_, fake_.slurm(), {{}, "/opt/rnmbake"});
  write_task_result(plan_, 0, {});
  // A controller that is away, one look that saw too little, and then nothing any more.
  fake_.queues = {std::nullopt, "", "104|N/A|PENDING||Dependency\n", "", ""};
  const std::string said =
      refusal(ExitCode::io, [&] { (void)wait_for_merge(plan_, jobs, fake_.slurm(), hurried); });
  EXPECT_NE(said.find("has no job in Slurm any more"), std::string::npos) << said;
  EXPECT_NE(said.find("1 of 7 tasks left a result"), std::string::npos) << said;
  EXPECT_EQ(fake_.questions, 5U);
}

TEST_F(Queue, SaysWhatItSees) {
  const PlanJobs jobs{"name", {{"101", 0, 3}, {"102", 3, 3}}, "104", false};
  const std::vector<SlurmJob> seen{
      {"101", 0, "COMPLETED", "n1", ""},      {"101", 1, "TIMEOUT", "n2", ""},
      {"101", 2, "RUNNING", "n2", "None"},    {"102", 0, "RUNNING", "n1", "None"},
      {"102", 1, "PENDING", "", "Resources"}, {"104", std::nullopt, "PENDING", "", "JobHeldUser"}};
  EXPECT_EQ(describe(view_of(seen)),
            "Slurm: 2 running on n1, n2; 2 waiting; 2 ended; held: 104: JobHeldUser");
  const std::vector<std::string> lines = ended_without_result(plan_, jobs, seen, {{0, {}}});
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_EQ(lines[0], "task 1: TIMEOUT on n2, " + (plan_.folder / "slurm" / "101_1.log").string());
  EXPECT_EQ(ended_without_result(plan_, jobs, {{"102", std::nullopt, "CANCELLED", "", ""}}, {}),
            (std::vector<std::string>{"tasks 3 to 5, what had not begun of them: CANCELLED"}));
}

}  // namespace
}  // namespace rnmbake
