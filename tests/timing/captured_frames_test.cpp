// Real frames on every named machine: the SystemC modules and the recurrence agree on the cycle of every
// packet, re-timing agrees with both, and image and counts are those of the functional run.
#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <iostream>

#include "../result_difference.hpp"
#include "halfspace/core/functional.hpp"
#include "halfspace/fast/fast_core.hpp"
#include "halfspace/scene/load.hpp"
#include "halfspace/timing/record/retime.hpp"
#include "halfspace/timing/recurrence/run_recurrence.hpp"
#include "halfspace/timing/systemc/run_systemc.hpp"
#include "record_difference.hpp"

using namespace halfspace;
namespace fs = std::filesystem;

namespace {

/// A frame that ships or is captured; ends the test as skipped where it is absent.
Frame captured_frame(const std::string& name) {
  for (const char* folder : {HALFSPACE_SCENES, HALFSPACE_FRAMES}) {
    const fs::path path = fs::path(folder) / (name + ".ptf.xz");
    if (fs::exists(path)) {
      return load(path);
    }
  }
  std::cout << "skipped: " << name << ".ptf.xz is neither in " << HALFSPACE_SCENES << " nor in "
            << HALFSPACE_FRAMES << std::endl;
  std::_Exit(77);  // SKIP_RETURN_CODE of tests/CMakeLists.txt: Catch2 gives the number of failures
}

bool same_image(const FrameResult& a, const FrameResult& b) {
  const auto same = [](const auto& left, const auto& right) {
    for (int y = 0; y < left.height(); ++y) {
      for (int x = 0; x < left.width(); ++x) {
        if (left.at(x, y) != right.at(x, y)) {
          return false;
        }
      }
    }
    return left.width() == right.width() && left.height() == right.height();
  };
  for (std::size_t i = 0; i < a.surfaces.size(); ++i) {
    if (!same(a.surfaces[i].codes, b.surfaces[i].codes) ||
        !same(a.surfaces[i].fragments, b.surfaces[i].fragments) ||
        !same(a.surfaces[i].survivors, b.surfaces[i].survivors)) {
      return false;
    }
  }
  return a.surfaces.size() == b.surfaces.size();
}

bool same_counts(const Counters& a, const Counters& b) {
  bool same = true;
  Counters::units([&](const char*, auto unit) {
    using Unit = std::remove_cvref_t<decltype(a.*unit)>;
    Unit::fields([&](const char*, const char*, auto member) { same &= a.*unit.*member == b.*unit.*member; });
  });
  return same;
}

void check_frame(const std::string& name) {
  const Frame frame = captured_frame(name);
  const FrameResult base = run_functional(frame, Config{});
  for (const char* machine : {"baseline", "small", "wide", "shallow", "slow_memory"}) {
    INFO(name << " on " << machine);
    const Config config = read_config(fs::path(HALFSPACE_CONFIGS) / (std::string(machine) + ".toml"));
    validate(config);
    const FrameResult functional = run_functional(frame, config);
    const Watch pictures{.keep_visible = true, .keep_sums = true};
    const Watch readable{.keep_visible = true, .keep_sums = true, .core = Core::kReadable};
    CHECK(halfspace::testing::result_difference(run_functional(frame, config, pictures),
                                                run_functional(frame, config, readable)) == "");
    const EngineOptions options{.watch = {}, .stalls = {}, .packet_times = true};
    const TimedResult recurrence = run_recurrence(frame, config, options);
    const TimedResult systemc = run_systemc(frame, config, options);
    CHECK((recurrence.times == systemc.times));
    CHECK((recurrence.cycles == systemc.cycles));
    CHECK(recurrence.cycles.cycles == systemc.cycles.cycles);
    CHECK(same_image(recurrence.frame, base));
    CHECK(same_image(systemc.frame, base));
    CHECK(same_counts(recurrence.frame.counters, functional.counters));
    CHECK(same_counts(systemc.frame.counters, functional.counters));
    if (fast::gap(config, {}, nullptr).empty()) {
      CHECK(halfspace::testing::record_difference(frame, config) == "");
    }
    const RetimedFrame retimed = Retimer(record_frame(frame, config)).retime(config);
    CHECK(retimed.cycles == recurrence.cycles.cycles);
    std::cout << name << " on " << machine << ": " << recurrence.cycles.cycles << " cycles, "
              << systemc.times.emit.size() << " tile jobs, " << systemc.times.y.size()
              << " bursts, the same in both engines\n";
  }
}

}  // namespace

TEST_CASE("every packet's cycle: vkcube", "[timing][captured]") { check_frame("vkcube"); }
TEST_CASE("every packet's cycle: cc0_truck", "[timing][captured][slow]") { check_frame("cc0_truck"); }
TEST_CASE("every packet's cycle: glmark2_ideas", "[timing][captured][slow]") { check_frame("glmark2_ideas"); }
TEST_CASE("every packet's cycle: glmark2_shadow", "[timing][captured][slow]") {
  check_frame("glmark2_shadow");
}
TEST_CASE("every packet's cycle: openarena_gl2", "[timing][captured][slow]") { check_frame("openarena_gl2"); }
TEST_CASE("every packet's cycle: stk_snowmountain", "[timing][captured][slow]") {
  check_frame("stk_snowmountain");
}
TEST_CASE("every packet's cycle: warzone2100_vulkan", "[timing][captured][slow]") {
  check_frame("warzone2100_vulkan");
}
