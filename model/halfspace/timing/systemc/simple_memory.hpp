/// A memory with the timing of docs/units/early_z.md, *Memory*.
#pragma once

#include <tlm_utils/simple_target_socket.h>

#include <cstdint>
#include <systemc>
#include <tlm>
#include <vector>

#include "halfspace/config/config.hpp"

namespace halfspace::systemc {

/// A channel for reads and one for writes, each in order. 1 cycle is 1 ns.
///
/// A read takes its data when it is called and returns at once; the delay it returns is that from the call to
/// the cycle in which the last of the data has come. So its initiator may have as many under way as it likes.
/// A write returns in the cycle of its last data, and takes effect in it.
class SimpleMemory : public sc_core::sc_module {
 public:
  SC_HAS_PROCESS(SimpleMemory);
  /// `size` in bytes, from address 0 on; latency and widths are those of the configuration.
  SimpleMemory(const sc_core::sc_module_name& name, const Config& config, std::uint64_t size);

  tlm_utils::simple_target_socket<SimpleMemory> socket;

 private:
  void transport(tlm::tlm_generic_payload& payload, sc_core::sc_time& delay);
  unsigned access(tlm::tlm_generic_payload& payload);
  /// Sets the response, and returns whether it is that all is well.
  bool check(tlm::tlm_generic_payload& payload) const;
  [[nodiscard]] sc_core::sc_time transfer_time(const tlm::tlm_generic_payload& payload, int width) const;

  sc_core::sc_time cycle_;
  sc_core::sc_time latency_;
  int read_bytes_;
  int write_bytes_;
  std::vector<std::uint8_t> bytes_;
  sc_core::sc_time read_free_;  ///< when the channel may move the first data of a further transfer
  sc_core::sc_time write_free_;
};

}  // namespace halfspace::systemc
