#include "jobs/store.h"

#include "base/files.h"

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

TEST(Store, KeepsAResultUnderItsKey) {
  const TempFolder folder;
  Store store(folder.path() / "cache", 0);
  const ResultKey key = KeyMaker().add("samples", std::int64_t{64}).make("pass");
  EXPECT_EQ(store.get(key), std::nullopt);
  store.put(key, "pixels");
  EXPECT_EQ(Store(folder.path() / "cache", 0).get(key), "pixels");
  store.remove(key);
  EXPECT_FALSE(store.has(key));
}

TEST(KeyMaker, TellsListsApartThatReadAlike) {
  const ResultKey one = KeyMaker().add("a", "b").add("c", "d").make("pass");
  const ResultKey other = KeyMaker().add("a", "b\n1:c=1:d").make("pass");
  EXPECT_NE(one, other);
}

}  // namespace
}  // namespace rnmbake
