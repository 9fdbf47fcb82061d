#include "halfspace/timing/systemc/depth_memory.hpp"

#include <stdexcept>
#include <string>

namespace halfspace::systemc {
namespace {

void fill(tlm::tlm_generic_payload& payload, tlm::tlm_command command, std::uint64_t address,
          std::vector<std::uint8_t>& bytes) {
  payload.set_command(command);
  payload.set_address(address);
  payload.set_data_ptr(bytes.data());
  payload.set_data_length(static_cast<unsigned>(bytes.size()));
  payload.set_streaming_width(static_cast<unsigned>(bytes.size()));
}

}  // namespace

void DepthMemory::access(tlm::tlm_command command, std::uint32_t line, std::vector<std::uint8_t>& bytes,
                         sc_core::sc_time& delay) {
  tlm::tlm_generic_payload payload;
  fill(payload, command, layout.address(line), bytes);
  socket->b_transport(payload, delay);
  if (payload.is_response_error()) {
    throw std::runtime_error("memory: " + payload.get_response_string() + " for the line at address " +
                             std::to_string(layout.address(line)));
  }
}

void DepthMemory::access_in_no_time(tlm::tlm_command command, std::uint32_t line,
                                    std::vector<std::uint8_t>& bytes) {
  tlm::tlm_generic_payload payload;
  fill(payload, command, layout.address(line), bytes);
  if (socket->transport_dbg(payload) != bytes.size()) {
    throw std::runtime_error("memory: no line at address " + std::to_string(layout.address(line)));
  }
}

}  // namespace halfspace::systemc
