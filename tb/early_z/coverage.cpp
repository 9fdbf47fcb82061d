#include "early_z/coverage.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>

namespace halfspace::tb {
namespace {

constexpr std::array<const char*, 5> kFormatNames = {"none", "unorm16", "unorm24", "unorm32", "float32"};

std::string state_bin(const EarlyZState& state) {
  return fmt::format("state {} func {} {}", kFormatNames[static_cast<std::size_t>(state.format)],
                     static_cast<int>(state.func), state.write ? "write" : "no write");
}

std::string miss_bin(const char* made, const char* victim) {
  return fmt::format("miss {} victim {}", made, victim);
}

std::string shift_bin(const char* what, int shift) {
  return fmt::format("line {} in 1/{} of its bytes", what, 1 << shift);
}

/// Whether a flush of dirty lines, one a cycle, can find the write buffer full: writing is slow enough, and
/// there are lines enough.
bool flush_can_wait(const EarlyZShape& shape) {
  const int write = std::max(1, shape.line_bytes() / shape.write_bytes);
  for (int line = shape.write_buffers; line < shape.lines; ++line) {
    if ((line - shape.write_buffers + 1) * write + 1 + shape.encode() > line) {
      return true;
    }
  }
  return false;
}

}  // namespace

ZCoverage::ZCoverage(const EarlyZShape& shape) {
  for (const DepthFormat format : {DepthFormat::kUnorm16, DepthFormat::kUnorm24, DepthFormat::kFloat32}) {
    for (int func = 0; func < 8; ++func) {
      for (const bool write : {false, true}) {
        counts_[state_bin(
            {.test = true, .write = write, .func = static_cast<DepthFunc>(func), .format = format})] = 0;
      }
    }
    counts_[fmt::format("test off {}", kFormatNames[static_cast<std::size_t>(format)])] = 0;
  }
  counts_["test off none"] = 0;
  for (const char* made : {"fetched", "overwritten", "cleared"}) {
    for (const char* victim : {"none", "clean", "dirty"}) {
      counts_[miss_bin(made, victim)] = 0;
    }
  }
  for (int shift = 1; shape.compression && shift <= kMostCodedShift; ++shift) {
    if (shape.line_bytes() >> shift >= kLeastCodedBytes) {
      counts_[shift_bin("fetched", shift)] = 0;
      counts_[shift_bin("written", shift)] = 0;
    }
  }
  counts_["hit"] = 0;
  for (int missed = 1; missed <= shape.widths.ZParts; ++missed) {
    counts_[fmt::format("parts missed {}", missed)] = 0;
  }
  if (shape.widths.ZParts > 1) {
    counts_["one part hits, one misses"] = 0;
  }
  for (int beats = 1; beats <= shape.widths.TileQuads / shape.widths.QuadWidth; ++beats) {
    counts_[fmt::format("beats {}", beats)] = 0;
  }
  for (const char* term : {"arrive", "lookup", "pending"}) {
    counts_[fmt::format("f decided by {}", term)] = 0;
  }
  for (const char* term : {"order", "leaving", "fill buffers"}) {
    counts_[fmt::format("r decided by {}", term)] = 0;
  }
  for (const char* term : {"lookup", "test", "fill", "write buffer", "credit"}) {
    counts_[fmt::format("b decided by {}", term)] = 0;
  }
  for (const char* bin : {"clear", "flush clean", "flush dirty"}) {
    counts_[bin] = 0;
  }
  if (shape.late_queue != 0) {
    counts_["b decided by late"] = 0;
    for (const char* term : {"lookup", "test", "shader", "offered", "stages"}) {
      counts_[fmt::format("d decided by {}", term)] = 0;
    }
    for (int beats = 1; beats <= shape.widths.TileQuads / shape.widths.TestWidth; ++beats) {
      counts_[fmt::format("late write beats {}", beats)] = 0;
    }
    for (const char* bin :
         {"late writes before a burst: line hit", "late writes before a burst: line replaced",
          "late writes before a clear", "late writes before a flush", "shader keeps all", "shader keeps none",
          "shader keeps some", "late burst of which nothing passed"}) {
      counts_[bin] = 0;
    }
    if (shape.late_queue > 1) {
      counts_["d decided by order"] = 0;
      counts_["late writes back to back"] = 0;
    }
    // Those that are out write to different lines.
    if (shape.late_queue < shape.lines) {
      counts_["late writes before a burst: queue full"] = 0;
    }
    if (shape.widths.ZParts > 1) {
      counts_["shader keeps nothing of a part"] = 0;
    }
  }
  if (flush_can_wait(shape)) {
    counts_["flush waits for the write buffer"] = 0;
  }
}

void ZCoverage::command(const Command& command) {
  switch (command.kind) {
    case CommandKind::kClear:
      hit("clear");
      return;
    case CommandKind::kFlush:
      hit(command.flushed.empty() ? "flush clean" : "flush dirty");
      return;
    case CommandKind::kBurst:
      break;
  }
  hit(fmt::format("beats {}", command.beats.size()));
  if (command.state.late) {
    late(command.late);
  }
  if (!command.state.test) {
    hit(fmt::format("test off {}", kFormatNames[static_cast<std::size_t>(command.state.format)]));
    return;
  }
  hit(state_bin(command.state));
  const auto touched = static_cast<std::size_t>(std::popcount(command.touched));
  if (touched > command.misses.count) {
    hit("hit");
    if (command.misses.count != 0) {
      hit("one part hits, one misses");
    }
  }
  if (command.misses.count != 0) {
    hit(fmt::format("parts missed {}", command.misses.count));
  }
  for (const int shift : command.fetched) {
    if (shift != 0) {
      hit(shift_bin("fetched", shift));
    }
  }
  for (const int shift : command.written) {
    if (shift != 0) {
      hit(shift_bin("written", shift));
    }
  }
  for (const ZMiss& miss : command.misses.parts()) {
    hit(miss_bin(miss.fetch         ? "fetched"
                 : miss.overwritten ? "overwritten"
                                    : "cleared",
                 miss.victim == kNoZLine ? "none"
                 : miss.write_back       ? "dirty"
                                         : "clean"));
  }
}

void ZCoverage::late(const LateWrite& late) {
  if (!late.out) {
    hit("late burst of which nothing passed");
    return;
  }
  hit(late.kept == 0             ? "shader keeps none"
      : late.kept == late.passed ? "shader keeps all"
                                 : "shader keeps some");
  if (late.kept != 0 && late.kept_parts != late.passed_parts) {
    hit("shader keeps nothing of a part");
  }
}

double ZCoverage::percent() const {
  const auto covered = std::ranges::count_if(counts_, [](const auto& bin) { return bin.second != 0; });
  return 100.0 * static_cast<double>(covered) / static_cast<double>(counts_.size());
}

void ZCoverage::report() const {
  for (const auto& [bin, count] : counts_) {
    if (count == 0) {
      fmt::print("not covered: {}\n", bin);
    }
  }
  fmt::print("functional coverage: {:.1f} % of {} bins\n", percent(), counts_.size());
}

}  // namespace halfspace::tb
