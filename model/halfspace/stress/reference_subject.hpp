/// The textbook rasterizers (docs/guides/reference.md), right and wrong ones, as what the stress campaign
/// draws with.
#pragma once

#include <memory>
#include <string_view>

#include "halfspace/stress/case.hpp"
#include "halfspace/stress/subject.hpp"

namespace halfspace::stress {

/// One of reference::methods(). Throws InputError, with the legal names.
std::unique_ptr<Subject> reference_subject(std::string_view method, const Precision& precision);

}  // namespace halfspace::stress
