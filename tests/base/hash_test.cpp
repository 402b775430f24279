#include "base/hash.h"

#include "base/error.h"
#include "base/files.h"

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

TEST(Hash, IsXxh3) {
  EXPECT_EQ(hash64(""), 0x2D06800538D394C2u);  // the algorithm's published value for the empty input
  EXPECT_EQ(hash128_hex(""), "99aa06d3014798d86001c324468d497f");
  EXPECT_EQ(short_hash("").size(), 8u);
  EXPECT_NE(short_hash("a"), short_hash("b"));
}

TEST(Hash, OfAFileIsThatOfItsBytes) {
  const TempFolder folder;
  const std::string bytes(3'000'000, 'r');
  write_atomically(folder.path() / "a", bytes);
  write_atomically(folder.path() / "b", "");
  EXPECT_EQ(file_hash128_hex(folder.path() / "a"), hash128_hex(bytes));
  EXPECT_EQ(file_hash128_hex(folder.path() / "b"), hash128_hex(""));
  EXPECT_THROW((void)file_hash128_hex(folder.path() / "c"), Error);
}

}  // namespace
}  // namespace rnmbake
