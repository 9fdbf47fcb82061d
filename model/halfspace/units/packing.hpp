/// Packets as the vector of bits that SystemVerilog sees: the packed struct of the same fields, in 32-bit
/// words, the lowest bits in word 0 (the layout of Verilator's wide ports).
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "halfspace/numerics/widths.hpp"
#include "halfspace/units/packets.hpp"

namespace halfspace {

/// Elements of a field of this C++ type. A TileMask is one number.
template <class Field>
inline constexpr int kFieldElements = 1;
template <class Element, std::size_t N>
inline constexpr int kFieldElements<std::array<Element, N>> = static_cast<int>(N);

/// Elements of a field on the link. Some arrays are as long as a parameter says, and no longer than in C++.
template <class Packet, class Member>
constexpr int field_elements(const Widths& widths, Member /*member*/, int Widths::*count = nullptr) {
  return count != nullptr
             ? widths.*count
             : kFieldElements<std::remove_cvref_t<decltype(std::declval<Packet>().*std::declval<Member>())>>;
}

/// Bits of a packet.
template <class Packet>
constexpr int packed_bits(const Widths& widths) {
  int bits = 0;
  Packet::fields([&](const char*, auto member, int Widths::*width, Sign, auto... count) {
    bits += widths.*width * field_elements<Packet>(widths, member, count...);
  });
  return bits;
}

constexpr std::size_t words_for(int bits) { return (static_cast<std::size_t>(bits) + 31) / 32; }

/// Words of a packet, for arrays of static size.
template <class Packet, int TileSize, int SubPixelBits>
inline constexpr std::size_t kPackedWords = words_for(packed_bits<Packet>(Widths{.SubPixelBits = SubPixelBits,
                                                                                 .TileSize = TileSize}));

/// Writes the low `width` bits of `value`, 1 to 64, to bits that are still zero.
constexpr void insert_bits(std::span<std::uint32_t> words, int lsb, int width, std::uint64_t value) {
  value = width < 64 ? value & ((std::uint64_t{1} << width) - 1) : value;
  for (int done = 0; done < width;) {
    const int bit = (lsb + done) % 32;
    words[static_cast<std::size_t>((lsb + done) / 32)] |= static_cast<std::uint32_t>(value >> done) << bit;
    done += 32 - bit;
  }
}

/// Reads `width` bits, 1 to 64.
constexpr std::uint64_t extract_bits(std::span<const std::uint32_t> words, int lsb, int width) {
  std::uint64_t value = 0;
  for (int done = 0; done < width;) {
    const int bit = (lsb + done) % 32;
    value |= std::uint64_t{words[static_cast<std::size_t>((lsb + done) / 32)] >> bit} << done;
    done += 32 - bit;
  }
  return width < 64 ? value & ((std::uint64_t{1} << width) - 1) : value;
}

/// The low `width` bits of `value` as a signed number.
constexpr std::int64_t sign_extend(std::uint64_t value, int width) {
  return static_cast<std::int64_t>(value << (64 - width)) >> (64 - width);
}

namespace detail {

template <class Number>
constexpr void put(std::span<std::uint32_t> words, int lsb, int width, const Number& value) {
  insert_bits(words, lsb, width, static_cast<std::uint64_t>(static_cast<std::int64_t>(value)));
}
constexpr void put(std::span<std::uint32_t> words, int lsb, int width, const TileMask& mask) {
  for (int done = 0; done < width; done += 64) {
    insert_bits(words, lsb + done, std::min(width - done, 64),
                mask.word[static_cast<std::size_t>(done / 64)]);
  }
}

template <class Number>
constexpr void get(std::span<const std::uint32_t> words, int lsb, int width, Sign sign, Number& value) {
  const std::uint64_t bits = extract_bits(words, lsb, width);
  value =
      static_cast<Number>(sign == Sign::kSigned ? sign_extend(bits, width) : static_cast<std::int64_t>(bits));
}
constexpr void get(std::span<const std::uint32_t> words, int lsb, int width, Sign /*sign*/, TileMask& mask) {
  mask = TileMask{};
  for (int done = 0; done < width; done += 64) {
    mask.word[static_cast<std::size_t>(done / 64)] =
        extract_bits(words, lsb + done, std::min(width - done, 64));
  }
}

template <class Number>
constexpr bool fits(int width, Sign sign, const Number& value) {
  if (width >= std::numeric_limits<Number>::digits + (std::is_signed_v<Number> ? 1 : 0)) {
    return sign == Sign::kSigned || value >= 0;
  }
  const auto wide = static_cast<std::int64_t>(value);
  return sign == Sign::kSigned ? sign_extend(static_cast<std::uint64_t>(wide), width) == wide
                               : wide >> width == 0;
}
constexpr bool fits(int width, Sign /*sign*/, const TileMask& mask) {
  for (int word = 0; word < 4; ++word) {
    const int bits = std::clamp(width - 64 * word, 0, 64);
    if (bits < 64 && mask.word[static_cast<std::size_t>(word)] >> bits != 0) {
      return false;
    }
  }
  return true;
}

/// Calls visit(element) for `count` elements of a field, the highest first: that is the order of a packed
/// array.
template <class Field, class Visit>
constexpr void for_each_element(Field& field, int count, Visit&& visit) {
  if constexpr (requires { field.size(); }) {
    for (auto i = static_cast<std::size_t>(count); i-- > 0;) {
      visit(field[i]);
    }
  } else {
    visit(field);
  }
}

}  // namespace detail

/// True when every field is in the range of its width: then unpack(pack(packet)) is the packet.
template <class Packet>
constexpr bool fits_widths(const Packet& packet, const Widths& widths) {
  bool fits = true;
  Packet::fields([&](const char*, auto member, int Widths::*width, Sign sign, auto... count) {
    detail::for_each_element(
        packet.*member, field_elements<Packet>(widths, member, count...),
        [&](const auto& element) { fits = fits && detail::fits(widths.*width, sign, element); });
  });
  return fits;
}

/// Fills `words`, words_for(packed_bits<Packet>(widths)) of them. A value too large for its field is cut off.
template <class Packet>
constexpr void pack(const Packet& packet, const Widths& widths, std::span<std::uint32_t> words) {
  for (std::uint32_t& word : words) {
    word = 0;
  }
  int lsb = packed_bits<Packet>(widths);
  Packet::fields([&](const char*, auto member, int Widths::*width, Sign, auto... count) {
    detail::for_each_element(packet.*member, field_elements<Packet>(widths, member, count...),
                             [&](const auto& element) {
                               lsb -= widths.*width;
                               detail::put(words, lsb, widths.*width, element);
                             });
  });
}

template <class Packet>
constexpr Packet unpack(std::span<const std::uint32_t> words, const Widths& widths) {
  Packet packet;
  int lsb = packed_bits<Packet>(widths);
  Packet::fields([&](const char*, auto member, int Widths::*width, Sign sign, auto... count) {
    detail::for_each_element(packet.*member, field_elements<Packet>(widths, member, count...),
                             [&](auto& element) {
                               lsb -= widths.*width;
                               detail::get(words, lsb, widths.*width, sign, element);
                             });
  });
  return packet;
}

/// Where one number of a packet lies in its bits.
struct FieldSlot {
  std::string name;  ///< "tile_x", "e[2]"
  int lsb = 0;
  int width = 0;
  Sign sign = Sign::kUnsigned;
};

/// All numbers of a packet, the most significant first: for reports on packed words.
template <class Packet>
std::vector<FieldSlot> field_slots(const Widths& widths) {
  std::vector<FieldSlot> slots;
  int lsb = packed_bits<Packet>(widths);
  Packet::fields([&](const char* name, auto member, int Widths::*width, Sign sign, auto... count) {
    using Field = std::remove_cvref_t<decltype(std::declval<Packet>().*member)>;
    const int elements = field_elements<Packet>(widths, member, count...);
    for (int i = elements; i-- > 0;) {
      lsb -= widths.*width;
      slots.push_back({kFieldElements<Field> == 1 ? name : name + ("[" + std::to_string(i) + "]"), lsb,
                       widths.*width, sign});
    }
  });
  return slots;
}

}  // namespace halfspace
