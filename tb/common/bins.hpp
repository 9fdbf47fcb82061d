/// Functional coverage: what the runs of a bench have met, counted in named bins.
#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <map>
#include <string>

namespace halfspace::tb {

class Bins {
 public:
  /// A bin that the runs must hit; the counter stays where it is.
  std::uint64_t* add(const std::string& name) { return &bins_[name]; }
  /// Counts in a bin, if there is one of that name.
  void hit(const std::string& name) {
    const auto bin = bins_.find(name);
    if (bin != bins_.end()) {
      ++bin->second;
    }
  }

  /// Prints how many bins were hit, and the names of those that were not; true when there are none.
  [[nodiscard]] bool report() const {
    std::size_t missed = 0;
    for (const auto& [name, hits] : bins_) {
      missed += hits == 0 ? 1 : 0;
    }
    fmt::print("functional coverage: {} of {} bins\n", bins_.size() - missed, bins_.size());
    for (const auto& [name, hits] : bins_) {
      if (hits == 0) {
        fmt::print("not covered: {}\n", name);
      }
    }
    return missed == 0;
  }

 private:
  std::map<std::string, std::uint64_t> bins_;
};

/// What there may be no bin for.
inline void count(std::uint64_t* bin) {
  if (bin != nullptr) {
    ++*bin;
  }
}

}  // namespace halfspace::tb
