// Two implementations of docs/timing.md, with nothing in common but the units: every packet of both moves in
// the same cycle, every cycle of every stage has the same reason, and both give the image of the functional
// run.
#include <catch2/catch.hpp>
#include <cstdlib>
#include <iostream>
#include <sstream>

#include "halfspace/scene/ptf.hpp"
#include "halfspace/scene/validate.hpp"
#include "halfspace/timing/functional.hpp"
#include "halfspace/timing/systemc/run_systemc.hpp"
#include "random_machine.hpp"

using namespace halfspace;
using namespace halfspace::testing;

namespace {

template <class Value>
std::string difference(const std::string& what, const std::vector<Value>& systemc,
                       const std::vector<Value>& other) {
  const auto [ours, theirs] = std::mismatch(systemc.begin(), systemc.end(), other.begin(), other.end());
  if (ours == systemc.end() && theirs == other.end()) {
    return "";
  }
  std::ostringstream text;
  text << what << "[" << ours - systemc.begin() << "]: ";
  ours == systemc.end() ? text << "ends" : text << +*ours;
  text << " against ";
  theirs == other.end() ? text << "ends" : text << +*theirs;
  text << "\n";
  return text.str();
}

std::string difference(const std::string& what, std::uint64_t systemc, std::uint64_t other) {
  return systemc == other
             ? ""
             : what + ": " + std::to_string(systemc) + " against " + std::to_string(other) + "\n";
}

/// The first packet that moves in another cycle, stage by stage.
std::string difference(const PacketTimes& systemc, const PacketTimes& other) {
  std::string text;
  text += difference("decide", systemc.decide, other.decide);
  text += difference("accept", systemc.accept, other.accept);
  text += difference("emit", systemc.emit, other.emit);
  text += difference("e", systemc.e, other.e);
  text += difference("g", systemc.g, other.g);
  text += difference("f", systemc.f, other.f);
  text += difference("b", systemc.b, other.b);
  return text + difference("y", systemc.y, other.y);
}

std::string difference(const std::string& what, const CycleStats& systemc, const CycleStats& other) {
  std::string text;
  for (std::size_t i = 0; i < kStages; ++i) {
    const std::string stage = what + std::string(kStageInfo[i].name) + ".";
    text += difference(stage + "busy", systemc.stage[i].busy, other.stage[i].busy);
    for (std::size_t reason = 0; reason < kMostStallReasons; ++reason) {
      text += difference(stage + std::string(kStageInfo[i].stall[reason]), systemc.stage[i].stall[reason],
                         other.stage[i].stall[reason]);
    }
  }
  for (std::size_t i = 0; i < kLinks; ++i) {
    const std::string link = what + std::string(kLinkName[i]) + ".";
    text += difference(link + "occupancy", systemc.occupancy[i], other.occupancy[i]);
    text += difference(link + "held", systemc.held[i], other.held[i]);
    text += difference(link + "packets", systemc.packets[i], other.packets[i]);
  }
  text += difference(what + "read_busy", systemc.read_busy, other.read_busy);
  return text + difference(what + "write_busy", systemc.write_busy, other.write_busy);
}

std::string difference(const FrameCycles& systemc, const FrameCycles& other) {
  std::string text = difference("cycles", systemc.cycles, other.cycles);
  text += difference("", systemc.stats, other.stats);
  text += difference("draws", systemc.draws.size(), other.draws.size());
  for (std::size_t i = 0; i < std::min(systemc.draws.size(), other.draws.size()); ++i) {
    const std::string draw = "draw " + std::to_string(i) + " ";
    text += difference(draw + "end", systemc.draws[i].end, other.draws[i].end);
    text += difference(draw, systemc.draws[i].stats, other.draws[i].stats);
  }
  return text;
}

std::string difference(const std::string& what, const Counters& systemc, const Counters& other) {
  std::string text;
  Counters::units([&](const char* unit, auto member) {
    std::decay_t<decltype(systemc.*member)>::fields([&](const char* name, auto, auto field) {
      text += difference(what + unit + "." + name, (systemc.*member).*field, (other.*member).*field);
    });
  });
  return text;
}

template <class Value>
std::string difference(const std::string& what, const TiledImage<Value>& systemc,
                       const TiledImage<Value>& other) {
  const auto rows = [](const TiledImage<Value>& image) {
    std::vector<Value> values;
    for (int y = 0; y < image.height(); ++y) {
      for (int x = 0; x < image.width(); ++x) {
        values.push_back(image.at(x, y));
      }
    }
    return values;
  };
  return systemc.empty() != other.empty() ? what + " is missing\n"
         : systemc.empty()                ? ""
                                          : difference(what, rows(systemc), rows(other));
}

std::string difference(const FrameResult& systemc, const FrameResult& other) {
  std::string text;
  text += difference("surfaces", systemc.surfaces.size(), other.surfaces.size());
  for (std::size_t i = 0; i < std::min(systemc.surfaces.size(), other.surfaces.size()); ++i) {
    const std::string surface = "surface " + std::to_string(i) + " ";
    text += difference(surface + "codes", systemc.surfaces[i].codes, other.surfaces[i].codes);
    text += difference(surface + "fragments", systemc.surfaces[i].fragments, other.surfaces[i].fragments);
    text += difference(surface + "survivors", systemc.surfaces[i].survivors, other.surfaces[i].survivors);
    text += difference(surface + "visible", systemc.surfaces[i].visible, other.surfaces[i].visible);
    text += difference(surface, systemc.surfaces[i].counters, other.surfaces[i].counters);
  }
  text += difference("draws", systemc.draws.size(), other.draws.size());
  for (std::size_t i = 0; i < std::min(systemc.draws.size(), other.draws.size()); ++i) {
    const std::string draw = "draw " + std::to_string(i) + " ";
    text += difference(draw + "command", systemc.draws[i].command, other.draws[i].command);
    text += difference(draw + "surface", systemc.draws[i].surface, other.draws[i].surface);
    text += difference(draw, systemc.draws[i].counters, other.draws[i].counters);
  }
  text += difference("", systemc.counters, other.counters);
  text += difference("drawn_clears ", systemc.drawn_clears, other.drawn_clears);
  text += difference("clears", systemc.clears, other.clears);
  text += difference("flushed_lines", systemc.flushed_lines, other.flushed_lines);
  text += difference("flushed_bytes", systemc.flushed_bytes, other.flushed_bytes);
  return text + difference("draws_not_filled", systemc.draws_not_filled, other.draws_not_filled);
}

/// Everything that passes, as numbers.
class Events : public PacketObserver {
 public:
  std::vector<std::uint64_t> quads;
  std::vector<std::uint64_t> cycles;
  std::vector<std::uint64_t> decisions;
  std::vector<std::uint64_t> jobs;
  std::vector<std::uint64_t> done;

  [[nodiscard]] bool wants_quads() const override { return true; }
  [[nodiscard]] bool wants_decisions() const override { return true; }
  [[nodiscard]] bool wants_tile_jobs() const override { return true; }
  void quad(const QuadEvent& event) override {
    quads.insert(quads.end(), {event.draw, event.triangle, event.surface, event.x, event.y, event.mask,
                               event.passed, event.depth[0], event.depth[1], event.depth[2], event.depth[3]});
    cycles.push_back(event.cycle);
  }
  void decision(const DecisionEvent& event) override {
    decisions.insert(decisions.end(), {event.draw, event.triangle, event.surface, event.x, event.y,
                                       event.size, static_cast<std::uint64_t>(event.verdict)});
  }
  void tile_job(const TileJob& job) override {
    TileJob::fields([&](const char*, auto member, auto, auto) {
      if constexpr (std::is_integral_v<std::decay_t<decltype(job.*member)>>) {
        jobs.push_back(static_cast<std::uint64_t>(job.*member));
      } else {
        for (const auto value : job.*member) {
          jobs.push_back(static_cast<std::uint64_t>(value));
        }
      }
    });
  }
  void draw_done(std::size_t count, std::size_t of) override { done.insert(done.end(), {count, of}); }
};

std::string difference(const Events& systemc, const Events& other) {
  return difference("quad events", systemc.quads, other.quads) +
         difference("decisions", systemc.decisions, other.decisions) +
         difference("jobs", systemc.jobs, other.jobs) + difference("draws done", systemc.done, other.done);
}

/// Runs the frame by all three engines; empty where nothing differs.
std::string compare(const Frame& frame, const Config& config, const StallPlan& stalls) {
  Events functional_events;
  const FrameResult functional = run_functional(frame, config, true, &functional_events);

  Events events;
  PacketTimes times;
  TimedRun run;
  run.stalls = stalls;
  run.times = &times;
  const FrameResult systemc = run_systemc(frame, config, true, &events, run);

  Events recurrence_events;
  PacketTimes recurrence_times;
  TimedRun recurrence_run;
  recurrence_run.stalls = stalls;
  recurrence_run.times = &recurrence_times;
  run_recurrence(frame, config, true, &recurrence_events, recurrence_run);

  return difference(systemc, functional) + difference(events, functional_events) +
         difference(times, recurrence_times) + difference(run.cycles, recurrence_run.cycles) +
         difference("cycle of quad", events.cycles, recurrence_events.cycles);
}

std::uint64_t cases() {
  const char* text = std::getenv("HALFSPACE_CASES");
  return text != nullptr ? std::stoull(text) : 300;
}

}  // namespace

TEST_CASE("systemc equals recurrence on vkcube") {
  const Frame frame = read_ptf(HALFSPACE_SCENES "/vkcube.ptf.xz");
  CHECK(compare(frame, {}, {}) == "");
}

TEST_CASE("systemc equals recurrence on random machines") {
  const std::uint64_t first = seed();
  std::cout << "seed " << first << ", " << cases() << " cases\n";
  for (std::uint64_t n = 0; n < cases(); ++n) {
    Random random(first + n);
    const Config config = random_config(random);
    const Frame frame = random_frame(random);
    const StallPlan stalls = random_stalls(random);
    validate(config);
    validate(frame);
    const std::string found = compare(frame, config, stalls);
    if (!found.empty()) {
      FAIL("HALFSPACE_SEED=" << first + n << " HALFSPACE_CASES=1\n"
                             << difference_from_default(config) << "systemc against the other:\n"
                             << found);
    }
  }
}
