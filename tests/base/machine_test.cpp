#include "base/machine.h"

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

TEST(Machine, HasMemoryOfWhichSomeIsUsable) {
  EXPECT_GT(machine_memory(), std::uint64_t{1} << 20);
  EXPECT_GT(usable_memory(), 0U);
  EXPECT_LE(usable_memory(), machine_memory());
  if (memory_limit() > 0) {
    EXPECT_LE(usable_memory(), memory_limit());
  }
}

}  // namespace
}  // namespace rnmbake
