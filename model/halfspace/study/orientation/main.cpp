/// halfspace_study_orientation: the grids of figure 2 of Kettner et al. 2008 by double, float32, and this
/// pipeline; tables in Markdown and a picture. Exit status 1 where the pipeline is wrong once.
#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "halfspace/study/orientation/grid_picture.hpp"
#include "halfspace/study/orientation/pipeline_orientation.hpp"

namespace halfspace::study {
namespace {

constexpr int kPoints = kGridSide * kGridSide;

std::string share(int count) { return fmt::format("{:.2f} %", 100.0 * count / kPoints); }

/// A row for each pivot. Returns the values of pivot p.
template <class Real>
Values print_signs(const Setting& setting, const Grid& grid, const Values& exact, const char* real) {
  Values seen_from_p;
  for (const Pivot pivot : {Pivot::kP, Pivot::kQ, Pivot::kR}) {
    const Values signs = over(grid, [&](const Triple& t) { return rounded_orientation<Real>(t, pivot); });
    const Errors wrong = errors(exact, signs);
    fmt::print("| {} | {} | {} | {} | {} | {} | {} |\n", setting.name, real,
               "pqr"[static_cast<std::size_t>(pivot)], share(wrong.false_zero), share(wrong.false_sign),
               share(wrong.opposite), share(wrong.all()));
    if (pivot == Pivot::kP) {
      seen_from_p = signs;
    }
  }
  return seen_from_p;
}

/// How many points have so many owners.
auto count(const Values& owners, int number) { return std::ranges::count(owners, number); }

/// What the pipeline makes of a grid.
struct Pipeline {
  Values signs;
  Values exact;  ///< of the snapped points
  Values shade;  ///< a chessboard of places: points of one colour beside each other became one point
  int places = 0;
  int wrong = 0;
  int not_once = 0;
};

Pipeline through_pipeline(const Grid& grid) {
  Pipeline pipeline;
  std::map<std::pair<std::int64_t, std::int64_t>, SnappedTriple> places;
  for (const Snapped& each : snapped(grid)) {
    const auto& [p, q, r] = each.points;
    const auto real = [](const reference::GridPoint& v) {
      return Point{static_cast<double>(v.x), static_cast<double>(v.y)};
    };
    pipeline.signs.push_back(each.orientation);
    pipeline.exact.push_back(exact_orientation({real(p), real(q), real(r)}));
    pipeline.shade.push_back(static_cast<int>((p.x + p.y) & 1));
    places[{p.x, p.y}] = each.points;
  }
  pipeline.places = static_cast<int>(places.size());
  pipeline.wrong = errors(pipeline.exact, pipeline.signs).all();
  for (const auto& [place, points] : places) {
    pipeline.not_once += covered(points) == 1 ? 0 : 1;
  }
  return pipeline;
}

/// Returns the exit status.
int study(const std::string& picture) {
  std::vector<Picture> pictures;
  std::string owners =
      "\n| setting | double: no half plane | both | float32: no half plane | both | pipeline: snapped places "
      "| "
      "orientations wrong | samples not covered once |\n|---|---:|---:|---:|---:|---:|---:|---:|\n";
  bool right = true;
  fmt::print(
      "| setting | arithmetic | pivot | 0 for a sign | a sign for 0 | the other sign | all wrong |\n"
      "|---|---|---|---:|---:|---:|---:|\n");
  for (const Setting& setting : settings()) {
    const Grid in_double = double_grid(setting);
    const Grid in_float = float_grid(setting);
    const Values exact_double = over(in_double, exact_orientation);
    const Values exact_float = over(in_float, exact_orientation);
    const Values double_signs = print_signs<double>(setting, in_double, exact_double, "double");
    const Values float_signs = print_signs<float>(setting, in_float, exact_float, "float32");
    const Values double_owners = over(in_double, rounded_owners<double>);
    const Values float_owners = over(in_float, rounded_owners<float>);
    const Pipeline pipeline = through_pipeline(in_float);
    right &= pipeline.wrong == 0 && pipeline.not_once == 0;
    owners += fmt::format("| {} | {} | {} | {} | {} | {} | {} | {} |\n", setting.name,
                          count(double_owners, 0), count(double_owners, 2), count(float_owners, 0),
                          count(float_owners, 2), pipeline.places, pipeline.wrong, pipeline.not_once);
    pictures.push_back(sign_picture(double_signs, exact_double));
    pictures.push_back(sign_picture(float_signs, exact_float));
    pictures.push_back(sign_picture(pipeline.signs, exact_float, pipeline.shade));
    pictures.push_back(owner_picture(double_owners));
    pictures.push_back(owner_picture(float_owners));
  }
  fmt::print("{}", owners);
  if (!picture.empty()) {
    write_png(picture, montage(pictures, 5));
  }
  return right ? 0 : 1;
}

}  // namespace
}  // namespace halfspace::study

int main(int argc, char** argv) {
  if (argc > 2) {
    fmt::print(stderr, "usage: halfspace_study_orientation [PICTURE.png]\n");
    return 2;
  }
  try {
    return halfspace::study::study(argc == 2 ? argv[1] : "");
  } catch (const std::exception& error) {
    fmt::print(stderr, "halfspace_study_orientation: {}\n", error.what());
    return 1;
  }
}
