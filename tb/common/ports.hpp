/// Ports of verilated classes of any width as 32-bit words.
#pragma once

#include <verilated.h>

#include <algorithm>
#include <concepts>
#include <cstdint>
#include <span>
#include <vector>

namespace halfspace::tb {

template <std::size_t N>
void set_port(VlWide<N>& port, std::span<const std::uint32_t> words) {
  std::copy_n(words.begin(), N, &port[0]);
}
template <std::unsigned_integral Port>
void set_port(Port& port, std::span<const std::uint32_t> words) {
  std::uint64_t value = words[0];
  if (sizeof(Port) > 4 && words.size() > 1) {
    value |= std::uint64_t{words[1]} << 32;
  }
  port = static_cast<Port>(value);
}

/// The port itself, without a copy.
template <std::size_t N>
std::span<const std::uint32_t> words_of(const VlWide<N>& port) {
  return {&port[0], N};
}

template <std::size_t N>
void get_port(const VlWide<N>& port, std::vector<std::uint32_t>& words) {
  words.assign(&port[0], &port[0] + N);
}
template <std::unsigned_integral Port>
void get_port(Port port, std::vector<std::uint32_t>& words) {
  words.assign(1, static_cast<std::uint32_t>(port));
  if constexpr (sizeof(Port) > 4) {
    words.push_back(static_cast<std::uint32_t>(port >> 32));
  }
}

}  // namespace halfspace::tb
