/// Functional coverage of z_codec's bench: forms, sizes and limits on both sides, in bins that the
/// configuration can meet.
#pragma once

#include <string>

#include "common/bins.hpp"
#include "z_codec/lines.hpp"
#include "z_codec/models.hpp"

namespace halfspace::tb {

class CodecCoverage {
 public:
  explicit CodecCoverage(const CodecShape& shape);

  /// z_encoder takes a line, of which `coded` must come.
  void line(const CodecLine& line, const CodedLine& coded);
  /// z_decoder takes one.
  void coded(const CodedLine& coded);
  /// A side takes something, so many cycles after the last; of the format that it had.
  void taken(const std::string& side, std::uint64_t after, bool half, bool half_before);
  void hit(const std::string& name) { bins_.hit(name); }

  [[nodiscard]] bool report() const { return bins_.report(); }

 private:
  CodecShape shape_;
  Bins bins_;
};

}  // namespace halfspace::tb
