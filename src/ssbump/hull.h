// ssbump/hull.h - the upper convex hulls of some lines of heights, side by side.
//
// Along a line only the points on the upper hull of all that lies ahead can be the horizon of anything behind
// them (Timonen and Westerholm, "Scalable Height Field Self-Shadowing", Eurographics 2010). Each lane has a
// stack of its own; row k holds vertex k of all of them, farthest first, with the slope of the edge from
// vertex k back to vertex k - 1. Who looks from behind sees the last vertex whose edge passes over his head.
#pragma once

#include "ssbump/horizon_vector.h"

#include <vector>

namespace rnmbake {

/// The memory of hulls, kept from one to the next.
using HullStorage = std::vector<float>;

template <int Width>
class Hull {
 public:
  using L = Lanes<Width>;
  using Float = typename L::Float;
  using Int = typename L::Int;

  RNM_LANES explicit Hull(HullStorage& storage) : storage_(storage) {
    if (storage_.empty()) grow();
    rows_ = storage_.data();
    Row sentinel;
    L::set(sentinel.at, 1e7F);
    L::set(sentinel.height, no_height);
    L::set(sentinel.edge, no_height);
    write(0, sentinel);
  }

  /// Adds a point to each lane `ahead` of `place` and finds the slope to the horizon from `place` at `eye`,
  /// in heights for one step. Places decrease from call to call.
  RNM_LANES void push_and_look(Float& slope, float place, const Float& eye, float ahead,
                               const Float& height) {
    const int first = first_row(place, ahead, eye, height);
    Row row;
    read(row, first);
    Float seen_at = row.at, seen = row.height, under_at = row.at, under = row.height;
    Int under_row;
    L::set(under_row, first);
    for (int k = first + 1; k <= top_; ++k) {
      read(row, k);
      const Float here = row.height + row.edge * (place - row.at), there = here + row.edge * ahead;
      seen_at = here > eye ? row.at : seen_at;
      seen = here > eye ? row.height : seen;
      under_at = there > height ? row.at : under_at;
      under = there > height ? row.height : under;
      under_row = there > height ? k - Int{} : under_row;
    }
    slope = (seen - eye) / (seen_at - place);
    L::keep_larger(slope, (height - eye) * (1 / ahead));
    put(under_row, place + ahead, height, under_at, under);
  }

  /// Adds a point to each lane.
  RNM_LANES void push(float place, const Float& height) {
    const int first = first_row(place, 0, height, height);
    Row row;
    read(row, first);
    Float under_at = row.at, under = row.height;
    Int under_row;
    L::set(under_row, first);
    for (int k = first + 1; k <= top_; ++k) {
      read(row, k);
      const Float there = row.height + row.edge * (place - row.at);
      under_at = there > height ? row.at : under_at;
      under = there > height ? row.height : under;
      under_row = there > height ? k - Int{} : under_row;
    }
    put(under_row, place, height, under_at, under);
  }

 private:
  struct Row {
    Float at, height, edge;
  };
  static constexpr int row_floats = 3 * Width;

  RNM_LANES void read(Row& row, int k) const { std::memcpy(&row, rows_ + k * row_floats, sizeof row); }
  RNM_LANES void write(int k, const Row& row) { std::memcpy(rows_ + k * row_floats, &row, sizeof row); }

  /// A row whose edges pass over everybody, so that the search may begin there: hulls of round things are
  /// deep.
  RNM_LANES int first_row(float place, float ahead, const Float& eye, const Float& height) const {
    for (int back = 8; back < top_; back *= 2) {
      Row row;
      read(row, top_ - back);
      const Float here = row.height + row.edge * (place - row.at), there = here + row.edge * ahead;
      Float least = here - eye;
      least = there - height < least ? there - height : least;
      if (!L::any_not_above(least, 0)) return top_ - back;
    }
    return 0;
  }

  /// The new vertices stand on `under_row`; what was above is gone.
  RNM_LANES void put(const Int& under_row, float place, const Float& height, const Float& under_at,
                     const Float& under_height) {
    const int lowest = L::smallest(under_row) + 1, highest = L::largest(under_row) + 1;
    if (static_cast<std::size_t>((highest + 1) * row_floats) > storage_.size()) {
      grow();
      rows_ = storage_.data();
    }
    const Float edge = (under_height - height) / (under_at - place);
    for (int k = lowest; k <= highest; ++k) {
      Row row;
      read(row, k);
      Int under;
      L::set(under, k - 1);
      row.at = under_row == under ? place - Float{} : row.at;
      row.edge = under_row < under ? Float{} : row.edge;
      row.edge = under_row == under ? edge : row.edge;
      row.height = under_row < under ? no_height - Float{} : row.height;
      row.height = under_row == under ? height : row.height;
      write(k, row);
    }
    top_ = highest;
  }

  __attribute__((noinline)) void grow() { storage_.resize(storage_.empty() ? 4096 : 2 * storage_.size()); }

  HullStorage& storage_;
  float* rows_ = nullptr;
  int top_ = 0;
};

}  // namespace rnmbake
