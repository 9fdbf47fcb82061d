#include "halfspace/study/precision/depth_subjects.hpp"

#include <string_view>

#include "halfspace/study/precision/depth_arithmetic.hpp"
#include "halfspace/study/precision/unit_depth.hpp"

namespace halfspace::study {
namespace {

template <class Arithmetic, class... More>
DepthAt at(const DepthTriangle& triangle, DepthFormat format, More... more) {
  return [arithmetic = Arithmetic(triangle, format, more...)](std::int64_t x, std::int64_t y) {
    return arithmetic.code(x, y);
  };
}

DepthSubject unit(std::string_view kind, DepthInterpolator interpolator) {
  return {
      .name = std::string("unit_").append(kind),
      .computes = std::string("the machine's interpolator ").append(kind).append(", behind its front end"),
      .kind = std::string(kind),
      .unit = true,
      .prepare = [interpolator](const DepthTriangle& t, DepthFormat format, std::uint32_t size) {
        return at<UnitDepth>(t, format, interpolator, size);
      }};
}

template <class Plane>
DepthSubject floating(std::string_view number) {
  return {.name = std::string("plane_").append(number),
          .computes = std::string("z0 + dx (x - x0) + dy (y - y0), all in ").append(number),
          .kind = "plane",
          .prepare = [](const DepthTriangle& t, DepthFormat format, std::uint32_t) {
            return at<Plane>(t, format);
          }};
}

DepthSubject plane(int bits) {
  constexpr int kMostOfUnorm = 40;  // codes and fractions of a double's vertex depth
  return {.name = "plane_" + std::to_string(bits),
          .computes = "words with " + std::to_string(bits) +
                      " bits below 1, on float32 surfaces below the "
                      "power of two above the vertices",
          .kind = "plane",
          .bits = bits,
          .unorm = bits <= kMostOfUnorm,
          .prepare = [bits](const DepthTriangle& t, DepthFormat format, std::uint32_t) {
            return at<WordPlane>(t, format, bits);
          }};
}

DepthSubject barycentric(int width) {
  return {.name = "barycentric_" + std::to_string(width),
          .computes = "weights by a reciprocal of " + std::to_string(width) + " bits",
          .kind = "barycentric",
          .bits = width,
          .prepare = [width](const DepthTriangle& t, DepthFormat format, std::uint32_t) {
            return at<Barycentric>(t, format, width);
          }};
}

}  // namespace

const std::vector<DepthSubject>& depth_subjects() {
  static const std::vector<DepthSubject> kSubjects = [] {
    std::vector<DepthSubject> subjects{unit("plane", DepthInterpolator::kPlane),
                                       unit("barycentric", DepthInterpolator::kBarycentric),
                                       floating<FloatPlane>("float32"), floating<DoublePlane>("double")};
    for (const int bits : {24, 28, 31, 32, 36, 40, 48, 56, 63}) {
      subjects.push_back(plane(bits));
    }
    for (const int width : {16, 20, 24, 28, 32, 36}) {
      subjects.push_back(barycentric(width));
    }
    return subjects;
  }();
  return kSubjects;
}

}  // namespace halfspace::study
