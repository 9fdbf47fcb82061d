/// Two observers of one run.
#pragma once

#include "halfspace/machine/packet_observer.hpp"

namespace halfspace {

/// Shows each what it wants; both must outlive the pair.
class ObserverPair final : public PacketObserver {
 public:
  ObserverPair(PacketObserver& first, PacketObserver& second) : first_(first), second_(second) {}

  [[nodiscard]] bool wants_quads() const override { return first_.wants_quads() || second_.wants_quads(); }
  [[nodiscard]] bool wants_decisions() const override {
    return first_.wants_decisions() || second_.wants_decisions();
  }
  [[nodiscard]] bool wants_tile_jobs() const override {
    return first_.wants_tile_jobs() || second_.wants_tile_jobs();
  }
  [[nodiscard]] bool wants_walk() const override { return first_.wants_walk() || second_.wants_walk(); }
  void quad(const QuadEvent& quad) override {
    show(&PacketObserver::wants_quads, [&](PacketObserver& observer) { observer.quad(quad); });
  }
  void decision(const DecisionEvent& decision) override {
    show(&PacketObserver::wants_decisions, [&](PacketObserver& observer) { observer.decision(decision); });
  }
  void tile_job(const TileJob& job) override {
    show(&PacketObserver::wants_tile_jobs, [&](PacketObserver& observer) { observer.tile_job(job); });
  }
  void set_up(const SetupEvent& event) override {
    show(&PacketObserver::wants_walk, [&](PacketObserver& observer) { observer.set_up(event); });
  }
  void block_walked(const BlockJob& job, std::uint64_t touched) override {
    show(&PacketObserver::wants_walk, [&](PacketObserver& observer) { observer.block_walked(job, touched); });
  }
  void walk_led(const GridPlace& pixel, int side) override {
    show(&PacketObserver::wants_walk, [&](PacketObserver& observer) { observer.walk_led(pixel, side); });
  }
  void hi_z_decided(const BlockJob& block, std::uint64_t rejected) override {
    show(&PacketObserver::wants_walk,
         [&](PacketObserver& observer) { observer.hi_z_decided(block, rejected); });
  }
  void draw_done(std::size_t done, std::size_t of) override {
    first_.draw_done(done, of);
    second_.draw_done(done, of);
  }

 private:
  template <class Show>
  void show(bool (PacketObserver::*wants)() const, const Show& show_to) {
    for (PacketObserver* const observer : {&first_, &second_}) {
      if ((observer->*wants)()) {
        show_to(*observer);
      }
    }
  }

  PacketObserver& first_;
  PacketObserver& second_;
};

}  // namespace halfspace
