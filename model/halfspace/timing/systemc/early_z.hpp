/// early_z as a module: lookup, test, and the z cache with its data, fill buffers and write buffer.
#pragma once

#include <tlm_utils/simple_initiator_socket.h>

#include <systemc>
#include <tlm>
#include <vector>

#include "halfspace/timing/systemc/credit_link.hpp"
#include "halfspace/timing/systemc/depth_layout.hpp"
#include "halfspace/timing/systemc/stage_meter.hpp"
#include "halfspace/timing/systemc/tokens.hpp"

namespace halfspace::systemc {

/// What the command processor asks of the z cache, when the pipe is empty.
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

class EarlyZ : public sc_core::sc_module, public DepthControl {
 public:
  SC_HAS_PROCESS(EarlyZ);
  /// Depth lies in memory from address `base` on; see DepthLayout.
  EarlyZ(const sc_core::sc_module_name& name, RunState& run, std::uint64_t base);

  sc_core::sc_port<CreditIn<BurstToken>> in;
  sc_core::sc_port<CreditOut<TestedToken>> out;
  tlm_utils::simple_initiator_socket<EarlyZ> memory;

  /// Fills the surfaces in memory with what they hold before the first command, in no time.
  void begin_frame();
  void clear(std::uint32_t surface, std::uint32_t code) override;
  Cycle wait_until_written() override;
  Cycle flush(Cycle begin) override;
  /// Reads the image of a surface from memory, in no time. Lines that are only marked cleared have their
  /// value.
  void read_surface(std::uint32_t surface, TiledImage<std::uint32_t>& codes);

  [[nodiscard]] StageMeter& lookup_meter() { return lookup_meter_; }
  [[nodiscard]] StageMeter& test_meter() { return test_meter_; }
  [[nodiscard]] CreditLinkBase& pending() { return pending_; }
  [[nodiscard]] CreditLinkBase& fill_buffers() { return fills_; }
  [[nodiscard]] CreditLinkBase& write_buffer() { return writes_; }

 private:
  /// A line of memory on its way out of the cache.
  struct Exit {
    bool looked_up = false;   ///< its slot is given away by the lookup, and the test has not come to it
    std::uint64_t write = 0;  ///< number of its write-back, 0 where it was clean
    Cycle left = 0;           ///< first cycle in which it may be asked for
  };

  // Lookup.
  void look_up_bursts();
  void look_up(Cycle at);
  Cycle resolve(int part, Cycle earliest);
  Cycle request(std::uint32_t line);
  // Test.
  void test_bursts();
  int replace_lines(const PendingToken& token);
  void move_lines(const PendingToken& token, Cycle at);
  void take_victim(const ZLines::Victim& victim, std::uint32_t slot, DrawWork* work, Cycle at);
  template <int TileSize>
  void test(PendingToken& token, TestedToken& tested);
  // Write-back.
  void write_back();
  void send(DrawWork* work, std::uint32_t line, const std::vector<std::uint32_t>& codes, Cycle at);

  void access(tlm::tlm_command command, std::uint32_t line, std::vector<std::uint8_t>& bytes,
              sc_core::sc_time& delay);
  void access_in_no_time(tlm::tlm_command command, std::uint32_t line, std::vector<std::uint8_t>& bytes);
  void count_transfer(std::uint64_t CycleStats::*channel, std::uint32_t line, int width, DrawWork* work);
  [[nodiscard]] std::uint32_t line_of(const PendingToken& token, int part) const;

  RunState& run_;
  std::uint64_t base_;
  StageMeter lookup_meter_;
  StageMeter test_meter_;
  CreditLink<PendingToken> pending_;
  CreditLink<FillToken> fills_;
  CreditLink<WriteToken> writes_;
  DepthLayout layout_;

  // What the lookup knows.
  ZTags tags_;
  std::vector<std::uint32_t> line_of_slot_;
  PendingToken looked_up_;  ///< at work
  Cycle next_lookup_ = 0;   ///< first cycle in which the next burst may be taken
  std::vector<std::uint8_t> read_bytes_;

  // What the test knows.
  ZLines lines_;
  std::vector<std::vector<std::uint32_t>> codes_;  ///< by slot: the data of the cache
  std::vector<std::uint32_t> clear_code_;          ///< by surface
  std::array<ZLines::Victim, kMaxZParts> victims_;
  Cycle next_test_ = 0;

  // What they tell each other.
  std::vector<Exit> exits_;  ///< by line of memory
  sc_core::sc_event exit_changed_{"exit_changed"};

  // Write-back.
  WriteToken writing_;
  std::uint64_t writes_sent_ = 0;
  std::uint64_t writes_done_ = 0;
  Cycle next_write_ = 0;  ///< first cycle after the last write
  std::vector<std::uint8_t> write_bytes_;
};

}  // namespace halfspace::systemc
