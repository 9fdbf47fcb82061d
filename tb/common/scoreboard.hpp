/// The reference queue of a link: what should come, compared with what comes.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "failure.hpp"
#include "halfspace/units/packing.hpp"

namespace halfspace::tb {

class Scoreboard {
 public:
  explicit Scoreboard(std::vector<FieldSlot> fields) : fields_(std::move(fields)) {}

  void expect(std::span<const std::uint32_t> packet) { expected_.emplace_back(packet.begin(), packet.end()); }

  /// Compares the next packet. The verdict on a packet that is another's may wait for one more.
  std::optional<Failure> receive(std::uint64_t cycle, std::span<const std::uint32_t> packet);

  /// The verdict when nothing more will come.
  [[nodiscard]] std::optional<Failure> finish(std::uint64_t cycle) const;

  void clear() {
    expected_.clear();
    last_.clear();
    skipped_.reset();
  }

  [[nodiscard]] std::size_t outstanding() const { return expected_.size(); }
  [[nodiscard]] std::uint64_t received() const { return received_; }

 private:
  using Words = std::vector<std::uint32_t>;

  /// The first packet expected came not, but the one after it.
  struct Skipped {
    Words packet;
    std::uint64_t index = 0;
    std::uint64_t cycle = 0;
  };

  [[nodiscard]] std::string first_difference(const Words& expected, std::span<const std::uint32_t> got) const;
  [[nodiscard]] Failure missing() const;

  std::vector<FieldSlot> fields_;
  std::deque<Words> expected_;
  Words last_;
  std::optional<Skipped> skipped_;
  std::uint64_t received_ = 0;
};

}  // namespace halfspace::tb
