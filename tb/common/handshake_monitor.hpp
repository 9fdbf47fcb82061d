/// The law of a link, watched at the sink: what is offered stays, unchanged, until it is taken.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "failure.hpp"

namespace halfspace::tb {

class HandshakeMonitor {
 public:
  explicit HandshakeMonitor(std::string link) : link_(std::move(link)) {}

  std::optional<Failure> cycle(std::uint64_t cycle, bool valid, bool ready,
                               std::span<const std::uint32_t> payload) {
    std::optional<Failure> failure;
    if (stalled_ && !valid) {
      failure = {FailureKind::kHandshake, cycle, link_ + ": valid withdrawn before ready"};
    } else if (stalled_ && !std::ranges::equal(payload_, payload)) {
      failure = {FailureKind::kHandshake, cycle, link_ + ": payload changed while stalled"};
    }
    stalled_ = valid && !ready;
    if (stalled_) {
      payload_.assign(payload.begin(), payload.end());
    }
    return failure;
  }

  void clear() { stalled_ = false; }

 private:
  std::string link_;
  bool stalled_ = false;
  std::vector<std::uint32_t> payload_;
};

}  // namespace halfspace::tb
