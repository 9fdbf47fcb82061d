/// early_z as a module: z_lookup, z_test and z_control around the z cache.
#pragma once

#include <cstdint>
#include <systemc>

#include "halfspace/timing/systemc/z_cache_state.hpp"
#include "halfspace/timing/systemc/z_control.hpp"
#include "halfspace/timing/systemc/z_lookup.hpp"
#include "halfspace/timing/systemc/z_test.hpp"

namespace halfspace::systemc {

class EarlyZ : public sc_core::sc_module {
 public:
  /// Depth lies in memory from address `base` on; see DepthLayout.
  EarlyZ(const sc_core::sc_module_name& name, RunState& run, JobReturns& returns, std::uint64_t base);

  /// Fills the surfaces in memory with what they hold before the first command, in no time.
  void begin_frame();
  /// Reads the image of a surface from memory, in no time. Lines that are only marked cleared have their
  /// value.
  void read_surface(std::uint32_t surface, TiledImage<std::uint32_t>& codes);

  ZCacheState cache;
  ZLookup lookup;
  ZTest test;
  ZControl control;

 private:
  RunState& run_;
};

}  // namespace halfspace::systemc
