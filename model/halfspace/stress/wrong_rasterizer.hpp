/// Rasterizers that are wrong on purpose, each in one way: what the campaign must find.
#pragma once

#include <memory>
#include <span>
#include <string_view>

#include "halfspace/reference/methods.hpp"
#include "halfspace/stress/case.hpp"
#include "halfspace/stress/subject.hpp"

namespace halfspace::stress {

struct WrongRasterizer {
  std::string_view name;
  std::string_view wrong;  ///< what is, for people
  reference::TriangleMethod draw;
  void (*twist)(Frame& frame) = nullptr;  ///< what is wrong with the state of draws, before they are drawn
};

std::span<const WrongRasterizer> wrong_rasterizers();

/// Throws InputError, with the legal names.
const WrongRasterizer& wrong_rasterizer(std::string_view name);

std::unique_ptr<Subject> wrong_subject(const WrongRasterizer& wrong, const Precision& precision);

}  // namespace halfspace::stress
