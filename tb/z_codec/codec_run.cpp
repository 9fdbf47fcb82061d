#include "z_codec/codec_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "halfspace/timing/contract.hpp"

namespace halfspace::tb {
namespace {

constexpr std::uint64_t kDrainCycles = 16;
// Independent seeds from one; the words are arbitrary.
constexpr std::uint64_t kEncoderSeed = 0xe2c0de;
constexpr std::uint64_t kDecoderSeed = 0xdec0de;

std::vector<FieldSlot> coded_fields(const CodecShape& shape) {
  std::vector<FieldSlot> fields;
  const int words = static_cast<int>(shape.words());
  for (int i = 0; i < words; ++i) {
    fields.push_back({.name = fmt::format("bytes[{}..{}]", 4 * i, 4 * i + 3), .lsb = 32 * i, .width = 32});
  }
  fields.push_back({.name = "shift", .lsb = 32 * words, .width = 2});
  return fields;
}

std::vector<FieldSlot> line_fields(const CodecShape& shape) {
  std::vector<FieldSlot> fields;
  for (int i = 0; i < static_cast<int>(shape.words()); ++i) {
    fields.push_back({.name = fmt::format("quad {} sample {}", i / 4, i % 4), .lsb = 32 * i, .width = 32});
  }
  return fields;
}

class CodecRun {
 public:
  CodecRun(CodecDut& dut, const CodecShape& shape, const CodecRunOptions& options, CodecCoverage& coverage)
      : dut_(dut),
        shape_(shape),
        options_(options),
        coverage_(coverage),
        encoder_("encoder", kZEncodeLatency, coded_fields(shape), options.encoder),
        decoder_("decoder", kZDecodeLatency, line_fields(shape), options.decoder),
        encoder_idle_(options.idle, 0, options.seed ^ kEncoderSeed),
        decoder_idle_(options.idle, 0, options.seed ^ kDecoderSeed),
        random_(options.seed) {
    if (options.directed) {
      directed_ = directed_lines(shape, random_);
    }
  }

  CodecRunResult run() {
    if (!options_.wave_file.empty()) {
      dut_.trace_to(options_.wave_file);
    }
    reset();
    std::uint64_t quiet = 0;
    while (!failure_ && quiet < kDrainCycles) {
      if (options_.reset_period != 0 && random_.below(options_.reset_period) == 0) {
        reset();
      }
      step();
      quiet = lines_left() || coded_left() || !encoder_.idle() || !decoder_.idle() ? 0 : quiet + 1;
    }
    if (!failure_) {
      fail(encoder_.finish(cycle_));
      fail(decoder_.finish(cycle_));
    }
    if (!options_.coverage_file.empty()) {
      dut_.write_coverage(options_.coverage_file);
    }
    return {failure_, cycle_, encoder_.compared(), decoder_.compared()};
  }

 private:
  [[nodiscard]] std::uint64_t count() const { return directed_.size() + options_.lines; }
  [[nodiscard]] bool lines_left() const { return lines_ < count(); }
  [[nodiscard]] bool coded_left() const { return coded_ < count(); }

  /// A cycle or more, in which the inputs say anything.
  void reset() {
    if (!encoder_.idle()) {
      coverage_.hit("encoder: reset with a line under way");
    }
    if (!decoder_.idle()) {
      coverage_.hit("decoder: reset with a line under way");
    }
    for (std::uint64_t left = 1 + random_.below(3); left > 0; --left) {
      anything();
      in_.reset = true;
      in_.line_valid = random_.below(2) == 0;
      in_.coded_valid = random_.below(2) == 0;
      dut_.settle(in_, out_);
      dut_.clock_edge();
      ++cycle_;
    }
    in_.reset = false;
    encoder_.clear();
    decoder_.clear();
  }

  void step() {
    anything();
    if (lines_left() && !encoder_idle_.stalled()) {
      take_line();
    }
    if (coded_left() && !decoder_idle_.stalled()) {
      take_coded();
    }
    dut_.settle(in_, out_);
    if (random_.below(16) == 0) {
      probe();
    }
    std::vector<std::uint32_t> coded = out_.coded_data;
    coded.push_back(out_.coded_shift);
    fail(encoder_.step(cycle_, out_.coded_valid, std::move(coded)));
    fail(decoder_.step(cycle_, out_.line_valid, out_.line_codes));
    dut_.clock_edge();
    if (dut_.assertion_failed()) {
      fail(Failure{FailureKind::kAssertion, cycle_, "an assertion of the RTL failed: see its message above"});
    }
    ++cycle_;
  }

  void anything() {
    const auto words = [&](std::vector<std::uint32_t>& port) {
      port.resize(shape_.words());
      std::ranges::generate(port, [&] { return static_cast<std::uint32_t>(random_.bits()); });
    };
    in_.line_valid = false;
    in_.line_half = random_.below(2) == 0;
    words(in_.line_codes);
    in_.coded_valid = false;
    in_.coded_half = random_.below(2) == 0;
    in_.coded_shift = static_cast<std::uint8_t>(random_.below(4));
    words(in_.coded_data);
  }

  void take_line() {
    const CodecLine line = lines_ < directed_.size() ? directed_[lines_] : random_line(shape_, random_);
    ++lines_;
    const CodedLine coded = encoded(line, shape_);
    std::vector<std::uint32_t> packet = port_words(coded.bytes, shape_.words(), nullptr);
    packet.push_back(static_cast<std::uint32_t>(coded.shift));
    const bool faulty = encoder_.expected() == options_.encoder.fault_packet;
    encoder_.expect(cycle_, packet);
    in_.line_valid = true;
    in_.line_half = line.half != (faulty && options_.encoder.fault == CodecFault::kOtherFormat);
    in_.line_codes = by_quad(line.codes, shape_.widths.TileSize);
    coverage_.line(line, coded);
    coverage_.taken("encoder", cycle_ - line_at_, line.half, line_half_);
    line_at_ = cycle_;
    line_half_ = line.half;
  }

  void take_coded() {
    const CodedLine coded =
        coded_ < directed_.size() ? encoded(directed_[coded_], shape_) : random_coded_line(shape_, random_);
    ++coded_;
    std::vector<std::uint32_t> codes;
    z_decode(coded.bytes, shape_.line(coded.half), codes);
    const bool faulty = decoder_.expected() == options_.decoder.fault_packet;
    decoder_.expect(cycle_, by_quad(codes, shape_.widths.TileSize));
    in_.coded_valid = true;
    in_.coded_half = coded.half != (faulty && options_.decoder.fault == CodecFault::kOtherFormat);
    in_.coded_shift = static_cast<std::uint8_t>(coded.shift);
    if (faulty && options_.decoder.fault == CodecFault::kOtherShift) {
      in_.coded_half = true;  // the fewest sizes
      in_.coded_shift = kMostCodedShift;
    }
    in_.coded_data = port_words(coded.bytes, shape_.words(), &random_);
    coverage_.coded(coded);
    coverage_.taken("decoder", cycle_ - coded_at_, coded.half, coded_half_);
    coded_at_ = cycle_;
    coded_half_ = coded.half;
  }

  /// Changes every input within the cycle; an output that follows is a path from pin to pin.
  void probe() {
    const CodecInputs was_in = in_;
    const CodecOutputs was = out_;
    anything();
    in_.line_valid = !was_in.line_valid;
    in_.coded_valid = !was_in.coded_valid;
    dut_.settle(in_, out_);
    if (out_ != was) {
      fail(Failure{FailureKind::kHandshake, cycle_, "an output follows an input within the cycle"});
    }
    in_ = was_in;
    dut_.settle(in_, out_);
  }

  /// The first failure counts.
  void fail(std::optional<Failure> failure) {
    if (!failure_) {
      failure_ = std::move(failure);
    }
  }

  CodecDut& dut_;
  CodecShape shape_;
  CodecRunOptions options_;
  CodecCoverage& coverage_;
  CodecLink encoder_;
  CodecLink decoder_;
  Staller encoder_idle_;
  Staller decoder_idle_;
  Random random_;
  std::vector<CodecLine> directed_;
  CodecInputs in_;
  CodecOutputs out_;
  std::optional<Failure> failure_;
  std::uint64_t cycle_ = 0;
  std::uint64_t lines_ = 0;
  std::uint64_t coded_ = 0;
  std::uint64_t line_at_ = 0;
  std::uint64_t coded_at_ = 0;
  bool line_half_ = false;
  bool coded_half_ = false;
};

}  // namespace

CodecRunResult run_codec(CodecDut& dut, const CodecShape& shape, const CodecRunOptions& options,
                         CodecCoverage& coverage) {
  return CodecRun(dut, shape, options, coverage).run();
}

}  // namespace halfspace::tb
