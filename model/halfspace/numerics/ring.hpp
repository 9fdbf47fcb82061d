/// A bounded queue from one thread to another, in memory that is used again and again.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>

namespace halfspace {

/// One thread fills items, another takes them, in the same order. An item keeps its memory: one that holds as
/// much as the one in its place before allocates nothing. A thread that has none to go on with sleeps
/// until half of them are: to wake it costs more than most items.
template <class Item, std::uint32_t kItems>
class Ring {
 public:
  /// For the thread that fills: the next item, once it is free.
  Item& free() {
    for (std::uint32_t taken = taken_; filled_ - taken == kItems; taken = taken_) {
      taken_.wait(taken);
    }
    return items_[filled_ % kItems];
  }
  /// It is filled. `last`: there may be no other, so that nobody may sleep.
  void fill(bool last) {
    if (++filled_ % kHalf == 0 || last) {
      filled_.notify_one();
    }
  }

  /// For the thread that takes: the next item, once it is filled.
  Item& filled() {
    filled_.wait(taken_);
    return items_[taken_ % kItems];
  }
  /// It is free again.
  void take() {
    if (++taken_ % kHalf == 0) {
      taken_.notify_one();
    }
  }

 private:
  static constexpr std::uint32_t kHalf = kItems / 2;
  /// Bytes that processors hand to each other: a pair of lines.
  static constexpr std::size_t kLine = 128;

  std::array<Item, kItems> items_{};
  alignas(kLine) std::atomic<std::uint32_t> filled_ = 0;  ///< items so far
  alignas(kLine) std::atomic<std::uint32_t> taken_ = 0;
};

}  // namespace halfspace
