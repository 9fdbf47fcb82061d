#include "halfspace/timing/systemc/simulation_context.hpp"

#include <systemc>

/// The library of SystemC wants one. A program with one of its own does not get this.
__attribute__((weak)) int sc_main(int /*argc*/, char** /*argv*/) { return 0; }

namespace halfspace::systemc {

SimulationContext::SimulationContext()
    : own_(new sc_core::sc_simcontext),
      current_before_(sc_core::sc_curr_simcontext),
      default_before_(sc_core::sc_default_global_context) {
  sc_core::sc_curr_simcontext = own_;
  sc_core::sc_default_global_context = own_;
}

SimulationContext::~SimulationContext() {
  delete own_;
  sc_core::sc_curr_simcontext = current_before_;
  sc_core::sc_default_global_context = default_before_;
}

}  // namespace halfspace::systemc
