#include "halfspace/scene/quote.hpp"

#include <algorithm>
#include <cstddef>

namespace halfspace {

std::string printable(std::string_view text) {
  std::string out(text);
  std::replace_if(
      out.begin(), out.end(), [](unsigned char c) { return c < 0x20 || c == 0x7F; }, '?');
  return out;
}

std::string quote(std::string_view text) {
  constexpr std::size_t kShown = 60;
  return '"' + printable(text.substr(0, kShown)) + (text.size() > kShown ? "...\"" : "\"");
}

}  // namespace halfspace
