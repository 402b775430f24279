#include "jobs/run_record.h"

#include "base/files.h"

#include <chrono>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

namespace fs = std::filesystem;

/// A record of three files, one of which is not there.
class Record : public testing::Test {
 protected:
  Record() {
    write_atomically(at("hall.blend"), "scene");
    write_atomically(at("wall.png"), "picture");
    for (const char* name : {"hall.blend", "wall.png", "absent.png"})
      record_.files.push_back(look_at("picture", at(name)));
    record_.settings = "samples = 64\nbounces = 8\n";
  }
  [[nodiscard]] fs::path at(const char* name) const { return folder_.path() / name; }
  void touch(const char* name) const {
    fs::last_write_time(at(name), fs::last_write_time(at(name)) + std::chrono::seconds(5));
  }
  [[nodiscard]] Reasons reasons() { return reasons_to_run(record_, record_.settings); }

  TempFolder folder_;
  RunRecord record_;
};

TEST_F(Record, HasNoReasonWhereNothingChanged) {
  EXPECT_EQ(reasons(), Reasons{});
  write_record(at("record"), record_);
  auto back = read_record(at("record"));
  ASSERT_TRUE(back);
  EXPECT_EQ(reasons_to_run(*back, record_.settings), Reasons{});
}

TEST_F(Record, ATouchIsNoChangeAndIsLookedAtOnce) {
  touch("wall.png");
  const auto before = record_.files[1].time;
  EXPECT_EQ(reasons(), Reasons{});
  EXPECT_NE(record_.files[1].time, before);
}

TEST_F(Record, NamesWhatChanged) {
  write_atomically(at("wall.png"), "another");
  touch("wall.png");
  EXPECT_EQ(reasons(), Reasons{"picture wall.png changed"});
  write_atomically(at("absent.png"), "x");
  fs::remove(at("hall.blend"));
  EXPECT_EQ(reasons(), (Reasons{"picture hall.blend is gone", "picture wall.png changed",
                                "picture absent.png is there now"}));
}

TEST_F(Record, NamesSettings) {
  EXPECT_EQ(reasons_to_run(record_, "samples = 128\nbounces = 8\n"), Reasons{"setting samples = 128"});
  EXPECT_EQ(reasons_to_run(record_, "samples = 64\n"), Reasons{"a setting was taken back"});
}

TEST_F(Record, ThatIsDamagedIsNone) {
  write_record(at("record"), record_);
  const std::string text = read_text(at("record"));
  for (std::size_t length = 0; length + 2 < text.size(); length += 7) {
    write_atomically(at("record"), text.substr(0, length));
    EXPECT_FALSE(read_record(at("record")));
  }
}

}  // namespace
}  // namespace rnmbake
