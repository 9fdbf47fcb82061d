// The pipeline as a part of a virtual platform: a host that drives it by its registers, and a memory.
#include <tlm_utils/simple_initiator_socket.h>

#include <catch2/catch.hpp>
#include <cstring>
#include <functional>
#include <systemc>
#include <tlm>

#include "halfspace/core/functional.hpp"
#include "halfspace/timing/systemc/raster_pipeline.hpp"
#include "halfspace/timing/systemc/simple_memory.hpp"
#include "halfspace/timing/systemc/simulation_context.hpp"
#include "random_machine.hpp"

/// The kernel throws the stack of a thread that waits for ever away with the objects on it: here those of a
/// host whose command never ends.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() { return "leak:tlm::tlm_generic_payload"; }

using namespace halfspace;
using namespace halfspace::systemc;
using namespace halfspace::testing;

namespace {

/// A processor that runs `program`.
class Host : public sc_core::sc_module {
 public:
  SC_HAS_PROCESS(Host);
  Host(const sc_core::sc_module_name& name, std::function<void(Host&)> program)
      : sc_module(name), socket("socket"), program_(std::move(program)) {
    SC_THREAD(run);
  }

  tlm_utils::simple_initiator_socket<Host> socket;

  tlm::tlm_response_status write(std::uint64_t address, std::uint32_t value) {
    std::memcpy(bytes_.data(), &value, sizeof value);
    return access(tlm::TLM_WRITE_COMMAND, address, sizeof value);
  }

  std::uint32_t read(std::uint64_t address) {
    REQUIRE(access(tlm::TLM_READ_COMMAND, address, 4) == tlm::TLM_OK_RESPONSE);
    std::uint32_t value = 0;
    std::memcpy(&value, bytes_.data(), sizeof value);
    return value;
  }

  tlm::tlm_response_status access(tlm::tlm_command command, std::uint64_t address, unsigned length) {
    tlm::tlm_generic_payload payload;
    payload.set_command(command);
    payload.set_address(address);
    payload.set_data_ptr(bytes_.data());
    payload.set_data_length(length);
    payload.set_streaming_width(length);
    sc_core::sc_time delay;
    socket->b_transport(payload, delay);
    sc_core::wait(delay);
    return payload.get_response_status();
  }

  bool ended = false;

 private:
  void run() {
    program_(*this);
    ended = true;
  }

  std::function<void(Host&)> program_;
  std::array<std::uint8_t, 8> bytes_{};
};

struct Platform {
  Platform(const Config& config, std::uint64_t base, std::uint64_t memory_size,
           const std::function<void(Host&)>& program)
      : host("host", program), pipeline("pipeline", config, base), memory("memory", config, memory_size) {
    host.socket.bind(pipeline.commands);
    pipeline.memory.bind(memory.socket);
  }

  /// Until nothing can happen any more.
  void run() {
    sc_core::sc_start();
    pipeline.check();
    REQUIRE(host.ended);
  }

  SimulationContext kernel;
  Host host;
  RasterPipeline pipeline;
  SimpleMemory memory;
};

Frame small_frame() {
  Random random(seed());
  FrameBuilder builder(64, DepthFormat::kUnorm16);
  builder.draw(random_triangles(random, 64, 20));
  builder.clear(0.5f).scissor = {8, 8, 20, 30};
  builder.draw(random_triangles(random, 64, 20));
  return builder.frame;
}

void check_same_image(const FrameResult& ours, const FrameResult& theirs) {
  const TiledImage<std::uint32_t>& codes = ours.surfaces.at(0).codes;
  int different = 0;
  for (int y = 0; y < codes.height(); ++y) {
    for (int x = 0; x < codes.width(); ++x) {
      different += codes.at(x, y) != theirs.surfaces.at(0).codes.at(x, y) ? 1 : 0;
    }
  }
  CHECK(different == 0);
  CHECK(ours.counters.early_z.survivors == theirs.counters.early_z.survivors);
}

}  // namespace

TEST_CASE("a host draws a frame by commands, and the image is in its memory", "[timing]") {
  const Frame frame = small_frame();
  Config config;
  config.z_cache.lines = 8;
  const std::uint64_t base = 0x1000;
  std::uint64_t cycles = 0;
  Platform platform(config, base, base + depth_bytes(frame, config), [&](Host& host) {
    CHECK(host.read(registers::kStatus) == 2);
    for (std::uint32_t i = 0; i < frame.commands.size(); ++i) {
      CHECK(host.write(registers::kSubmitCommand, i) == tlm::TLM_OK_RESPONSE);
    }
    CHECK(host.read(registers::kStatus) == 3);
    CHECK(host.write(registers::kWaitIdle, 0) == tlm::TLM_OK_RESPONSE);
    CHECK(host.read(registers::kStatus) == 0);
    CHECK(host.read(registers::kCommandsDone) == frame.commands.size() + 1);
    cycles = host.read(registers::kCyclesLow) | std::uint64_t{host.read(registers::kCyclesHigh)} << 32;
  });
  platform.pipeline.bind_frame(frame);
  platform.run();
  const TimedResult result = platform.pipeline.take_result();
  CHECK(result.cycles.cycles == cycles);
  CHECK(cycles > 100);
  CHECK(sc_core::sc_time_stamp() == sc_core::sc_time(static_cast<double>(cycles), sc_core::SC_NS));

  const FrameResult functional = run_functional(frame, config);
  check_same_image(result.frame, functional);
  // The first sample of each row of the first tile, as a program on the host would find it.
  for (unsigned y = 0; y < 8; ++y) {
    std::array<std::uint8_t, 2> bytes{};
    tlm::tlm_generic_payload payload;
    payload.set_read();
    payload.set_address(base + y * 8 * bytes.size());
    payload.set_data_ptr(bytes.data());
    payload.set_data_length(bytes.size());
    payload.set_streaming_width(bytes.size());
    REQUIRE(platform.pipeline.memory->transport_dbg(payload) == bytes.size());
    const std::uint32_t code = functional.surfaces[0].codes.at(0, static_cast<int>(y));
    CHECK((bytes[0] | bytes[1] << 8) == static_cast<int>(code));
  }
}

TEST_CASE("a pipeline draws frame after frame in one simulation, each from cycle 0", "[timing]") {
  const Frame frame = small_frame();
  Platform* machine = nullptr;
  std::vector<TimedResult> results;
  Platform platform({}, 0, depth_bytes(frame, {}), [&](Host& host) {
    for (int n = 0; n < 3; ++n) {
      machine->pipeline.bind_frame(frame);
      CHECK(host.write(registers::kSubmitFrame, 0) == tlm::TLM_OK_RESPONSE);
      CHECK(host.write(registers::kWaitIdle, 0) == tlm::TLM_OK_RESPONSE);
      results.push_back(machine->pipeline.take_result());
      sc_core::wait(sc_core::sc_time(12345, sc_core::SC_PS));
    }
  });
  machine = &platform;
  platform.run();
  CHECK(results.at(1).cycles == results.at(0).cycles);
  CHECK(results.at(2).cycles == results.at(0).cycles);
  check_same_image(results.at(2).frame, run_functional(frame, {}));
}

TEST_CASE("the command port answers what it cannot do with the error of TLM-2.0", "[timing]") {
  const Frame frame = small_frame();
  const auto first = [](tlm::tlm_command command, std::uint64_t address, unsigned length) {
    return [=](Host& host) { return host.access(command, address, length); };
  };
  struct Case {
    std::function<tlm::tlm_response_status(Host&)> access;
    tlm::tlm_response_status response;
  };
  const std::vector<Case> cases{
      {first(tlm::TLM_WRITE_COMMAND, 0x1C, 4), tlm::TLM_ADDRESS_ERROR_RESPONSE},
      {first(tlm::TLM_READ_COMMAND, 0x1000, 4), tlm::TLM_ADDRESS_ERROR_RESPONSE},
      {first(tlm::TLM_WRITE_COMMAND, 0x02, 4), tlm::TLM_ADDRESS_ERROR_RESPONSE},
      {first(tlm::TLM_WRITE_COMMAND, registers::kSubmitFrame, 8), tlm::TLM_BURST_ERROR_RESPONSE},
      {first(tlm::TLM_READ_COMMAND, registers::kStatus, 1), tlm::TLM_BURST_ERROR_RESPONSE},
      {first(tlm::TLM_READ_COMMAND, registers::kSubmitFrame, 4), tlm::TLM_COMMAND_ERROR_RESPONSE},
      {first(tlm::TLM_WRITE_COMMAND, registers::kStatus, 4), tlm::TLM_COMMAND_ERROR_RESPONSE},
      {[&](Host& host) {
         return host.write(registers::kSubmitCommand, static_cast<std::uint32_t>(frame.commands.size()));
       },
       tlm::TLM_GENERIC_ERROR_RESPONSE},
  };
  Platform platform({}, 0, depth_bytes(frame, {}), [&](Host& host) {
    for (std::size_t i = 0; i < cases.size(); ++i) {
      CAPTURE(i);
      CHECK(cases[i].access(host) == cases[i].response);
    }
  });
  platform.pipeline.bind_frame(frame);
  platform.run();
}

TEST_CASE("commands without a frame are refused", "[timing]") {
  Platform platform({}, 0, 64, [&](Host& host) {
    CHECK(host.write(registers::kSubmitFrame, 0) == tlm::TLM_GENERIC_ERROR_RESPONSE);
    CHECK(host.write(registers::kWaitIdle, 0) == tlm::TLM_GENERIC_ERROR_RESPONSE);
  });
  platform.run();
}

TEST_CASE("a memory that is too small is an error, not a crash", "[timing]") {
  const Frame frame = small_frame();
  Platform platform({}, 0, 64, [&](Host& host) {
    host.write(registers::kSubmitFrame, 0);
    host.write(registers::kWaitIdle, 0);
  });
  platform.pipeline.bind_frame(frame);
  sc_core::sc_start();
  CHECK_THROWS_WITH(platform.pipeline.check(), Catch::Contains("memory: no line at address 0"));
}

TEST_CASE("the memory answers in order, each channel at its own width", "[timing]") {
  Config config;
  config.memory.latency = 10;
  config.memory.read_bytes = 4;
  config.memory.write_bytes = 2;
  struct Answer {
    double called;
    double done;
  };
  std::vector<Answer> answers;
  const SimulationContext kernel;
  struct Master : sc_core::sc_module {
    SC_HAS_PROCESS(Master);
    Master(const sc_core::sc_module_name& name, std::function<void(Master&)> program)
        : sc_module(name), socket("socket"), program_(std::move(program)) {
      SC_THREAD(run);
    }
    void run() { program_(*this); }
    tlm_utils::simple_initiator_socket<Master> socket;
    std::function<void(Master&)> program_;
  };
  std::array<std::uint8_t, 8> data{1, 2, 3, 4, 5, 6, 7, 8};
  const auto access = [&](Master& master, tlm::tlm_command command) {
    tlm::tlm_generic_payload payload;
    payload.set_command(command);
    payload.set_address(8);
    payload.set_data_ptr(data.data());
    payload.set_data_length(data.size());
    payload.set_streaming_width(data.size());
    const double called = sc_core::sc_time_stamp().to_seconds() * 1e9;
    sc_core::sc_time delay;
    master.socket->b_transport(payload, delay);
    CHECK(payload.get_response_status() == tlm::TLM_OK_RESPONSE);
    answers.push_back({called, (sc_core::sc_time_stamp() + delay).to_seconds() * 1e9});
  };
  Master master("master", [&](Master& self) {
    access(self, tlm::TLM_READ_COMMAND);  // called in cycle 0: data in 10 and 11
    access(self, tlm::TLM_READ_COMMAND);  // behind it: 12 and 13
    data = {9, 9, 9, 9, 9, 9, 9, 9};
    access(self, tlm::TLM_WRITE_COMMAND);  // 4 cycles: 0 to 3
    data = {};
    access(self, tlm::TLM_READ_COMMAND);  // called in cycle 3: 14 and 15
    CHECK(data[0] == 9);
  });
  SimpleMemory memory("memory", config, 16);
  master.socket.bind(memory.socket);
  sc_core::sc_start();
  REQUIRE(answers.size() == 4);
  CHECK(answers[0].done == Approx(11));
  CHECK(answers[1].done == Approx(13));
  CHECK(answers[2].done == Approx(3));
  CHECK(answers[3].called == Approx(3));
  CHECK(answers[3].done == Approx(15));
}
