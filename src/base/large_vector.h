// base/large_vector.h - a vector whose memory lies in large pages where the system has them.
//
// Who walks over many rows of a picture at once soon needs more pages than a processor remembers.
#pragma once

#include <cstddef>
#include <cstdlib>
#include <new>
#include <vector>

#include <sys/mman.h>

namespace rnmbake {

template <typename T>
struct LargePages {
  using value_type = T;
  static constexpr std::size_t page = std::size_t{2} << 20;

  LargePages() = default;
  template <typename Other>
  explicit LargePages(const LargePages<Other>&) {}

  [[nodiscard]] static T* allocate(std::size_t count) {
    const std::size_t bytes = count * sizeof(T), whole = (bytes + page - 1) / page * page;
    void* const memory = bytes < page ? std::malloc(bytes) : std::aligned_alloc(page, whole);
    if (memory == nullptr) throw std::bad_alloc();
    if (bytes >= page) madvise(memory, whole, MADV_HUGEPAGE);  // a wish: without it all is only slower
    return static_cast<T*>(memory);
  }
  static void deallocate(T* memory, std::size_t) { std::free(memory); }

  friend bool operator==(const LargePages&, const LargePages&) { return true; }
};

template <typename T>
using LargeVector = std::vector<T, LargePages<T>>;

}  // namespace rnmbake
