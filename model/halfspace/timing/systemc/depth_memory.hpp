/// The memory port of early_z: lines of depth by their number.
#pragma once

#include <tlm_utils/simple_initiator_socket.h>

#include <cstdint>
#include <tlm>
#include <vector>

#include "halfspace/timing/systemc/depth_layout.hpp"

namespace halfspace::systemc {

class DepthMemory {
 public:
  DepthMemory() : socket("memory") {}

  tlm_utils::simple_initiator_socket<DepthMemory> socket;
  DepthLayout layout;

  /// Reads or writes a line; `delay` is what is left of it when this returns. Throws where memory answers
  /// with an error.
  void access(tlm::tlm_command command, std::uint32_t line, std::vector<std::uint8_t>& bytes,
              sc_core::sc_time& delay);
  void access_in_no_time(tlm::tlm_command command, std::uint32_t line, std::vector<std::uint8_t>& bytes);
};

}  // namespace halfspace::systemc
