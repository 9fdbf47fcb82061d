#include "halfspace/config/did_you_mean.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>
#include <vector>

namespace halfspace {
namespace {

constexpr std::size_t kMostEdits = 3;
constexpr std::size_t kMostNames = 2;

char small(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

}  // namespace

std::size_t edit_distance(std::string_view a, std::string_view b) {
  // Rows of the table of distances between beginnings: that of i letters of `a`, and the two before.
  std::array<std::vector<std::size_t>, 3> rows;
  rows.fill(std::vector<std::size_t>(b.size() + 1));
  auto& [before_last, last, row] = rows;
  std::iota(row.begin(), row.end(), std::size_t{0});
  const auto same = [&](std::size_t i, std::size_t k) { return small(a[i]) == small(b[k]); };
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::swap(before_last, last);
    std::swap(last, row);
    row[0] = i;
    for (std::size_t k = 1; k <= b.size(); ++k) {
      const std::size_t other = last[k - 1] + (same(i - 1, k - 1) ? 0 : 1);
      row[k] = std::min({last[k] + 1, row[k - 1] + 1, other});
      if (i > 1 && k > 1 && same(i - 1, k - 2) && same(i - 2, k - 1)) {
        row[k] = std::min(row[k], before_last[k - 2] + 1);
      }
    }
  }
  return row[b.size()];
}

std::string did_you_mean(std::string_view word, std::span<const std::string_view> names) {
  std::size_t least = std::min(kMostEdits, word.size() / 3);
  std::vector<std::string> closest;
  for (const std::string_view name : names) {
    const std::size_t lengths = std::max(name.size(), word.size()) - std::min(name.size(), word.size());
    const std::size_t distance = lengths > kMostEdits ? lengths : edit_distance(word, name);
    if (distance < least) {
      least = distance;
      closest.clear();
    }
    if (distance == least) {
      closest.push_back(fmt::format("'{}'", name));
    }
  }
  return closest.empty() || closest.size() > kMostNames
             ? std::string()
             : fmt::format(" (did you mean {}?)", fmt::join(closest, " or "));
}

}  // namespace halfspace
