#include "blender/launch_watch.h"

#include "base/files.h"

#include <fstream>
#include <vector>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

/// The folder of a launch whose files the test writes.
struct Running {
  TempFolder folder;
  std::ofstream log{folder.path() / "stdout.log"}, events{folder.path() / "progress.jsonl"};
  std::vector<ProgressEvent> heard;
  LaunchWatch watch{folder.path(), [this](const ProgressEvent& event) { heard.push_back(event); }};

  /// As core/task.py does it.
  void begin(int number, const std::string& event) {
    events << event << std::endl;
    print("rnmbake: event " + std::to_string(number) + " bake");
  }
  void print(const std::string& line) { log << line << std::endl; }
};

// Lines of Blender 3.4.1, 4.3.2.
const std::string first_sample =
    "I1128 16:48:38.086030 12369 path_trace.cpp:404] Rendered 1 samples in 0.0215561 seconds (0.0215561 "
    "seconds per "
    "sample), occupancy: 1";
const std::string many_samples =
    "I1128 16:48:47.720295 12369 path_trace.cpp:404] Rendered 63 samples in 9.634 seconds (0.0094082 seconds "
    "per "
    "sample), occupancy: 1";
const std::string summary = "Rendered 64 samples in 29.078311 seconds";
const std::string status =
    "Fra:1 Mem:10.41M (Peak 10.41M) | Time:498856:48:01.15 | Mem:0.00M, Peak:0.00M | Scene | Updating Images "
    "| "
    "Loading wall.png";

TEST(LaunchWatch, CountsTheSamplesOfABakeCall) {
  Running running;
  EXPECT_FALSE(running.watch.poll());
  EXPECT_EQ(in_words(running.watch.last()), "start-up");
  running.begin(1,
                R"({"phase":"bake","what":"atlas 1 of 2","done":0,"until":100,"total":200,"samples":128})");
  EXPECT_TRUE(running.watch.poll());
  EXPECT_EQ(running.watch.last().done, 0);
  running.print(status);
  EXPECT_TRUE(running.watch.poll());
  EXPECT_EQ(in_words(running.watch.last()), "bake atlas 1 of 2, Scene | Updating Images | Loading wall.png");
  running.print(first_sample);
  running.print(many_samples);
  running.print(summary);
  EXPECT_TRUE(running.watch.poll());
  EXPECT_EQ(running.watch.last().done, 50);
  EXPECT_EQ(running.heard.back().detail, "64 of 128 samples");
  running.begin(2,
                R"({"phase":"bake","what":"atlas 2 of 2","done":100,"until":200,"total":200,"samples":128})");
  EXPECT_TRUE(running.watch.poll());
  EXPECT_EQ(running.watch.last().done, 100) << "the samples were the first atlas's";
}

TEST(LaunchWatch, UnderstandsBlender5) {
  Running running;
  running.begin(1, R"({"phase":"bake","what":"a","done":0,"until":1,"total":1,"samples":64})");
  running.print("00:04.032  render           | Fra: 1 | Mem: 0M | Synchronizing object | Cube");
  running.watch.poll();
  EXPECT_EQ(in_words(running.watch.last()), "bake a, Synchronizing object | Cube");
  running.print(
      "00:10.433  cycles           | Rendered 32 samples in 0.03 seconds (0.001 seconds per sample), "
      "occupancy: 1");
  running.print("                            | Rendered 64 samples in 1.968165 seconds");
  EXPECT_TRUE(running.watch.poll());
  EXPECT_EQ(running.watch.last().done, 0.5);
}

TEST(LaunchWatch, ACyclesThatIsMuteIsTrustedWhileItBakes) {
  Running running;
  running.begin(1, R"({"phase":"bake","what":"a","done":0,"until":1,"total":1,"samples":64})");
  running.watch.poll();
  EXPECT_TRUE(running.watch.poll());
  running.print("00:10.376  cycles           | Using AVX2 CPU kernels.");
  EXPECT_TRUE(running.watch.poll());
  EXPECT_FALSE(running.watch.poll()) << "it can speak, and says nothing";
}

TEST(LaunchWatch, HearsOfAFullDisk) {
  Running running;
  running.print("all is well");
  running.watch.poll();
  EXPECT_FALSE(running.watch.ran_out_of_room());
  running.print("E1128 17:23:15.604115 27087 tile.cpp:567] Error writing tile Failed OpenEXR write");
  running.watch.poll();
  EXPECT_TRUE(running.watch.ran_out_of_room());
}

TEST(LaunchWatch, SamplesOfTheCallBeforeDoNotCountForTheNext) {
  Running running;
  running.begin(1, R"({"phase":"bake","what":"a","done":0,"until":1,"total":2,"samples":64})");
  running.print(many_samples);
  running.watch.poll();
  running.events << R"({"phase":"bake","what":"b","done":1,"until":2,"total":2,"samples":64})" << std::endl;
  running.watch.poll();  // what is printed of it is not there yet
  EXPECT_EQ(running.watch.last().done, 1);
}

TEST(LaunchWatch, RepetitionIsNoProgress) {
  Running running;
  const std::string event = R"({"phase":"evaluate","what":"Cube","done":1,"total":0})";
  running.begin(1, event);
  EXPECT_TRUE(running.watch.poll());
  running.print("Warning: slot 12 of 345 is empty");
  EXPECT_TRUE(running.watch.poll());
  running.print("Warning: slot 13 of 345 is empty");
  running.print(status);
  EXPECT_TRUE(running.watch.poll());
  running.print("Warning: slot 14 of 345 is empty");
  running.print(status);
  EXPECT_FALSE(running.watch.poll());
  running.events << event << std::endl;
  EXPECT_FALSE(running.watch.poll());
}

TEST(LaunchWatch, TakesWholeLinesOnly) {
  Running running;
  running.begin(1, R"({"phase":"bake","what":"a","done":0,"until":64,"total":64,"samples":64})");
  running.print("I1128 16:48:38.061550 12369 svm.cpp:149] Shader manager updated 7 shaders in 0.16 seconds.");
  running.watch.poll();
  running.log << first_sample.substr(0, 60) << std::flush;
  EXPECT_FALSE(running.watch.poll());
  running.log << first_sample.substr(60) << std::endl;
  EXPECT_TRUE(running.watch.poll());
  EXPECT_EQ(running.watch.last().done, 1);
}

}  // namespace
}  // namespace rnmbake
