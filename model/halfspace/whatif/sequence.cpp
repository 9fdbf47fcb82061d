#include "halfspace/whatif/sequence.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <string>
#include <utility>

#include "halfspace/numerics/error.hpp"

namespace halfspace::whatif {
namespace {

std::string text_of(const std::vector<Target>& targets) {
  std::string text;
  for (const Target& target : targets) {
    text += fmt::format("{}{}x{} with depth format {}, surface {}", text.empty() ? "" : "; ", target.width,
                        target.height, static_cast<std::uint32_t>(target.depth_format), target.depth_surface);
  }
  return text;
}

bool same(const std::vector<Target>& a, const std::vector<Target>& b) {
  return std::ranges::equal(a, b, [](const Target& l, const Target& r) {
    return l.width == r.width && l.height == r.height && l.depth_format == r.depth_format &&
           l.depth_surface == r.depth_surface;
  });
}

void check_room(const Frame& all, std::string_view what, std::size_t count) {
  constexpr std::size_t kMost = std::numeric_limits<std::uint32_t>::max();
  if (count > kMost) {
    throw InputError(fmt::format("{}: {} together are {}; legal: at most {}", all.name, what, count, kMost));
  }
}

void append(Frame& all, const Frame& next) {
  if (!same(all.targets, next.targets)) {
    throw InputError(fmt::format("{}: targets are {}; legal in a sequence: those of its first frame, {}",
                                 next.name, text_of(next.targets), text_of(all.targets)));
  }
  all.name += ", " + next.name;
  all.attributes.reset();  // which are of one mesh
  check_room(all, "vertices", all.vertices.size() + next.vertices.size());
  check_room(all, "indices", all.indices.size() + next.indices.size());
  for (Command command : next.commands) {
    command.first_vertex += static_cast<std::uint32_t>(all.vertices.size());
    command.first_index += static_cast<std::uint32_t>(all.indices.size());
    all.commands.push_back(command);
  }
  all.vertices.insert(all.vertices.end(), next.vertices.begin(), next.vertices.end());
  all.indices.insert(all.indices.end(), next.indices.begin(), next.indices.end());
  all.left_out.insert(all.left_out.end(), next.left_out.begin(), next.left_out.end());
}

}  // namespace

Frame join(std::vector<Frame> frames) {
  Frame all = std::move(frames.front());
  for (std::size_t i = 1; i < frames.size(); ++i) {
    append(all, frames[i]);
  }
  return all;
}

}  // namespace halfspace::whatif
