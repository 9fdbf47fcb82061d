/// Lines and points that Khronos's conformance tests draw, and what they ask of them, as data.
///
/// Source: KhronosGroup/VK-GL-CTS, external/vulkancts/modules/vulkan/rasterization/vktRasterizationTests.cpp
/// (LinesTestInstance, LineStripTestInstance, PointTestInstance: `generateLines`, `generatePointData`), drawn
/// to a square of 256 pixels. The rule is that of framework/common/tcuRasterizationVerifier.cpp, which has it
/// from the line rasterization rules of the specifications of OpenGL and Vulkan: no fragment is farther than
/// a pixel from one of the diamond-exit rule, there is at most one more or less of them, and one in each
/// column (row, where the line is y-major).
#pragma once

#include <array>
#include <vector>

namespace halfspace::published {

inline constexpr int kKhronosSide = 256;  ///< pixels

/// A vertex in clip space; z is 0 and w is 1.
struct ClipPoint {
  float x;
  float y;
};

/// Two an element: the start and the end.
inline const std::array<std::vector<ClipPoint>, 3> kKhronosLines{{
    {{0.01F, 0.0F},
     {0.5F, 0.2F},
     {0.46F, 0.3F},
     {-0.3F, 0.2F},
     {-1.5F, -0.4F},
     {0.1F, 0.5F},
     {0.75F, -0.4F},
     {0.3F, 0.8F}},
    {{-0.499F, 0.128F},
     {-0.501F, -0.3F},
     {0.11F, -0.2F},
     {0.11F, 0.2F},
     {0.88F, 0.9F},
     {0.18F, -0.2F},
     {0.0F, 1.0F},
     {0.0F, -1.0F}},
    {{-0.9F, -0.3F},
     {1.1F, -0.9F},
     {0.7F, -0.1F},
     {0.11F, 0.2F},
     {0.88F, 0.7F},
     {0.8F, -0.7F},
     {0.9F, 0.7F},
     {-0.9F, 0.7F}},
}};

/// Each vertex but the first ends a line that starts at the one before.
inline const std::array<std::vector<ClipPoint>, 3> kKhronosStrips{{
    {{0.01F, 0.0F}, {0.5F, 0.2F}, {0.46F, 0.3F}, {-0.5F, 0.2F}},
    {{-0.499F, 0.128F}, {-0.501F, -0.3F}, {0.11F, -0.2F}, {0.11F, 0.2F}},
    {{-0.9F, -0.3F}, {0.9F, -0.9F}, {0.7F, -0.1F}, {0.11F, 0.2F}},
}};

/// Of size 1. A fragment is where its centre is in the square about the vertex.
inline const std::array<std::vector<ClipPoint>, 3> kKhronosPoints{{
    {{0.2F, 0.8F}, {0.5F, 0.2F}, {0.5F, 0.3F}, {-0.5F, 0.2F}, {-0.2F, -0.4F}, {-0.4F, 0.2F}},
    {{-0.499F, 0.128F}, {-0.501F, -0.3F}, {0.11F, -0.2F}, {0.11F, 0.2F}, {0.88F, 0.9F}, {0.4F, 1.2F}},
    {{-0.9F, -0.3F}, {0.3F, -0.9F}, {-0.4F, -0.1F}, {-0.11F, 0.2F}, {0.88F, 0.7F}, {-0.4F, 0.4F}},
}};

/// PointSizeTestInstance: a point in the middle of the target is so many pixels wide and high as its size
/// says, rounded.
inline constexpr ClipPoint kKhronosMiddle{0, 0};

}  // namespace halfspace::published
