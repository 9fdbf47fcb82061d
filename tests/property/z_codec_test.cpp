// z_codec loses nothing, and a line is as small as the better of its two forms allows.
#include "halfspace/units/z_codec.hpp"

#include <bit>
#include <catch2/catch.hpp>

#include "random.hpp"

namespace halfspace::testing {
namespace {

using Codes = std::vector<std::uint32_t>;

/// Planes, layers of planes, clears, noise, and codes near both ends of the range, which wrap.
Codes random_line(Random& random, const ZCodecShape& shape) {
  const std::uint32_t mask = shape.sample_bytes == 2 ? 0xFFFFu : ~0u;
  const auto layer = [&] {
    const std::int64_t base = pick(random, {std::int64_t{0}, std::int64_t{mask}, random.between(0, mask)});
    const int bits = static_cast<int>(random.between(0, 31));
    const std::int64_t steep = std::int64_t{1} << bits;
    const std::int64_t dx = random.between(-steep, steep);
    const std::int64_t dy = random.between(-steep, steep);
    const std::int64_t noise = random.between(0, 3) == 0 ? std::int64_t{1} << random.between(0, 12) : 1;
    return
        [=, &random](int x, int y) { return base + (dx * x + dy * y) / 16 + random.between(0, noise - 1); };
  };
  const auto below = layer();
  const auto above = layer();
  const int cut = static_cast<int>(random.between(0, 2 * shape.width));
  Codes codes;
  for (int y = 0; y < shape.height; ++y) {
    for (int x = 0; x < shape.width; ++x) {
      const std::int64_t code = x + y < cut ? above(x, y) : below(x, y);
      codes.push_back(static_cast<std::uint32_t>(code) & mask);
    }
  }
  return codes;
}

/// The form in which the codes fit into `bytes`, from the definition of the forms alone, by trying every
/// base.
ZForm form_in(const Codes& codes, const ZCodecShape& shape, int bytes) {
  const int bits = 8 * shape.sample_bytes;
  const std::uint64_t modulus = std::uint64_t{1} << bits;
  const auto half = [](std::int64_t numerator, int size) {
    const int divisor = size / 2;
    return numerator >= 0 ? numerator / divisor : -((-numerator + divisor - 1) / divisor);
  };
  const auto nearest_zero = [&](std::uint64_t value) {
    value %= modulus;
    return value >= modulus / 2 ? static_cast<std::int64_t>(value) - static_cast<std::int64_t>(modulus)
                                : static_cast<std::int64_t>(value);
  };
  const auto code = [&](int x, int y) {
    return std::uint64_t{codes[static_cast<std::size_t>(y * shape.width + x)]};
  };
  const std::int64_t dx = nearest_zero(code(shape.width / 2, 0) - code(0, 0));
  const std::int64_t dy = shape.height == 1 ? 0 : nearest_zero(code(0, shape.height / 2) - code(0, 0));
  std::vector<std::int64_t> above;
  for (int y = 0; y < shape.height; ++y) {
    for (int x = 0; x < shape.width; ++x) {
      const std::int64_t rise =
          half(x * dx, shape.width) + (shape.height == 1 ? 0 : half(y * dy, shape.height));
      above.push_back(nearest_zero(code(x, y) - code(0, 0) - static_cast<std::uint64_t>(rise)));
    }
  }
  const auto [lowest, highest] = std::minmax_element(above.begin(), above.end());
  const int plane_bits = (8 * bytes - 1 - 3 * bits) / shape.samples();
  if (*highest - *lowest < std::int64_t{1} << plane_bits) {
    return ZForm::kPlane;
  }
  const auto [least, most] = std::minmax_element(codes.begin(), codes.end());
  const int ends_bits = (8 * bytes - 1 - 2 * bits - shape.samples()) / shape.samples();
  const bool ends = std::all_of(codes.begin(), codes.end(), [&, l = *least, m = *most](std::uint32_t c) {
    return std::uint64_t{c} - l < std::uint64_t{1} << ends_bits || std::uint64_t{m} - c < std::uint64_t{1}
                                                                                              << ends_bits;
  });
  return ends ? ZForm::kEnds : ZForm::kPlain;
}

}  // namespace

TEST_CASE("z_codec: loses nothing, and is as small as its forms allow", "[property]") {
  Random random(seed());
  std::array<std::uint64_t, kMostCodedShift + 1> lines{};
  std::vector<std::uint8_t> bytes;
  Codes back;
  const std::uint64_t count = samples(1'000'000) / 50;
  for (std::uint64_t i = 0; i < count; ++i) {
    const int tile = pick(random, {4, 8, 8, 16});
    const ZCodecShape shape{
        .width = tile, .height = tile / pick(random, {1, 2, 4}), .sample_bytes = pick(random, {2, 4})};
    const Codes codes = random_line(random, shape);
    z_encode(codes, shape, bytes);
    z_decode(bytes, shape, back);
    REQUIRE(back == codes);
    int shift = kMostCodedShift;
    ZForm form = ZForm::kPlain;
    for (; shift > 0; --shift) {
      form = shape.bytes() >> shift < kLeastCodedBytes ? ZForm::kPlain
                                                       : form_in(codes, shape, shape.bytes() >> shift);
      if (form != ZForm::kPlain) {
        REQUIRE((bytes[0] & 1) == static_cast<int>(form));
        break;
      }
    }
    REQUIRE(z_coded_class(codes, shape) == ZCodedClass{.form = form, .shift = shift});
    REQUIRE(z_coded_shift(codes, shape) == shift);
    REQUIRE(static_cast<int>(bytes.size()) == shape.bytes() >> shift);
    ++lines[static_cast<std::size_t>(shift)];
  }
  CAPTURE(lines);
  for (const std::uint64_t found : lines) {
    CHECK(found > count / 100);
  }
}

}  // namespace halfspace::testing
