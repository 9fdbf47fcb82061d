/// What a run of the verilated pipeline throws.
#pragma once

#include "halfspace/numerics/error.hpp"

namespace halfspace {

/// The RTL came to rest with work left, or one of its assertions failed.
class RtlError : public DisagreementError {
 public:
  using DisagreementError::DisagreementError;
};

}  // namespace halfspace
