#include "fault.hpp"

#include <array>
#include <utility>

namespace halfspace::tb {

std::optional<FaultKind> fault_by_name(const std::string& name) {
  static constexpr std::array<std::pair<const char*, FaultKind>, 12> kNames = {
      {{"none", FaultKind::kNone},
       {"flip-bit", FaultKind::kFlipBit},
       {"drop", FaultKind::kDrop},
       {"drop-last", FaultKind::kDropLast},
       {"swap", FaultKind::kSwap},
       {"duplicate", FaultKind::kDuplicate},
       {"extra", FaultKind::kExtra},
       {"early-valid", FaultKind::kEarlyValid},
       {"change-payload", FaultKind::kChangePayload},
       {"late", FaultKind::kLate},
       {"stuck", FaultKind::kStuck},
       {"source-change", FaultKind::kSourceChange}}};
  for (const auto& [known, kind] : kNames) {
    if (name == known) {
      return kind;
    }
  }
  return std::nullopt;
}

/// The copy takes the link; the device waits.
void FaultShim::show_copy(bool ready) {
  valid_ = true;
  payload_ = copy_;
  ready_ = false;
  copy_waits_ = !ready;
}

void FaultShim::step(bool valid, std::span<const std::uint32_t> payload, bool ready, bool draining) {
  valid_ = valid;
  payload_.assign(payload.begin(), payload.end());
  ready_ = ready;
  const bool here = valid && packet_ == at_;
  switch (kind_) {
    case FaultKind::kNone:
    case FaultKind::kSourceChange:
      break;
    case FaultKind::kFlipBit:
      if (here) {
        payload_[0] ^= 1;
      }
      break;
    case FaultKind::kDrop:
    case FaultKind::kDropLast:
      if (here || (kind_ == FaultKind::kDropLast && valid && packet_ > at_)) {
        valid_ = false;
        ready_ = true;
      }
      break;
    case FaultKind::kSwap:
      if (here) {
        copy_ = payload_;
        copy_waits_ = true;
        valid_ = false;
        ready_ = true;
      } else if (copy_waits_ && packet_ == at_ + 2) {
        show_copy(ready);
      }
      break;
    case FaultKind::kDuplicate:
      if (copy_waits_) {
        show_copy(ready);
      } else if (here && ready) {
        copy_ = payload_;
        copy_waits_ = true;
      }
      break;
    case FaultKind::kExtra:
      if (draining && !done_) {
        valid_ = true;
        done_ = ready;
      }
      break;
    case FaultKind::kEarlyValid:
      // Only while the sink stalls: a sink that is ready would take a wrong packet, which is another fault.
      if (!valid && packet_ >= at_ && !ready && !done_) {
        valid_ = true;
        done_ = true;
      }
      break;
    case FaultKind::kChangePayload:
      if (here && stalled_) {
        payload_[0] ^= 1;
      }
      break;
    case FaultKind::kLate:
      if (here && !done_) {
        valid_ = false;
        ready_ = false;
        done_ = true;
      }
      break;
    case FaultKind::kStuck:
      if (packet_ >= at_) {
        valid_ = false;
        ready_ = false;
      }
      break;
  }
  packet_ += valid && ready_ ? 1 : 0;
  stalled_ = valid_ && !ready;
}

}  // namespace halfspace::tb
