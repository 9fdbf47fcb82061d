#include "quad_coverage.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace halfspace::tb {
namespace {

constexpr std::size_t kEachUpTo = 16;  // numbers of quads with a bin of their own

std::vector<std::string> numbered(const char* format, int first, int count) {
  std::vector<std::string> names;
  for (int i = first; i < first + count; ++i) {
    names.push_back(fmt::format(fmt::runtime(format), i));
  }
  return names;
}

}  // namespace

QuadCoverage::QuadCoverage(const Widths& widths, int fifo_depth)
    : widths_(widths),
      kinds_(widths.QuadWidth < widths.TileQuads ? 3 : 2),
      depth_(static_cast<std::size_t>(fifo_depth)) {
  const auto all = static_cast<std::size_t>(widths.TileQuads);
  for (std::size_t quads = 1; quads <= all; quads += quads < kEachUpTo || quads + 1 == all ? 1 : 15) {
    quads_bins_.push_back(quads);
  }
  for (const std::size_t quads : quads_bins_) {
    std::vector<std::string> names = {fmt::format("{} quads, never stalled", quads),
                                      fmt::format("{} quads, stalled at the first beat", quads)};
    if (beats(quads) > 1) {
      names.push_back(fmt::format("{} quads, stalled at a later beat", quads));
    }
    left_.push_back(add(names));
  }
  fill_ = add(numbered("{} quads in the last beat", 1, widths.QuadWidth));
  first_quad_ = add(numbered("quad {} first", 0, widths.TileQuads));
  last_quad_ = add(numbered("quad {} last", 0, widths.TileQuads));
  parts_ = add(numbered("parts {:#x}", 1, (1 << widths.ZParts) - 1));
  sure_ = add(numbered("sure of parts {:#x}", 0, 1 << widths.ZParts));
  static constexpr const char* kKinds[] = {"empty", "of one beat", "of several beats"};
  std::vector<std::string> names;
  for (std::size_t before = 0; before < kinds_; ++before) {
    for (std::size_t kind = 0; kind < kinds_; ++kind) {
      names.push_back(fmt::format("one {} at once after one {}", kKinds[kind], kKinds[before]));
      names.push_back(fmt::format("one {} later after one {}", kKinds[kind], kKinds[before]));
    }
  }
  follows_ = add(names);
  names.clear();
  for (std::size_t in_use = 0; in_use < depth_; ++in_use) {
    names.push_back(fmt::format("{} of {} credits in use, empty", in_use, depth_));
    names.push_back(fmt::format("{} of {} credits in use, not empty", in_use, depth_));
  }
  in_use_ = add(names);
  no_credit_ = add({"no credit for one that is empty", "no credit for one that is not"});
  returned_ =
      add({"credit back in the cycle of one that is empty", "credit back and used in the same cycle"});
  reset_ = add({"reset of a unit at rest", "reset while beats wait", "reset while beats are made",
                "reset while beats are made and wait"});
}

void QuadCoverage::taken(const std::vector<int>& quads, int in_use, bool at_once, bool returned) {
  const std::size_t count = quads.size();
  const Kind kind = this->kind(count);
  const std::size_t empty_or_not = count == 0 ? 0 : 1;
  hit(follows_,
      2 * (static_cast<std::size_t>(before_) * kinds_ + static_cast<std::size_t>(kind)) + (at_once ? 0 : 1));
  hit(in_use_, 2 * static_cast<std::size_t>(in_use) + empty_or_not);
  if (returned) {
    hit(returned_, empty_or_not);
  }
  before_ = kind;
  if (count == 0) {
    return;
  }
  unsigned parts = 0;
  for (const int quad : quads) {
    parts |= 1u << (quad * widths_.ZParts / widths_.TileQuads);
  }
  hit(parts_, parts - 1);
  hit(first_quad_, static_cast<std::size_t>(quads.front()));
  hit(last_quad_, static_cast<std::size_t>(quads.back()));
  hit(fill_, (count - 1) % static_cast<std::size_t>(widths_.QuadWidth));
}

void QuadCoverage::sure(unsigned parts) { hit(sure_, parts); }

void QuadCoverage::no_credit(bool empty) { hit(no_credit_, empty ? 0 : 1); }

void QuadCoverage::left(int quads, bool stalled_at_first, bool stalled_later) {
  const Group& group = left_[quads_bin(static_cast<std::size_t>(quads))];
  if (!stalled_at_first && !stalled_later) {
    hit(group, 0);
  }
  if (stalled_at_first) {
    hit(group, 1);
  }
  if (stalled_later) {
    hit(group, 2);
  }
}

void QuadCoverage::reset(bool making, bool waiting) {
  hit(reset_, (making ? 2u : 0u) + (waiting ? 1u : 0u));
  before_ = Kind::kEmpty;
}

std::vector<std::string> QuadCoverage::missed() const {
  std::vector<std::string> names;
  for (const Bin& bin : bins_) {
    if (bin.hits == 0) {
      names.push_back(bin.name);
    }
  }
  return names;
}

QuadCoverage::Group QuadCoverage::add(const std::vector<std::string>& names) {
  const Group group{bins_.size(), names.size()};
  for (const std::string& name : names) {
    bins_.push_back({name});
  }
  return group;
}

void QuadCoverage::hit(const Group& group, std::size_t place) {
  if (place < group.count) {
    ++bins_[group.first + place].hits;
  }
}

std::size_t QuadCoverage::beats(std::size_t quads) const {
  const auto width = static_cast<std::size_t>(widths_.QuadWidth);
  return (quads + width - 1) / width;
}

std::size_t QuadCoverage::quads_bin(std::size_t quads) const {
  const auto above = std::ranges::upper_bound(quads_bins_, quads);
  return static_cast<std::size_t>(above - quads_bins_.begin()) - 1;
}

QuadCoverage::Kind QuadCoverage::kind(std::size_t quads) const {
  return quads == 0 ? Kind::kEmpty : beats(quads) == 1 ? Kind::kOneBeat : Kind::kBeats;
}

}  // namespace halfspace::tb
