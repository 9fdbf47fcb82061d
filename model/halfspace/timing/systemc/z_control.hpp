/// z_control: clears and flushes of the z cache, for when the pipe is empty.
#pragma once

#include <cstdint>
#include <systemc>

#include "halfspace/timing/systemc/z_cache_state.hpp"

namespace halfspace::systemc {

/// What the command processor asks of the z cache.
class DepthControl : virtual public sc_core::sc_interface {
 public:
  /// A fast clear: all lines of the surface hold `code`.
  virtual void clear(std::uint32_t surface, std::uint32_t code) = 0;
  /// Suspends the calling thread until all that has left the cache is in memory. Returns the cycle after the
  /// last write.
  virtual Cycle wait_until_written() = 0;
  /// Writes back what is dirty, beginning in cycle `begin`; suspends the calling thread until all is in
  /// memory. Returns the last cycle in which a line was looked at or written.
  virtual Cycle flush(Cycle begin) = 0;
};

class ZControl : public sc_core::sc_module, public DepthControl {
 public:
  ZControl(const sc_core::sc_module_name& name, RunState& run, ZCacheState& cache);

  void clear(std::uint32_t surface, std::uint32_t code) override;
  Cycle wait_until_written() override;
  Cycle flush(Cycle begin) override;

 private:
  RunState& run_;
  ZCacheState& cache_;
};

}  // namespace halfspace::systemc
