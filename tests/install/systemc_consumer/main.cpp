// The smallest virtual platform: a host that draws a frame, the rasterizer, and its memory.
#include <tlm_utils/simple_initiator_socket.h>

#include <array>
#include <cstdio>
#include <halfspace/scene/load.hpp>
#include <halfspace/timing/systemc/raster_pipeline.hpp>
#include <halfspace/timing/systemc/simple_memory.hpp>
#include <systemc>

using namespace halfspace;

class Host : public sc_core::sc_module {
 public:
  SC_HAS_PROCESS(Host);
  explicit Host(const sc_core::sc_module_name& name) : sc_module(name), socket("socket") { SC_THREAD(draw); }

  tlm_utils::simple_initiator_socket<Host> socket;

 private:
  void draw() {
    write(systemc::registers::kSubmitFrame);
    write(systemc::registers::kWaitIdle);
  }

  void write(std::uint64_t address) {
    std::array<std::uint8_t, 4> word{};
    tlm::tlm_generic_payload payload;
    payload.set_write();
    payload.set_address(address);
    payload.set_data_ptr(word.data());
    payload.set_data_length(word.size());
    payload.set_streaming_width(word.size());
    sc_core::sc_time delay;
    socket->b_transport(payload, delay);
  }
};

int sc_main(int, char** argv) {
  const Frame frame = load(argv[1]);
  const Config config;
  Host host("host");
  systemc::RasterPipeline pipeline("pipeline", config);
  systemc::SimpleMemory memory("memory", config, systemc::depth_bytes(frame, config));
  host.socket.bind(pipeline.commands);
  pipeline.memory.bind(memory.socket);
  pipeline.bind_frame(frame);
  sc_core::sc_start();
  pipeline.check();
  std::printf("%llu cycles\n", static_cast<unsigned long long>(pipeline.take_result().cycles.cycles));
  return 0;
}
