#include "jobs/queue/slurm.h"

#include "base/error.h"

#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

/// Slurm's commands that always answer the same.
Slurm answering(int exit_code, const std::string& text) {
  return Slurm([=](const std::vector<std::string>&) { return CommandAnswer{exit_code, text}; });
}

std::string refusal(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::environment);
    return error.what();
  }
  return "no refusal";
}

TEST(Slurm, ReadsTheLimitOfArrays) {
  EXPECT_EQ(answering(0, "MaxArraySize            = 1001\nMaxJobCount = 10000\n").array_limit(), 1001U);
  const std::string said = refusal([] { (void)answering(0, "MaxArraySize            = 0\n").array_limit(); });
  EXPECT_NE(said.find("takes no arrays"), std::string::npos) << said;
}

TEST(Slurm, FindsTheIdAmongWhatSitesPrint) {
  EXPECT_EQ(answering(0, "sbatch: Welcome to the 2nd cluster\n4711\n").submit({}), "4711");
  EXPECT_EQ(answering(0, "4711;north\n").submit({}), "4711");
  const std::string said = refusal([] { (void)answering(0, "sbatch: hello\n").submit({}); });
  EXPECT_NE(said.find("names no job: hello"), std::string::npos) << said;
}

TEST(Slurm, ShowsItsWordsWhereItRefuses) {
  const std::string said = refusal([] {
    (void)answering(1, "sbatch: error: invalid partition\nsbatch: error: Batch job submission failed\n")
        .submit({});
  });
  EXPECT_NE(said.find("sbatch refuses: invalid partition; Batch job submission failed; "), std::string::npos)
      << said;
}

TEST(Slurm, SaysWhichCommandIsMissing) {
  const Slurm slurm([](const std::vector<std::string>&) { return std::nullopt; });
  EXPECT_NE(refusal([&] { (void)slurm.array_limit(); }).find("no scontrol on PATH"), std::string::npos);
  EXPECT_NE(refusal([&] { (void)slurm.submit({}); }).find("no sbatch on PATH"), std::string::npos);
  EXPECT_FALSE(slurm.jobs_named("name"));
}

TEST(Slurm, ReadsJobs) {
  const auto jobs = answering(0,
                              "squeue: a word of the site\n"
                              "12|3|RUNNING|n1|None\n"
                              "12|N/A|CANCELLED||Resources\n"
                              "13|N/A|PENDING||Dependency\n"
                              "14|0|NODE_FAIL|n2|\n"
                              "15|1|PENDING||launch failed requeued held\n"
                              "16|2|COMPLETING|n1|None\n")
                        .jobs_named("name");
  ASSERT_TRUE(jobs);
  ASSERT_EQ(jobs->size(), 6U);
  EXPECT_EQ((*jobs)[0].id, "12");
  EXPECT_EQ((*jobs)[0].index, 3U);
  EXPECT_EQ((*jobs)[0].nodes, "n1");
  EXPECT_FALSE((*jobs)[1].index);
  EXPECT_EQ((*jobs)[2].reason, "Dependency");
  const std::vector<bool> alive{true, false, true, false, true, true};
  for (std::size_t i = 0; i < alive.size(); ++i) EXPECT_EQ((*jobs)[i].is_alive(), alive[i]) << i;
  for (std::size_t i = 0; i < alive.size(); ++i) EXPECT_EQ((*jobs)[i].is_held(), i == 4) << i;
  EXPECT_FALSE(answering(1, "slurm_load_jobs error: Unable to contact slurm controller").jobs_named("name"));
}

}  // namespace
}  // namespace rnmbake
