/// The packets that are expected on a link, in order.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <span>
#include <vector>

namespace halfspace::c_api {

/// Packets of a fixed number of words, one after the other: a large triangle has millions.
class ExpectedPackets {
 public:
  explicit ExpectedPackets(std::size_t packet_words) : packet_words_(packet_words) {}

  [[nodiscard]] std::size_t packet_words() const { return packet_words_; }
  [[nodiscard]] std::size_t size() const { return words_.size() / packet_words_; }
  [[nodiscard]] std::uint64_t taken() const { return taken_; }

  void push(std::span<const std::uint32_t> packet) {
    words_.insert(words_.end(), packet.begin(), packet.end());
  }

  /// Copies a packet that is there: 0 is the next.
  void peek(std::size_t index, std::span<std::uint32_t> packet) const {
    const auto first = words_.begin() + static_cast<std::ptrdiff_t>(index * packet_words_);
    std::copy_n(first, packet_words_, packet.begin());
  }

  /// The packet that was taken last; empty before the first.
  [[nodiscard]] std::span<const std::uint32_t> last() const { return last_; }

  void pop() {
    last_.resize(packet_words_);
    peek(0, last_);
    words_.erase(words_.begin(), words_.begin() + static_cast<std::ptrdiff_t>(packet_words_));
    ++taken_;
  }

  /// Keeps the first `size` packets.
  void truncate(std::size_t size) { words_.resize(size * packet_words_); }

  void reset() {
    words_.clear();
    last_.clear();
    taken_ = 0;
  }

 private:
  std::size_t packet_words_;
  std::deque<std::uint32_t> words_;
  std::vector<std::uint32_t> last_;
  std::uint64_t taken_ = 0;
};

}  // namespace halfspace::c_api
