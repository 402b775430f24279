#include "jobs/key.h"

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

TEST(KeyMaker, TellsListsApartThatReadAlike) {
  const ResultKey one = KeyMaker().add("a", "b").add("c", "d").make("pass");
  const ResultKey other = KeyMaker().add("a", "b\n1:c=1:d").make("pass");
  EXPECT_NE(one, other);
}

TEST(KeyMaker, TakesNamesOfFoldersAsKindsOnly) {
  EXPECT_TRUE(is_result_kind("pass"));
  EXPECT_TRUE(is_result_kind("lambert-scene"));
  for (const char* kind : {"", "-pass", "Pass", "a/b", "..", "pass2", "a-kind-that-is-too-long"}) {
    EXPECT_FALSE(is_result_kind(kind)) << kind;
    EXPECT_THROW((void)KeyMaker().make(kind), std::invalid_argument) << kind;
  }
}

}  // namespace
}  // namespace rnmbake
