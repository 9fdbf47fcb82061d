#include "z_codec/codec_link.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

namespace halfspace::tb {

void CodecLink::expect(std::uint64_t cycle, const std::vector<std::uint32_t>& packet) {
  due_.push_back(cycle + static_cast<std::uint64_t>(latency_));
  scoreboard_.expect(packet);
  ++expected_;
}

std::optional<Failure> CodecLink::step(std::uint64_t cycle, bool valid, std::vector<std::uint32_t> packet) {
  valid = inject(valid, packet);
  const bool due = !due_.empty() && due_.front() == cycle;
  if (due) {
    due_.pop_front();
  }
  if (checks_.timing && valid != due) {
    return Failure{
        FailureKind::kTiming, cycle,
        due ? fmt::format("{}: packet {} should be valid, {} cycles after it was taken", name_,
                          scoreboard_.received(), latency_)
            : fmt::format("{}: valid with nothing due, before packet {}", name_, scoreboard_.received())};
  }
  if (checks_.packets && valid) {
    if (std::optional<Failure> failure = scoreboard_.receive(cycle, packet)) {
      return named(std::move(*failure));
    }
  }
  return std::nullopt;
}

std::optional<Failure> CodecLink::finish(std::uint64_t cycle) const {
  if (checks_.packets) {
    if (std::optional<Failure> failure = scoreboard_.finish(cycle)) {
      return named(std::move(*failure));
    }
  }
  return std::nullopt;
}

void CodecLink::clear() {
  scoreboard_.clear();
  due_.clear();
}

Failure CodecLink::named(Failure failure) const {
  failure.message = name_ + ": " + failure.message;
  return failure;
}

bool CodecLink::inject(bool valid, std::vector<std::uint32_t>& packet) {
  const bool here = valid && came_ == checks_.fault_packet;
  came_ += valid ? 1 : 0;
  switch (checks_.fault) {
    case CodecFault::kFlipBit:
      packet.front() ^= here ? 1u : 0u;
      return valid;
    case CodecFault::kFlipTop:
      packet.back() ^= here ? 1u << (last_width_ - 1) : 0u;
      return valid;
    case CodecFault::kDrop:
      return valid && !here;
    case CodecFault::kSwap:
    case CodecFault::kDuplicate:
      if (valid) {
        held_.push_back(packet);
        if (came_ == checks_.fault_packet + 2 && checks_.fault == CodecFault::kSwap) {
          std::iter_swap(held_.end() - 1, held_.end() - 2);
        }
        if (here && checks_.fault == CodecFault::kDuplicate) {
          held_.push_back(packet);
        }
      }
      return take_held(packet, came_ != checks_.fault_packet + 1 || checks_.fault != CodecFault::kSwap);
    case CodecFault::kLate: {
      const bool was = !held_.empty();
      if (valid) {
        held_.push_back(packet);
      }
      return take_held(packet, was);
    }
    case CodecFault::kExtra:
      return valid || (came_ == checks_.fault_packet && !std::exchange(done_, true));
    default:
      return valid;
  }
}

bool CodecLink::take_held(std::vector<std::uint32_t>& packet, bool now) {
  if (held_.empty() || !now) {
    return false;
  }
  packet = std::move(held_.front());
  held_.pop_front();
  return true;
}

std::optional<CodecFault> codec_fault_by_name(const std::string& name) {
  static constexpr std::array<std::pair<const char*, CodecFault>, 10> kFaults = {
      {{"none", CodecFault::kNone},
       {"flip-bit", CodecFault::kFlipBit},
       {"flip-top", CodecFault::kFlipTop},
       {"drop", CodecFault::kDrop},
       {"swap", CodecFault::kSwap},
       {"duplicate", CodecFault::kDuplicate},
       {"late", CodecFault::kLate},
       {"extra", CodecFault::kExtra},
       {"other-format", CodecFault::kOtherFormat},
       {"other-shift", CodecFault::kOtherShift}}};
  const auto found = std::ranges::find_if(kFaults, [&](const auto& fault) { return name == fault.first; });
  return found == kFaults.end() ? std::nullopt : std::optional(found->second);
}

}  // namespace halfspace::tb
