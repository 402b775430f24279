#include "base/log.h"

#include "base/events/log_event.h"

#include <limits>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace rnmbake {
namespace {

TEST(Log, TextNamesTheProgramAndTheLevel) {
  EXPECT_EQ(log::format_line(log::Format::text, log::Level::info, "found", false), "rnmbake: found");
  EXPECT_EQ(log::format_line(log::Format::text, log::Level::warning, "odd", false), "rnmbake: warning: odd");
  EXPECT_EQ(log::format_line(log::Format::text, log::Level::error, "no", true),
            "\033[31mrnmbake: error: \033[0mno");
}

TEST(Log, JsonSurvivesAnyMessage) {
  const std::string line =
      log::format_line(log::Format::jsonl, log::Level::warning, "a \"b\" \\ c\nd\x01 ü", false);
  EXPECT_NE(line.find(R"("level":"warning","event":"message","message":"a \"b\" \\ c\nd\u0001 ü"})"),
            std::string::npos)
      << line;
  EXPECT_EQ(line.find('\n'), std::string::npos);
}

TEST(Log, NamesDoNotSteerTheTerminal) {
  EXPECT_EQ(log::format_line(log::Format::text, log::Level::info, "a\033]0;x\a\nb", false),
            "rnmbake: a\\x1b]0;x\\x07\\x0ab");
  EXPECT_EQ(log::format_line(log::Format::text, log::Level::debug, "a\nb", false), "rnmbake: debug: a\nb");
  const std::string line = log::format_line(log::Format::jsonl, log::Level::info, "a\xff\033", false);
  EXPECT_NE(line.find("a\xEF\xBF\xBD\\u001b"), std::string::npos) << line;
}

TEST(Log, QuietKeepsErrors) {
  log::init(-1, log::Format::text);
  testing::internal::CaptureStderr();
  log::info("nobody hears {}", 1);
  log::warn("nor this");
  log::error("but {}", "this");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "rnmbake: error: but this\n");
  log::init(0, log::Format::text);
}

TEST(Log, DebugNeedsToBeAskedFor) {
  log::init(0, log::Format::text);
  testing::internal::CaptureStderr();
  log::debug("hidden");
  log::init(1, log::Format::text);
  log::debug("shown");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "rnmbake: debug: shown\n");
  log::init(0, log::Format::text);
}

TEST(Log, AMessageClearsTheBarFirst) {
  testing::internal::CaptureStderr();
  log::draw_bar("50 %");
  log::info("x");
  log::info("y");
  log::draw_bar("");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "\r\033[K50 %\r\033[Krnmbake: x\nrnmbake: y\n");
}

TEST(LogEvent, HasItsFieldsInJsonAndItsMessageInText) {
  const log::Fields fields{{"title", std::string("a \"b\"")},
                           {"step", std::int64_t{3}},
                           {"share", 0.25},
                           {"seconds_left", std::numeric_limits<double>::quiet_NaN()}};
  EXPECT_EQ(log::format_event(log::Format::text, log::Level::info, "step", "step 3", fields, false),
            "rnmbake: step 3");
  const auto line = nlohmann::json::parse(
      log::format_event(log::Format::jsonl, log::Level::warning, "step", "step 3", fields, false));
  EXPECT_EQ(line.at("event"), "step");
  EXPECT_EQ(line.at("level"), "warning");
  EXPECT_EQ(line.at("message"), "step 3");
  EXPECT_EQ(line.at("title"), "a \"b\"");
  EXPECT_EQ(line.at("step"), 3);
  EXPECT_EQ(line.at("share"), 0.25);
  EXPECT_TRUE(line.at("seconds_left").is_null());
}

}  // namespace
}  // namespace rnmbake
