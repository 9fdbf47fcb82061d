/// What a run of the verilated pipeline throws.
#pragma once

#include <stdexcept>

namespace halfspace {

/// The RTL came to rest with work left, or one of its assertions failed.
class RtlError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace halfspace
