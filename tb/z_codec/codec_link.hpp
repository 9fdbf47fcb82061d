/// What must come out of z_encoder or z_decoder, and in which cycle.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "common/failure.hpp"
#include "common/scoreboard.hpp"

namespace halfspace::tb {

/// Faults between the RTL and what checks it.
enum class CodecFault : std::uint8_t {
  kNone,
  kFlipBit,      ///< the lowest bit of a packet
  kFlipTop,      ///< the highest
  kDrop,         ///< a packet swallowed
  kSwap,         ///< a packet after its successor
  kDuplicate,    ///< a packet twice
  kLate,         ///< every packet one cycle late
  kExtra,        ///< valid where nothing is due
  kOtherFormat,  ///< the RTL hears of the other format
  kOtherShift,   ///< the decoder hears of a shift that no line has: for the assertion of the RTL
};

[[nodiscard]] std::optional<CodecFault> codec_fault_by_name(const std::string& name);

struct CodecChecks {
  CodecFault fault = CodecFault::kNone;
  std::uint64_t fault_packet = 0;
  bool packets = true;
  bool timing = true;
};

class CodecLink {
 public:
  CodecLink(std::string name, int latency, std::vector<FieldSlot> fields, const CodecChecks& checks)
      : name_(std::move(name)),
        latency_(latency),
        checks_(checks),
        last_width_(fields.back().width),
        scoreboard_(std::move(fields)) {}

  /// Taken in this cycle, so it comes `latency` cycles later.
  void expect(std::uint64_t cycle, const std::vector<std::uint32_t>& packet);
  /// What comes in this cycle.
  [[nodiscard]] std::optional<Failure> step(std::uint64_t cycle, bool valid,
                                            std::vector<std::uint32_t> packet);
  [[nodiscard]] std::optional<Failure> finish(std::uint64_t cycle) const;
  /// Reset.
  void clear();

  [[nodiscard]] bool idle() const { return due_.empty(); }
  [[nodiscard]] std::uint64_t compared() const { return scoreboard_.received(); }
  /// The number of the packet that is expected next.
  [[nodiscard]] std::uint64_t expected() const { return expected_; }

 private:
  /// What the checkers see.
  bool inject(bool valid, std::vector<std::uint32_t>& packet);
  bool take_held(std::vector<std::uint32_t>& packet, bool now);
  [[nodiscard]] Failure named(Failure failure) const;

  std::string name_;
  int latency_;
  CodecChecks checks_;
  int last_width_;  ///< of the last field, which is at the top
  Scoreboard scoreboard_;
  std::deque<std::uint64_t> due_;
  std::uint64_t expected_ = 0;
  std::uint64_t came_ = 0;  ///< from the RTL
  std::deque<std::vector<std::uint32_t>> held_;
  bool done_ = false;
};

}  // namespace halfspace::tb
