#include "hi_z/hi_z_timing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>

#include "halfspace/machine/shape.hpp"
#include "halfspace/timing/contract.hpp"

namespace halfspace::tb {
namespace {

constexpr std::uint64_t kRejectLatency = 4;       // a block that is rejected is in the unit so long
constexpr std::uint64_t kSlotLatency = 5;         // to the triangle's slot
constexpr std::int64_t kUnknown = kHiZUndecided;  // blocks of which it is not known yet whether they leave
constexpr std::size_t kRemembered = 4;
constexpr std::uint8_t kBusy = 0;
constexpr std::uint8_t kNoBlock = 1;
constexpr std::uint8_t kNoUpdate = 2;
constexpr std::uint8_t kNoCredit = 3;

}  // namespace

std::optional<Failure> HiZTiming::cycle(std::uint64_t cycle, const HiZCommand* command, bool left_ready,
                                        const HiZInputs& in, const HiZOutputs& out, bool left_valid) {
  const auto timing = [cycle](std::string message) {
    return Failure{FailureKind::kTiming, cycle, std::move(message)};
  };
  const bool idle = blocks_in_ == 0 && !(in.drain && (applied_ < jobs_.size() || has_applied_));
  const bool drains = in.drain && blocks_in_ == 0;
  const std::uint64_t target = must_see();
  const bool seen = applied_ >= target;
  const std::int64_t held = static_cast<std::int64_t>(passed_before_.front() - left_);
  const bool slot = held + kUnknown < shape_.fifo;
  const bool ready = slot && seen;
  if (out.block_ready != ready) {
    return timing(
        fmt::format("input ready is {:d}, with {} of {} slots in use and {} jobs applied of {} that the next "
                    "block must see it should be {:d}",
                    out.block_ready, held + kUnknown, shape_.fifo, applied_, target, ready));
  }
  const bool visible = !visible_at_.empty() && visible_at_.front() <= cycle;
  if (left_valid != visible) {
    return timing(
        visible ? fmt::format("packet {} should be valid since cycle {}", left_, visible_at_.front())
        : visible_at_.empty() ? fmt::format("output valid with nothing under way after packet {}", left_)
                              : fmt::format("packet {} valid before cycle {}", left_, visible_at_.front()));
  }
  const bool takes = command != nullptr && ready;
  const std::uint8_t activity = takes ? kBusy : command == nullptr ? kNoBlock : !seen ? kNoUpdate : kNoCredit;
  if (out.activity != activity) {
    return timing(fmt::format("activity is {}, it should be {}", out.activity, activity));
  }
  if (out.idle != idle) {
    return timing(fmt::format("idle is {:d}, with {} blocks in it and {} jobs not applied it should be {:d}",
                              out.idle, blocks_in_, jobs_.size() - applied_, idle));
  }
  if (std::optional<Failure> failure = compare_slot(cycle, out)) {
    return failure;
  }
  if (command != nullptr && !ready) {
    coverage_.hit(!seen ? (slot ? "waits for updates" : "waits for updates and a slot") : "waits for a slot");
    waited_ = true;
  }
  if (takes) {
    if (waited_) {
      coverage_.hit("taken after a wait");
    }
    waited_ = false;
    take(cycle, *command);
  }
  // A job that the next block must see, whether this one is taken or not.
  const bool may = applied_ < (drains ? jobs_.size() : must_see());
  has_applied_ = may && applied_ < ready_at_.size() && ready_at_[applied_] <= cycle;
  if (has_applied_) {
    apply(cycle);
  }
  while (!rejected_at_.empty() && rejected_at_.front() <= cycle) {
    rejected_at_.pop_front();
    --blocks_in_;
  }
  if (left_valid && left_ready) {
    visible_at_.pop_front();
    --blocks_in_;
    ++left_;
  }
  return std::nullopt;
}

std::optional<Failure> HiZTiming::compare_slot(std::uint64_t cycle, const HiZOutputs& out) {
  const bool due = !kept_at_.empty() && kept_at_.front().cycle == cycle;
  if (out.slot_write != due) {
    return Failure{FailureKind::kTiming, cycle,
                   fmt::format("slot write is {:d}, it should be {:d}", out.slot_write, due)};
  }
  if (!due) {
    return std::nullopt;
  }
  const Kept kept = kept_at_.front();
  kept_at_.pop_front();
  if (out.slot != kept.slot) {
    return Failure{FailureKind::kPayload, cycle,
                   fmt::format("slot {} is written, it should be slot {}", out.slot, kept.slot)};
  }
  const HiZTriangleWords& triangle = workload_.triangles[kept.triangle];
  if (out.equation != triangle.equation || out.state != triangle.state) {
    return Failure{
        FailureKind::kPayload, cycle,
        fmt::format("slot {}: not the equation and state of triangle {}", kept.slot, kept.triangle)};
  }
  return std::nullopt;
}

std::uint64_t HiZTiming::must_see() const {
  return hi_z_must_see(jobs_before_.front(), static_cast<std::uint64_t>(shape_.lag), seen_);
}

void HiZTiming::take(std::uint64_t cycle, const HiZCommand& command) {
  static constexpr std::array<const char*, 8> kFunctions = {"NEVER",   "LESS",     "EQUAL",  "LEQUAL",
                                                            "GREATER", "NOTEQUAL", "GEQUAL", "ALWAYS"};
  seen_ = applied_;
  ++blocks_in_;
  const bool rejected = command.rejected == command.tiles;
  if (rejected) {
    rejected_at_.push_back(cycle + kRejectLatency);
  } else {
    visible_at_.push_back(cycle + kHiZLatency);
    ++passed_;
    if (command.gets_slot) {
      kept_at_.push_back({cycle + kSlotLatency, command.triangle, command.slot});
    }
  }
  cover_slot(command, rejected);
  // Coverage.
  const char* const outcome = rejected ? "all" : command.rejected != 0 ? "some" : "none";
  if (!command.state.test) {
    coverage_.hit("block without a test");
  } else {
    const State state = states_[command.number];
    coverage_.hit(fmt::format("block of {}, {} of its tiles rejected",
                              kFunctions[static_cast<std::size_t>(command.state.func)], outcome));
    coverage_.hit(fmt::format("block of {}, {} of its tiles sure",
                              kFunctions[static_cast<std::size_t>(command.state.func)],
                              command.sure == command.tiles ? "all"
                              : command.sure != 0           ? "some"
                                                            : "none"));
    coverage_.hit(fmt::format("block of a word {}, {} of its tiles rejected",
                              state == State::kUnknown   ? "unknown"
                              : state == State::kCleared ? "cleared"
                                                         : "stored",
                              outcome));
    coverage_.hit(fmt::format("block of format {}, {} plane, {} of its tiles rejected",
                              static_cast<int>(command.state.format), command.plane ? "with a" : "without a",
                              outcome));
    for (const Event& event : applies_) {
      for (std::uint64_t before = 1; before <= 3; ++before) {
        if (event.cycle + before == cycle && event.number == command.number) {
          coverage_.hit(fmt::format("block taken {} after a job of the same block", before));
        }
      }
    }
    for (const Event& event : blocks_) {
      for (std::uint64_t before = 1; before <= 4; ++before) {
        if (event.cycle + before == cycle && event.number == command.number) {
          coverage_.hit(fmt::format("block {} after itself", before));
        }
      }
    }
    bool up = false;
    bool down = false;
    for (std::uint64_t i = applied_; i < jobs_.size(); ++i) {
      up |= jobs_[i].number == command.number && jobs_[i].moves.up;
      down |= jobs_[i].number == command.number && jobs_[i].moves.down;
    }
    coverage_.hit(fmt::format("jobs in flight in the same block: {}", up && down ? "both"
                                                                      : up       ? "raise"
                                                                      : down     ? "lower"
                                                                                 : "none"));
  }
  blocks_.push_front({cycle, command.number});
  blocks_.resize(std::min(blocks_.size(), kRemembered));
  for (const HiZJob& job : command.jobs) {
    jobs_.push_back({command.number, job.tile, command.moves, job.update, command.clear_code});
  }
  jobs_before_.push_back(jobs_.size());
  jobs_before_.pop_front();
  passed_before_.push_back(passed_);
  passed_before_.pop_front();
}

void HiZTiming::cover_slot(const HiZCommand& command, bool rejected) {
  if (command.triangle != triangle_) {
    if (triangle_blocks_ != 0 && triangle_left_ == 0) {
      coverage_.hit("triangle of which nothing is left");
    }
    triangle_ = command.triangle;
    triangle_blocks_ = triangle_left_ = 0;
  }
  if (!rejected) {
    if (triangle_left_ == 1) {
      coverage_.hit("triangle of which several blocks leave");
    } else if (triangle_left_ == 0 && triangle_blocks_ != 0) {
      coverage_.hit("triangle whose first block is rejected, and a later one leaves");
    }
    if (command.gets_slot && command.slot == std::numeric_limits<std::uint8_t>::max()) {
      coverage_.hit("last slot");
    }
    ++triangle_left_;
  }
  ++triangle_blocks_;
}

/// What becomes of the word, and how close it is to what is done before.
void HiZTiming::apply(std::uint64_t cycle) {
  const Job& job = jobs_[applied_++];
  State& state = states_[job.number];
  HiZWord& word = words_[job.number];
  const auto parts = static_cast<std::size_t>(shape_.widths.ZParts);
  if (job.update.touched != 0) {
    coverage_.hit(fmt::format("job on a word {}", state == State::kUnknown   ? "unknown"
                                                  : state == State::kCleared ? "cleared"
                                                                             : "stored"));
    if (state == State::kUnknown) {
      word = unknown_word(shape_.entries(), shape_.bits);
    } else if (state == State::kCleared) {
      word = cleared_word(job.clear_code);
    }
    state = State::kStored;
    const HiZWord before = word;
    put_entries(word, shape_.entries(), job.tile * parts, job.update.touched, job.update.bounds, shape_.bits);
    coverage_.hit(word.shift > before.shift   ? "range grows"
                  : word.shift < before.shift ? "range shrinks"
                  : word.base != before.base  ? "range moves"
                                              : "range stays");
    coverage_.hit(fmt::format("job of {} parts", std::popcount(job.update.touched)));
    for (const Event& event : applies_) {
      for (std::uint64_t before = 1; before <= 4; ++before) {
        if (event.cycle + before == cycle && event.number == job.number) {
          coverage_.hit(fmt::format("job {} after one of the same block", before));
        }
      }
    }
    for (const Event& event : blocks_) {
      for (std::uint64_t before = 0; before <= 3; ++before) {
        if (event.cycle + before == cycle && event.number == job.number) {
          coverage_.hit(fmt::format("job {} after the same block", before));
        }
      }
    }
    applies_.push_front({cycle, job.number});
    applies_.resize(std::min(applies_.size(), kRemembered));
  } else {
    coverage_.hit("job without bounds");
  }
}

void HiZTiming::cleared(const HiZCommand& command) {
  seen_ = applied_;
  jobs_before_.assign(kHiZDepth, jobs_.size());
  passed_before_.assign(kHiZUndecided + 1, passed_);
  std::fill(states_.begin() + command.first, states_.begin() + command.last + 1, State::kCleared);
}

void HiZTiming::forget() {
  coverage_.hit(applied_ < jobs_.size() ? "end of a frame with jobs not applied" : "end of a frame");
  jobs_.clear();
  ready_at_.clear();
  applied_ = 0;
  seen_ = 0;
  jobs_before_.assign(kHiZDepth, 0);
  passed_before_.assign(kHiZUndecided + 1, passed_);
  words_.assign(static_cast<std::size_t>(shape_.memory_blocks), {});
  states_.assign(static_cast<std::size_t>(shape_.memory_blocks), State::kUnknown);
}

void HiZTiming::clear() {
  if (was_reset_) {
    coverage_.hit(blocks_in_ != 0 ? "reset with a block under way" : "reset without a block under way");
    coverage_.hit(applied_ < jobs_.size() ? "reset with jobs not applied" : "reset with all jobs applied");
  }
  passed_ = left_;
  forget();
  was_reset_ = true;
  waited_ = has_applied_ = false;
  blocks_in_ = 0;
  rejected_at_.clear();
  visible_at_.clear();
  kept_at_.clear();
  triangle_blocks_ = triangle_left_ = 0;
  blocks_.clear();
  applies_.clear();
}

}  // namespace halfspace::tb
