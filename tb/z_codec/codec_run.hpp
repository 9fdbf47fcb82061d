/// One run: lines into z_encoder, coded lines into z_decoder, beside each other.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/failure.hpp"
#include "common/staller.hpp"
#include "z_codec/codec_coverage.hpp"
#include "z_codec/codec_link.hpp"
#include "z_codec/lines.hpp"
#include "z_codec/models.hpp"

namespace halfspace::tb {

struct CodecRunOptions {
  std::uint64_t seed = 1;
  StallProfile idle = StallProfile::kNone;  ///< of both sources
  std::uint64_t lines = 0;                  ///< random ones for either side, behind the directed ones
  bool directed = false;
  std::uint64_t reset_period = 0;  ///< mean cycles between resets; 0: none
  CodecChecks encoder;
  CodecChecks decoder;
  std::string wave_file;
  std::string coverage_file;
};

struct CodecRunResult {
  std::optional<Failure> failure;
  std::uint64_t cycles = 0;
  std::uint64_t encoded = 0;  ///< lines compared
  std::uint64_t decoded = 0;
};

CodecRunResult run_codec(CodecDut& dut, const CodecShape& shape, const CodecRunOptions& options,
                         CodecCoverage& coverage);

}  // namespace halfspace::tb
