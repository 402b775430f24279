// scene/disjoint_sets.h - union-find: which of n things hang together.
#pragma once

#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

namespace rnmbake {

class DisjointSets {
 public:
  explicit DisjointSets(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), std::uint32_t{0});
  }

  std::uint32_t find(std::uint32_t item) {
    while (parent_[item] != item) {
      parent_[item] = parent_[parent_[item]];
      item = parent_[item];
    }
    return item;
  }

  /// The smaller root wins, so that results do not depend on the order of the calls.
  void join(std::uint32_t a, std::uint32_t b) {
    a = find(a);
    b = find(b);
    parent_[a > b ? a : b] = a > b ? b : a;
  }

 private:
  std::vector<std::uint32_t> parent_;
};

}  // namespace rnmbake
