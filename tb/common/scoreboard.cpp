#include "scoreboard.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "halfspace/units/field_text.hpp"

namespace halfspace::tb {
namespace {

bool same(std::span<const std::uint32_t> a, std::span<const std::uint32_t> b) {
  return std::ranges::equal(a, b);
}

}  // namespace

std::string Scoreboard::first_difference(const Words& expected, std::span<const std::uint32_t> got) const {
  const std::string text = halfspace::first_difference(fields_, "expected", expected, "got", got);
  return text.empty() ? "bits above the last field differ" : text;
}

Failure Scoreboard::missing() const {
  return {
      FailureKind::kMissing, skipped_->cycle,
      fmt::format("packet {} is missing: packet {} came in its place", skipped_->index, skipped_->index + 1)};
}

std::optional<Failure> Scoreboard::receive(std::uint64_t cycle, std::span<const std::uint32_t> packet) {
  if (skipped_) {
    if (same(skipped_->packet, packet)) {
      return Failure{
          FailureKind::kOrder, cycle,
          fmt::format("packets {} and {} came in swapped order", skipped_->index, skipped_->index + 1)};
    }
    return missing();
  }
  const std::uint64_t index = received_++;
  if (!expected_.empty() && same(expected_.front(), packet)) {
    last_ = std::move(expected_.front());
    expected_.pop_front();
    return std::nullopt;
  }
  if (!last_.empty() && same(last_, packet)) {
    return Failure{FailureKind::kExtra, cycle, fmt::format("packet {} came a second time", index - 1)};
  }
  if (expected_.empty()) {
    return Failure{FailureKind::kExtra, cycle, fmt::format("packet {} came, but none is expected", index)};
  }
  if (expected_.size() > 1 && same(expected_[1], packet)) {
    skipped_ = Skipped{std::move(expected_.front()), index, cycle};
    expected_.pop_front();
    expected_.pop_front();
    return std::nullopt;
  }
  return Failure{FailureKind::kPayload, cycle,
                 fmt::format("packet {}, {}", index, first_difference(expected_.front(), packet))};
}

std::optional<Failure> Scoreboard::finish(std::uint64_t cycle) const {
  if (skipped_) {
    return missing();
  }
  if (!expected_.empty()) {
    return Failure{FailureKind::kMissing, cycle,
                   fmt::format("packet {} is missing: {} of the packets expected never came", received_,
                               expected_.size())};
  }
  return std::nullopt;
}

}  // namespace halfspace::tb
