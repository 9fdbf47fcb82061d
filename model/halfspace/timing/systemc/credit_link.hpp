/// The FIFO between two stages, with credits: docs/timing.md, *Cycles and packets*.
///
/// A link works with time stamps. The producer asks from which cycle on it may use a credit, the consumer
/// from which cycle on it may take the packet at the head; each then waits for the latest of all it needs,
/// and acts once. Whatever one side does shows on the other in a later cycle only, so the order in which the
/// kernel runs the processes of a cycle decides nothing. A side that has to wait for the other one is run in
/// the cycle from which on it may act, not in that in which the other one acts.
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
  void trace_on(TimedSignal* signal) { signal_ = signal; }

 protected:
  TimedSignal* signal_ = nullptr;  ///< credits in use; null where not traced
};

/// A FIFO of the machine's shape. A packet can be seen the link's latency after the work on it began, or the
/// cycle after it for a buffer, and later where it is held back.
template <class Token>
class CreditLink : public sc_core::sc_prim_channel,
                   public CreditOut<Token>,
                   public CreditIn<Token>,
                   public CreditLinkBase {
 public:
  CreditLink(RunState& run, Fifo fifo)
      : sc_prim_channel((std::string(kFifoName[static_cast<std::size_t>(fifo)]) + "_fifo").c_str()),
        run_(run),
        fifo_(static_cast<std::size_t>(fifo)),
        capacity_(static_cast<std::size_t>(capacities(run.config)[fifo_])),
        latency_(static_cast<Cycle>(fifo_ < kLinks ? latency(static_cast<Link>(fifo), run.config) : 1)),
        stalls_(fifo_ < kLinks ? kHeldBackAt[fifo_] : std::nullopt) {
    run.fifos[fifo_] = this;
  }

  Cycle credit(int count) override {
    const std::size_t free = capacity_ - used_;
    const auto wanted = static_cast<std::size_t>(count);
    if (wanted <= free) {
      return 0;
    }
    const std::size_t missing = wanted - free;
    while (returns_.size() < missing) {
      awaited_ = missing;
      run_.clock.wait_for(returned_);
    }
    return returns_[missing - 1];
  }

  void use_credit() override {
    const Cycle now = run_.clock.now();
    settle(now);
    if (used_ == capacity_) {
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
    const Cycle held_back = stalls_ ? run_.stalls.cycles(*stalls_, packets_) : 0;
    ++packets_;
    queue_.push_back({std::move(token), begun + latency_ + held_back});
    if (std::exchange(waits_, false)) {
      arrived_.notify(run_.clock.time_until(queue_.front().visible));
    }
  }

  Cycle visible() override {
    while (queue_.empty()) {
      waits_ = true;
      run_.clock.wait_for(arrived_);
    }
    return queue_.front().visible;
  }

  [[nodiscard]] const Token& front() const override { return queue_.front().token; }

  Token take(Cycle leave) override {
    Token token = std::move(queue_.front().token);
    queue_.pop_front();
    if (fifo_ < kLinks) {
      count_packet(token.draw, leave + 1 - begun_.front());
    }
    begun_.pop_front();
    returns_.push_back(leave + 1);
    if (returns_.size() == awaited_) {
      awaited_ = 0;
      returned_.notify(run_.clock.time_until(leave + 1));
    }
    if (signal_ != nullptr) {
      signal_->add(leave + 1, -1);
    }
    return token;
  }

  void begin_frame() override {
    counted_ = 0;
    packets_ = 0;
    occupancy_.assign(capacity_ + 1, 0);
  }

  void end_frame(Cycle end) override {
    settle(end);
    count_to(end);
    if (fifo_ < kLinks) {
      run_.book.frame().occupancy[fifo_] = occupancy_;
    }
  }

  [[nodiscard]] std::string describe() const override {
    std::size_t held = used_;
    for (std::size_t i = 0; i < returns_.size() && returns_[i] <= run_.clock.now(); ++i) {
      --held;
    }
    std::string text = std::to_string(held) + " of " + std::to_string(capacity_) + " in use, ";
    if (!queue_.empty()) {
      return text + "the head may be taken from cycle " + std::to_string(queue_.front().visible) + " on";
    }
    if (held != 0) {
      return text + "the head is under way since cycle " +
             std::to_string(begun_.empty() ? 0 : begun_.front());
    }
    return text + "empty";
  }

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

  void count_packet(const DrawContext* draw, Cycle held) {
    run_.book.count(draw, [&](CycleStats& stats) {
      ++stats.packets[fifo_];
      stats.held[fifo_] += held;
    });
  }

  RunState& run_;
  std::size_t fifo_;  ///< position in the table of FIFOs
  std::size_t capacity_;
  Cycle latency_;
  std::optional<StallPoint> stalls_;
  std::deque<Entry> queue_;
  std::size_t used_ = 0;       ///< credits, as of the last packet that used one
  std::deque<Cycle> begun_;    ///< when each credit in use was taken, until its packet is
  std::deque<Cycle> returns_;  ///< cycles from which credits of packets that were taken are free again
  bool waits_ = false;         ///< the consumer, for a packet
  std::size_t awaited_ = 0;    ///< returns for which the producer waits; 0 where it does not
  sc_core::sc_event arrived_{sc_core::sc_gen_unique_name("arrived")};
  sc_core::sc_event returned_{sc_core::sc_gen_unique_name("returned")};
  Occupancy occupancy_;
  Cycle counted_ = 0;  ///< occupancy_ holds the cycles before this one
  std::uint64_t packets_ = 0;
};

}  // namespace halfspace::systemc
