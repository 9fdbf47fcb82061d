/// What goes into setup and what must come out of it, as the packed words of its links.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "halfspace/units/link_packets.hpp"
#include "halfspace/units/packing.hpp"
#include "models.hpp"

namespace halfspace::tb {

/// A triangle with the state of its draw.
struct SetupJob {
  ScreenTrianglePacket triangle;
  DrawStatePacket state;
};

/// What the C++ definition makes of a job.
struct SetupResult {
  SetupVerdict verdict = SetupVerdict::kZeroArea;
  SetupTriangle triangle;  ///< of a drawn one
};

[[nodiscard]] std::size_t input_words(const Widths& widths);
[[nodiscard]] std::vector<FieldSlot> output_fields(const Widths& widths);

void pack_job(const SetupJob& job, const Widths& widths, std::span<std::uint32_t> words);
[[nodiscard]] SetupJob unpack_job(std::span<const std::uint32_t> words, const Widths& widths);

[[nodiscard]] SetupResult reference(const SetupJob& job, const SetupModel& model);
/// The words on the output link for a drawn triangle.
[[nodiscard]] std::vector<std::uint32_t> output_words(const SetupJob& job, const SetupTriangle& triangle,
                                                      const SetupModel& model);

}  // namespace halfspace::tb
