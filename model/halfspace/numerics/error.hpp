/// The one exception of the library: something given from outside cannot be used.
#pragma once

#include <stdexcept>

namespace halfspace {

/// what() is one line that names the thing, its value and what would be legal.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace halfspace
