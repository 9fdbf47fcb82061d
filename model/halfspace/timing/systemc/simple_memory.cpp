#include "halfspace/timing/systemc/simple_memory.hpp"

#include <algorithm>
#include <cstring>

#include "halfspace/timing/contract.hpp"

namespace halfspace::systemc {

SimpleMemory::SimpleMemory(const sc_core::sc_module_name& name, const Config& config, std::uint64_t size)
    : sc_module(name),
      socket("socket"),
      cycle_(1, sc_core::SC_NS),
      latency_(cycle_ * config.memory.latency),
      read_bytes_(config.memory.read_bytes),
      write_bytes_(config.memory.write_bytes),
      bytes_(size) {
  socket.register_b_transport(this, &SimpleMemory::transport);
  socket.register_transport_dbg(this, &SimpleMemory::access);
}

sc_core::sc_time SimpleMemory::transfer_time(const tlm::tlm_generic_payload& payload, int width) const {
  return cycle_ * transfer_cycles(static_cast<int>(payload.get_data_length()), width);
}

bool SimpleMemory::check(tlm::tlm_generic_payload& payload) const {
  const std::uint64_t length = payload.get_data_length();
  if (payload.get_byte_enable_ptr() != nullptr) {
    payload.set_response_status(tlm::TLM_BYTE_ENABLE_ERROR_RESPONSE);
  } else if (payload.get_streaming_width() < length) {
    payload.set_response_status(tlm::TLM_BURST_ERROR_RESPONSE);
  } else if (length > bytes_.size() || payload.get_address() > bytes_.size() - length) {
    payload.set_response_status(tlm::TLM_ADDRESS_ERROR_RESPONSE);
  } else {
    payload.set_response_status(tlm::TLM_OK_RESPONSE);
  }
  return payload.is_response_ok();
}

unsigned SimpleMemory::access(tlm::tlm_generic_payload& payload) {
  if (!check(payload)) {
    return 0;
  }
  std::uint8_t* const here = bytes_.data() + payload.get_address();
  if (payload.is_read()) {
    std::memcpy(payload.get_data_ptr(), here, payload.get_data_length());
  } else if (payload.is_write()) {
    std::memcpy(here, payload.get_data_ptr(), payload.get_data_length());
  }
  return payload.get_data_length();
}

void SimpleMemory::transport(tlm::tlm_generic_payload& payload, sc_core::sc_time& delay) {
  if (!check(payload)) {
    return;
  }
  const sc_core::sc_time arrives = sc_core::sc_time_stamp() + delay;
  if (payload.is_read()) {
    const sc_core::sc_time end =
        std::max(arrives + latency_, read_free_) + transfer_time(payload, read_bytes_);
    read_free_ = end;
    access(payload);
    delay = end - cycle_ - sc_core::sc_time_stamp();
  } else if (payload.is_write()) {
    const sc_core::sc_time end = std::max(arrives, write_free_) + transfer_time(payload, write_bytes_);
    write_free_ = end;
    const sc_core::sc_time left = end - cycle_ - sc_core::sc_time_stamp();
    if (left != sc_core::SC_ZERO_TIME) {
      wait(left);
    }
    access(payload);
    delay = sc_core::SC_ZERO_TIME;
  }
}

}  // namespace halfspace::systemc
