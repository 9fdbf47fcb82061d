/// The exceptions of the library.
#pragma once

#include <stdexcept>

namespace halfspace {

/// Something given from outside cannot be used. what() is one line that names the thing, its value and what
/// would be legal.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// It is not in a file: an option, or a setting, of the caller.
class OptionError : public InputError {
 public:
  using InputError::InputError;
};

/// Two computations of one thing differ, or a machine rests with work left: a fault of the model.
class DisagreementError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace halfspace
