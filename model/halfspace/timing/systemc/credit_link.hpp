/// The FIFO between two stages, with credits: docs/timing.md, *Cycles and packets*.
///
/// A link works with time stamps. The producer asks from which cycle on it may use a credit, the consumer
/// from which cycle on it may take the packet at the head; each then waits for the latest of all it needs,
/// and acts once. Whatever one side does shows on the other in a later cycle only, so the order in which the
/// kernel runs the processes of a cycle decides nothing.
#pragma once

#include <deque>
#include <optional>
#include <stdexcept>
#include <string>
#include <systemc>
#include <utility>

#include "halfspace/timing/systemc/run_state.hpp"
#include "halfspace/timing/systemc/timed_signal.hpp"

namespace halfspace::systemc {

/// What the producer sees of a link.
template <class Token>
class CreditOut : virtual public sc_core::sc_interface {
 public:
  /// The first cycle in which `count` credits are free; suspends the calling thread until that is known.
  virtual Cycle credit(int count = 1) = 0;
  /// Uses a credit in this cycle.
  virtual void use_credit() = 0;
  /// Gives the packet for the oldest credit that has none; the work on it began in cycle `begun`.
  virtual void put(Token token, Cycle begun) = 0;
};

/// What the consumer sees of a link.
template <class Token>
class CreditIn : virtual public sc_core::sc_interface {
 public:
  /// The first cycle in which the packet at the head may be taken; suspends the calling thread until there is
  /// one.
  virtual Cycle visible() = 0;
  [[nodiscard]] virtual const Token& front() const = 0;
  /// Takes it in this cycle; its last beat leaves in cycle `leave`.
  virtual Token take(Cycle leave) = 0;
};

/// What does not depend on the token.
class CreditLinkBase {
 public:
  virtual ~CreditLinkBase() = default;
  virtual void begin_frame() = 0;
  virtual void end_frame(Cycle end) = 0;
  /// One line for people: what it holds, and what its head waits for.
  [[nodiscard]] virtual std::string describe() const = 0;
  [[nodiscard]] virtual const char* link_name() const = 0;
  void trace_on(TimedSignal* signal) { signal_ = signal; }

 protected:
  TimedSignal* signal_ = nullptr;  ///< credits in use; null where not traced
};

/// `capacity` credits; a packet can be seen `latency` cycles after the work on it began.
template <class Token>
class CreditLink : public sc_core::sc_prim_channel,
                   public CreditOut<Token>,
                   public CreditIn<Token>,
                   public CreditLinkBase {
 public:
  struct Options {
    int capacity = 1;
    int latency = 1;
    std::optional<Link> statistics;    ///< where its cycles are counted
    std::optional<StallPoint> stalls;  ///< where its packets are held back
  };

  CreditLink(const char* name, RunState& run, const Options& options)
      : sc_prim_channel(name), run_(run), options_(options) {}

  Cycle credit(int count) override {
    const std::size_t free = static_cast<std::size_t>(options_.capacity) - used_;
    const auto wanted = static_cast<std::size_t>(count);
    if (wanted <= free) {
      return 0;
    }
    while (returns_.size() < wanted - free) {
      wait(returned_);
    }
    return returns_[wanted - free - 1];
  }

  void use_credit() override {
    const Cycle now = run_.clock.now();
    settle(now);
    if (used_ == static_cast<std::size_t>(options_.capacity)) {
      throw std::logic_error(std::string(name()) + ": no credit");
    }
    count_to(now);
    ++used_;
    begun_.push_back(now);
    if (signal_ != nullptr) {
      signal_->add(now, 1);
    }
  }

  void put(Token token, Cycle begun) override {
    const Cycle held_back = options_.stalls ? run_.stalls.cycles(*options_.stalls, packets_) : 0;
    ++packets_;
    queue_.push_back({std::move(token), begun + static_cast<Cycle>(options_.latency) + held_back});
    arrived_.notify();
  }

  Cycle visible() override {
    while (queue_.empty()) {
      wait(arrived_);
    }
    return queue_.front().visible;
  }

  [[nodiscard]] const Token& front() const override { return queue_.front().token; }

  Token take(Cycle leave) override {
    Token token = std::move(queue_.front().token);
    queue_.pop_front();
    if (options_.statistics) {
      count_packet(token.work, leave + 1 - begun_.front());
    }
    begun_.pop_front();
    returns_.push_back(leave + 1);
    returned_.notify();
    if (signal_ != nullptr) {
      signal_->add(leave + 1, -1);
    }
    return token;
  }

  void begin_frame() override {
    counted_ = 0;
    packets_ = 0;
    occupancy_.assign(static_cast<std::size_t>(options_.capacity) + 1, 0);
  }

  void end_frame(Cycle end) override {
    settle(end);
    count_to(end);
    if (options_.statistics) {
      run_.cycles.stats.occupancy[static_cast<std::size_t>(*options_.statistics)] = occupancy_;
    }
  }

  [[nodiscard]] std::string describe() const override {
    std::size_t held = used_;
    for (std::size_t i = 0; i < returns_.size() && returns_[i] <= run_.clock.now(); ++i) {
      --held;
    }
    std::string text = std::to_string(held) + " of " + std::to_string(options_.capacity) + " in use, ";
    if (!queue_.empty()) {
      return text + "the head may be taken from cycle " + std::to_string(queue_.front().visible) + " on";
    }
    if (held != 0) {
      return text + "the head is under way since cycle " +
             std::to_string(begun_.empty() ? 0 : begun_.front());
    }
    return text + "empty";
  }

  [[nodiscard]] const char* link_name() const override { return basename(); }

 private:
  struct Entry {
    Token token;
    Cycle visible;
  };

  /// Returns of credits are noted ahead of their time; here those up to `now` happen.
  void settle(Cycle now) {
    while (!returns_.empty() && returns_.front() <= now) {
      count_to(returns_.front());
      --used_;
      returns_.pop_front();
    }
  }

  void count_to(Cycle cycle) {
    occupancy_[used_] += cycle - counted_;
    counted_ = cycle;
  }

  void count_packet(DrawWork* work, Cycle held) {
    const auto link = static_cast<std::size_t>(*options_.statistics);
    const auto count = [&](CycleStats& stats) {
      ++stats.packets[link];
      stats.held[link] += held;
    };
    count(run_.cycles.stats);
    if (CycleStats* const of_draw = work->stats()) {
      count(*of_draw);
    }
  }

  RunState& run_;
  Options options_;
  std::deque<Entry> queue_;
  std::size_t used_ = 0;       ///< credits, as of the last packet that used one
  std::deque<Cycle> begun_;    ///< when each credit in use was taken, until its packet is
  std::deque<Cycle> returns_;  ///< cycles from which credits of packets that were taken are free again
  sc_core::sc_event arrived_{sc_core::sc_gen_unique_name("arrived")};
  sc_core::sc_event returned_{sc_core::sc_gen_unique_name("returned")};
  Occupancy occupancy_;
  Cycle counted_ = 0;  ///< occupancy_ holds the cycles before this one
  std::uint64_t packets_ = 0;
};

}  // namespace halfspace::systemc
