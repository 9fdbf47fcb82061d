/// Independent pieces of work on several threads.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace halfspace {

/// Calls work(i) for every i below `count`, in any order, on up to `threads` threads, the caller's included,
/// and returns when all is done. Where some throw, no more are begun, and the exception of the least of them
/// reaches the caller: the one that a loop would throw.
template <class Work>
void parallel_for(std::size_t count, int threads, const Work& work) {
  std::atomic<std::size_t> next = 0;
  std::mutex mutex;
  std::size_t failed = count;  ///< the least that threw
  std::exception_ptr error;
  const auto take_turns = [&] {
    for (std::size_t i = next++; i < count; i = next++) {
      try {
        work(i);
      } catch (...) {
        next = count;
        const std::lock_guard lock(mutex);
        if (i < failed) {
          failed = i;
          error = std::current_exception();
        }
      }
    }
  };
  {
    std::vector<std::jthread> others;
    for (std::size_t n = 1; n < std::min(static_cast<std::size_t>(threads), count); ++n) {
      others.emplace_back(take_turns);
    }
    take_turns();
  }
  if (error) {
    std::rethrow_exception(error);
  }
}

}  // namespace halfspace
