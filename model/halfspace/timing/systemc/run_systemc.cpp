#include "halfspace/timing/systemc/run_systemc.hpp"

#include <sysc/tracing/sc_tracing_ids.h>
#include <tlm_utils/simple_initiator_socket.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <memory>
#include <string>

#include "halfspace/numerics/error.hpp"
#include "halfspace/timing/systemc/raster_pipeline.hpp"
#include "halfspace/timing/systemc/simple_memory.hpp"
#include "halfspace/timing/systemc/simulation_context.hpp"

namespace halfspace {
namespace {

using namespace systemc;

/// Submits the bound frame and waits for it.
class Host : public sc_core::sc_module {
 public:
  SC_HAS_PROCESS(Host);
  explicit Host(const sc_core::sc_module_name& name) : sc_module(name), socket("socket") { SC_THREAD(run); }

  tlm_utils::simple_initiator_socket<Host> socket;

 private:
  void run() {
    write(registers::kSubmitFrame);
    write(registers::kWaitIdle);
  }

  void write(std::uint64_t address) {
    payload_.set_write();
    payload_.set_address(address);
    payload_.set_data_ptr(word_.data());
    payload_.set_data_length(word_.size());
    payload_.set_streaming_width(word_.size());
    sc_core::sc_time delay;
    socket->b_transport(payload_, delay);
  }

  // Not on the stack of the process, which nobody unwinds after a deadlock.
  std::array<std::uint8_t, 4> word_{};
  tlm::tlm_generic_payload payload_;
};

struct Platform {
  Platform(const Frame& frame, const Config& config)
      : host("host"), pipeline("pipeline", config), memory("memory", config, depth_bytes(frame, config)) {
    host.socket.bind(pipeline.commands);
    pipeline.memory.bind(memory.socket);
  }

  Host host;
  RasterPipeline pipeline;
  SimpleMemory memory;
};

/// A path to which the kernel adds .vcd. The kernel ends the program where it cannot write the file, so that
/// is found out first.
std::filesystem::path writable_vcd(std::filesystem::path path) {
  path.replace_extension(path.extension() == ".vcd" ? "" : path.extension());
  const std::string file = path.string() + ".vcd";
  if (!std::ofstream(file)) {
    throw InputError(file + ": cannot be written: " + std::strerror(errno));
  }
  return path;
}

class TraceFile {
 public:
  explicit TraceFile(const std::filesystem::path& path)
      : file_(sc_core::sc_create_vcd_trace_file(writable_vcd(path).c_str())) {
    using sc_core::sc_report_handler;  // the kernel would tell of every file
    const sc_core::sc_actions before = sc_report_handler::set_actions(
        sc_core::SC_ID_TRACING_TIMESCALE_UNIT_, sc_core::SC_INFO, sc_core::SC_DO_NOTHING);
    file_->set_time_unit(1, sc_core::SC_NS);
    sc_report_handler::set_actions(sc_core::SC_ID_TRACING_TIMESCALE_UNIT_, sc_core::SC_INFO, before);
  }
  ~TraceFile() { sc_core::sc_close_vcd_trace_file(file_); }
  TraceFile(const TraceFile&) = delete;
  TraceFile& operator=(const TraceFile&) = delete;

  [[nodiscard]] sc_core::sc_trace_file* get() const { return file_; }

 private:
  sc_core::sc_trace_file* file_;
};

}  // namespace

TimedResult run_systemc(const Frame& frame, const Config& config, const EngineOptions& options,
                        const SystemcOptions& systemc) {
  const SimulationContext context;
  std::unique_ptr<TraceFile> trace;
  Platform platform(frame, config);
  platform.pipeline.bind_frame(frame, options);
  if (!systemc.vcd.empty()) {
    trace = std::make_unique<TraceFile>(systemc.vcd);
    platform.pipeline.trace_to(trace->get());
  }
  sc_core::sc_start();
  platform.pipeline.check();
  if (systemc.activations != nullptr) {
    *systemc.activations = platform.pipeline.activations();
  }
  return platform.pipeline.take_result();
}

}  // namespace halfspace
