#include "base/json.h"

#include "base/error.h"

#include <string>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

std::string nested(std::size_t depth) {
  return std::string(depth, '[') + std::string(depth, ']');
}

TEST(Json, DepthIsLimitedBeforeAnythingRecurses) {
  EXPECT_TRUE(parse_json(nested(deepest_json), "a.json").is_array());
  EXPECT_TRUE(json_or_null(nested(100000)).is_null());
  try {
    (void)parse_json("{\"a\":" + nested(100000) + "}", "a.json");
    FAIL() << "it was read";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::invalid_input);
    EXPECT_EQ(std::string(error.what()).rfind("a.json: ", 0), 0U) << error.what();
  }
}

TEST(Json, BracketsInTextsDoNotCount) {
  const nlohmann::json value = parse_json(R"({"a": "[[\"[[\\"})", "a.json");
  EXPECT_EQ(value.at("a"), "[[\"[[\\");
  EXPECT_EQ(json_or_null("\"" + std::string(1000, '[') + "\"").get<std::string>().size(), 1000U);
}

TEST(Json, MessagesAreShort) {
  const std::string huge(1 << 20, 'x');
  try {
    (void)parse_json("[\"" + huge, "a.json");
    FAIL() << "it was read";
  } catch (const Error& error) {
    EXPECT_LT(std::string(error.what()).size(), 250U);
  }
  EXPECT_LT(brief(nlohmann::json(huge)).size(), 80U);
  EXPECT_EQ(brief(nlohmann::json{1, 2, 3}), "a list of 3");
  EXPECT_EQ(brief(nlohmann::json(7)), "7");
}

}  // namespace
}  // namespace rnmbake
