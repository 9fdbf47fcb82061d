#include "halfspace/cli/supersample_options.hpp"

#include <fmt/format.h>

#include "halfspace/cli/known_words.hpp"
#include "halfspace/numerics/error.hpp"
#include "halfspace/scene/magnify.hpp"

namespace halfspace {

void SupersampleOptions::add_to(CLI::App& command) {
  CLI::Option* given =
      command
          .add_option("--supersample", times,
                      "draw the frame N times as wide and high; pictures are filtered down to its size")
          ->check(CLI::Range(1, kMostMagnified))
          ->type_name("N");
  command
      .add_option(
          "--filter", filter,
          "of pictures with --supersample: the mean of a pixel, or a tent two pixels wide (default: box)")
      ->check(one_of({"box", "tent"}))
      ->needs(given);
}

void SupersampleOptions::apply(std::vector<Frame>& frames, bool pictures) const {
  if (!filter.empty() && !pictures) {
    throw OptionError(fmt::format(
        "--filter is '{}', given without pictures; legal: with --out and without --no-pictures", filter));
  }
  if (times > 1) {
    for (Frame& frame : frames) {
      magnify(frame, times);
    }
  }
}

PictureFilter SupersampleOptions::picture_filter() const {
  return filter == "tent" ? PictureFilter::kTent : PictureFilter::kBox;
}

}  // namespace halfspace
