#include "sampling/splitmix64.h"

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

/// The first numbers that the authors' program prints for this seed.
TEST(SplitMix64Test, TheSequenceIsThePublishedOne) {
  SplitMix64 random(1234567);
  for (const std::uint64_t expected :
       {6457827717110365317ULL, 3203168211198807973ULL, 9817491932198370423ULL, 4593380528125082431ULL}) {
    EXPECT_EQ(random.next(), expected);
  }
}

TEST(SplitMix64Test, AHashIsANumberOfTheSequence) {
  SplitMix64 random(42);
  for (std::uint64_t i = 0; i < 4; ++i) EXPECT_EQ(random.next(), hash_of(42, i));
}

}  // namespace
}  // namespace rnmbake
