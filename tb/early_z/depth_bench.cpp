/// Bench of depth_interpolator, one quad wide: the RTL against model/halfspace/units/depth_interpolator.hpp,
/// sample by sample, a quad a cycle. The build says which interpolator it is, in how many cycles.
#include <fmt/format.h>
#include <verilated.h>

#include <CLI/CLI.hpp>
#include <array>
#include <bit>
#include <cstdint>
#include <cstdio>
#include <deque>
#include <vector>

#include "common/failure.hpp"
#include "common/ports.hpp"
#include "early_z/triangles.hpp"
#include "halfspace/units/link_packets.hpp"
#include "halfspace/units/packing.hpp"
#include "halfspace/units/quad_generator.hpp"

#include HALFSPACE_MODEL_HEADER

namespace halfspace::tb {
namespace {

constexpr int kTileSize = 8;
constexpr std::size_t kLatency = HALFSPACE_LATENCY;
constexpr std::size_t kTilesOfTriangle = 4;

struct Expected {
  DepthFormat format = DepthFormat::kNone;
  std::uint8_t mask = 0;
  std::array<std::uint32_t, 4> code{};
};

class DepthBench {
 public:
  DepthBench(std::uint64_t seed, bool fault) : random_(seed), fault_(fault) {
    context_.randReset(2);
    context_.randSeed(static_cast<int>(seed & 0x7fffffff) | 1);
    dut_ = std::make_unique<HALFSPACE_MODEL>(&context_);
  }
  ~DepthBench() { dut_->final(); }

  int run(std::uint64_t samples) {
    while (!failed_ && compared_ < samples) {
      triangle();
    }
    if (failed_) {
      return static_cast<int>(FailureKind::kPayload);
    }
    fmt::print(
        "PASS depth_interpolator: {} samples compared (unorm16 {}, unorm24 {}, float32 {}), {} of them at "
        "a vertex depth, {} zero or subnormal\n",
        compared_, of_format_[1], of_format_[2], of_format_[4], at_limit_, subnormal_);
    return 0;
  }

 private:
  void triangle() {
    static constexpr std::array<DepthFormat, 4> kFormats = {DepthFormat::kUnorm16, DepthFormat::kUnorm24,
                                                            DepthFormat::kFloat32, DepthFormat::kFloat32};
    const DepthFormat format = kFormats[random_.below(4)];
    constexpr Squares kSquares{.mode = static_cast<Conservative>(HALFSPACE_CONSERVATIVE),
                               .uncertainty = HALFSPACE_UNCERTAINTY};
    const bool by_square = kSquares.mode != Conservative::kOff && random_.below(4) != 0;
    const Squares squares = by_square ? kSquares : Squares{};
    const SetupTriangle triangle =
        random_triangle(widths_, format, interpolator_, 512, 512, random_, squares);
    const EarlyZState state{.format = format,
                            .interpolator = interpolator_,
                            .sub_pixel_bits = widths_.SubPixelBits,
                            .square_reach = squares.reach(widths_),
                            .samples = standard_samples(widths_.PixelSamples)};
    std::vector<std::uint32_t> words(words_for(packed_bits<DepthEquationPacket>(widths_)));
    pack(to_packet(triangle, format, interpolator_), widths_, words);
    set_port(dut_->equation_i, words);
    dut_->format_i = static_cast<std::uint8_t>(format);
    low_ = triangle.depth.min_code;
    high_ = triangle.depth.max_code;
    for (const QuadBurst& burst : bursts_of(widths_, triangle, kTilesOfTriangle, random_)) {
      TileCodes<kTileSize> codes{};
      interpolate_tile<kTileSize>(triangle, burst, state, codes);
      std::vector<std::uint32_t> e(words_for(2 * widths_.EdgeBits));
      insert_bits(e, 0, widths_.EdgeBits, static_cast<std::uint64_t>(burst.coverage.e[0]));
      insert_bits(e, widths_.EdgeBits, widths_.EdgeBits, static_cast<std::uint64_t>(burst.coverage.e[1]));
      set_port(dut_->e_i, e);
      dut_->tile_x_i = burst.coverage.tile_x;
      dut_->tile_y_i = burst.coverage.tile_y;
      for_each_quad<kTileSize>(burst, [&](const Quad& quad) { send(quad, format, codes); });
    }
  }

  void send(const Quad& quad, DepthFormat format, const TileCodes<kTileSize>& codes) {
    Expected next{.format = format, .mask = quad.mask, .code = {}};
    for (int s = 0; s < 4; ++s) {
      next.code[static_cast<std::size_t>(s)] =
          codes[static_cast<std::size_t>((quad.y + s / 2) * kTileSize + quad.x + s % 2)];
    }
    dut_->valid_i = 1;
    dut_->index_i = static_cast<std::uint8_t>(quad.y / 2 * (kTileSize / 2) + quad.x / 2);
    dut_->mask_i = quad.mask;
    dut_->clk_i = 0;
    dut_->eval();
    if (expected_.size() == kLatency) {
      compare(expected_.front());
      expected_.pop_front();
    }
    expected_.push_back(next);
    dut_->clk_i = 1;
    dut_->eval();
  }

  void compare(const Expected& expected) {
    std::vector<std::uint32_t> got;
    get_port(dut_->code_o, got);
    for (std::size_t s = 0; s < 4 && !failed_; ++s) {
      if ((expected.mask >> s & 1) == 0) {
        continue;
      }
      const std::uint32_t code = got[s] ^ (fault_ && compared_ == 1000 ? 1u : 0u);
      if (code != expected.code[s]) {
        fmt::print("FAIL depth_interpolator: payload: sample {}, format {}: expected {:#x}, got {:#x}\n",
                   compared_, static_cast<int>(expected.format), expected.code[s], code);
        failed_ = true;
      }
      ++compared_;
      ++of_format_[static_cast<std::size_t>(expected.format)];
      at_limit_ += code == low_ || code == high_ ? 1 : 0;
      subnormal_ += expected.format == DepthFormat::kFloat32 && code < 0x800000u ? 1 : 0;
    }
  }

  Widths widths_{.SubPixelBits = HALFSPACE_SUB_PIXEL_BITS, .PixelSamples = HALFSPACE_SAMPLES};
  DepthInterpolator interpolator_ = static_cast<DepthInterpolator>(HALFSPACE_INTERPOLATOR);
  Random random_;
  bool fault_;
  VerilatedContext context_;
  std::unique_ptr<HALFSPACE_MODEL> dut_;
  std::deque<Expected> expected_;
  std::uint32_t low_ = 0;  ///< of the triangle that is sent
  std::uint32_t high_ = 0;
  std::uint64_t compared_ = 0;
  std::array<std::uint64_t, 5> of_format_{};
  std::uint64_t at_limit_ = 0;
  std::uint64_t subnormal_ = 0;
  bool failed_ = false;
};

}  // namespace
}  // namespace halfspace::tb

int main(int argc, char** argv) {
  std::uint64_t samples = 200000;
  std::uint64_t seed = 1;
  bool fault = false;
  CLI::App app{"Compares the RTL of depth_interpolator with its C++ definition"};
  app.add_option("--samples", samples, "covered samples to compare")->capture_default_str();
  app.add_option("--seed", seed, "of triangles and of registers at the start")->capture_default_str();
  app.add_flag("--fault", fault, "flip a bit of a code, which the comparison must find");
  CLI11_PARSE(app, argc, argv);
  return halfspace::tb::DepthBench(seed, fault).run(samples);
}
