/// A SystemC kernel of its own for each run.
#pragma once

namespace sc_core {
class sc_simcontext;
}

namespace halfspace::systemc {

/// While it lives, modules are made in and simulated by a fresh kernel; then the one before is back. Needed
/// because IEEE 1666 has no way back from a simulation to elaboration, and a program may run many frames.
///
/// In Accellera's library all state of the kernel hangs on two pointers that its headers export; the standard
/// does not know them, so with another library this class is what has to change. The ways within the standard
/// are worse: a child process a run has to send its results and observer calls through a pipe, and pipelines
/// elaborated in advance must know all configurations at the start. Thousands of runs take 0.2 ms each beyond
/// the simulation, and no memory stays behind.
///
/// All modules of the context must be gone before it is.
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
