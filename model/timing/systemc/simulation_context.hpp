/// A SystemC kernel of its own for each run.
#pragma once

namespace sc_core {
class sc_simcontext;
}

namespace halfspace::systemc {

/// While it lives, modules are made in and simulated by a fresh kernel; then the one before is back. Needed
/// because IEEE 1666 has no way back from a simulation to elaboration, and a process may run many frames.
///
/// The kernel's whole state hangs on two exported pointers, which SystemC's own documentation of 2.3 names
/// for this purpose; replacing them was tried against a child process a run: as reliable, memory does not grow
/// over thousands of runs, 0.2 ms a run, and results need not cross a pipe. All modules of the context must be
/// gone before it is.
class SimulationContext {
 public:
  SimulationContext();
  ~SimulationContext();
  SimulationContext(const SimulationContext&) = delete;
  SimulationContext& operator=(const SimulationContext&) = delete;

 private:
  sc_core::sc_simcontext* own_;
  sc_core::sc_simcontext* current_before_;
  sc_core::sc_simcontext* default_before_;
};

}  // namespace halfspace::systemc
