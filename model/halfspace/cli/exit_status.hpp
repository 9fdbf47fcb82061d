/// The exit status of the program.
#pragma once

#include <cstdint>

namespace halfspace {

/// As `diff` and `cmp` have it, with what is wrong with the command line apart.
enum class ExitStatus : std::uint8_t {
  kDone = 0,
  kDifferent = 1,  ///< the answer of a comparison or a check, or a fault of the model
  kUsage = 2,
  kTrouble = 3,  ///< an input, an output or memory
};

inline constexpr const char* kExitStatusHelp =
    "Exit status:\n"
    "  0  done; what was compared is the same\n"
    "  1  a difference: of two results, of the RTL and the model, or a law that is broken\n"
    "  2  usage: an option, a setting or a combination of them is wrong\n"
    "  3  trouble: an input cannot be used, an output cannot be written, or memory is not enough\n";

constexpr ExitStatus status_of(bool same) { return same ? ExitStatus::kDone : ExitStatus::kDifferent; }

}  // namespace halfspace
