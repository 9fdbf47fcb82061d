#include "halfspace/report/ledger_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <vector>

namespace halfspace {
namespace {

using ledger::Accounts;

constexpr double kWidth = 1040;
constexpr double kLeft = 130;  ///< where bars begin
constexpr double kBarWidth = kWidth - kLeft - 20;
constexpr double kBarHeight = 26;
constexpr double kLineHeight = 17;

/// One colour for each place where something ends: shades of one hue belong to one unit.
struct CauseColor {
  std::string_view cause;
  std::string_view color;
};
constexpr auto kColors = std::to_array<CauseColor>({
    {"not_filled", "#c9ced6"},  {"non_finite", "#8c96a3"},  {"clipped_away", "#5b6673"},
    {"degenerate", "#3a434d"},  {"no_piece", "#a9b2bd"},    {"zero_area", "#4b3b8f"},
    {"culled", "#7c6bc4"},      {"no_sample", "#a99be0"},   {"outside", "#cfc6f0"},
    {"edges", "#1f5fa8"},       {"edges_block", "#1f5fa8"}, {"edges_tile", "#5b97d6"},
    {"uncovered", "#9cc4ec"},   {"empty", "#9cc4ec"},       {"hi_z", "#d9730d"},
    {"hi_z_block", "#d9730d"},  {"hi_z_tile", "#f2ad5c"},   {"hi_z_early_z", "#d8522f"},
    {"early_z", "#c0313f"},     {"late", "#7a1c2c"},        {"survive", "#3f9b5f"},
    {"set_up", "#3f9b5f"},      {"live", "#3f9b5f"},        {"hit", "#a8d5b5"},
    {"overwritten", "#5b97d6"}, {"cleared", "#1f5fa8"},     {"compressed", "#e3bd2b"},
    {"fetched", "#c0313f"},     {"evicted", "#c0313f"},     {"flushed", "#e58a93"},
});

std::string_view color_of(std::string_view cause) {
  const auto* const found = std::ranges::find(kColors, cause, &CauseColor::cause);
  return found == kColors.end() ? "#000000" : found->color;
}

std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '&':
        out += "&amp;";
        break;
      default:
        const bool printable = static_cast<unsigned char>(c) >= 0x20 && static_cast<unsigned char>(c) < 0x7F;
        out += printable ? c : '?';  // a name may hold any bytes
    }
  }
  return out;
}

/// 1234567 as 1,234,567.
std::string grouped(std::uint64_t value) {
  std::string text = fmt::format("{}", value);
  for (int at = static_cast<int>(text.size()) - 3; at > 0; at -= 3) {
    text.insert(static_cast<std::size_t>(at), ",");
  }
  return text;
}

double share(std::uint64_t part, std::uint64_t whole) {
  return whole == 0 ? 0 : static_cast<double>(part) / static_cast<double>(whole);
}

/// A document that grows downwards.
class Drawing {
 public:
  void text(double x, std::string_view style, std::string_view content) {
    body_ += fmt::format("  <text class=\"{}\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n", style, x, y_,
                         escaped(content));
  }
  /// Its top left corner is `up` above the line of text.
  void box(double x, double up, double width, double height, std::string_view color) {
    body_ +=
        fmt::format("  <rect x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{:.2f}\" fill=\"{}\"/>\n", x,
                    y_ - up, width, height, color);
  }
  void down(double by) { y_ += by; }

  [[nodiscard]] std::string document(std::string_view title) const {
    const double height = y_ + 12;
    return fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1:.0f}\" width=\"{0}\" "
        "height=\"{1:.0f}\" role=\"img\" aria-labelledby=\"title\" font-family=\"Helvetica, Arial, 'DejaVu "
        "Sans', sans-serif\" fill=\"#1b2733\">\n"
        "  <title id=\"title\">{2}</title>\n"
        "  <style>.head {{ font-size: 16px; font-weight: bold }} .name {{ font-size: 13px; font-weight: bold "
        "}} .note {{ font-size: 12px }} .right {{ font-size: 12px; text-anchor: end }}</style>\n"
        "  <rect width=\"{0}\" height=\"{1:.0f}\" fill=\"#ffffff\"/>\n{3}</svg>\n",
        kWidth, height, escaped(title), body_);
  }

 private:
  double y_ = 26;
  std::string body_;
};

/// Of a font that nobody has measured: 12 pixels high, on the wide side.
double text_width(std::string_view text) { return 6.9 * static_cast<double>(text.size()); }

template <class Account>
void draw_account(Drawing& drawing, std::string_view name, const char* unit, const Account& account) {
  if (account.all == 0) {
    return;
  }
  struct Part {
    std::string_view cause;
    std::uint64_t count;
  };
  std::vector<Part> parts;
  Account::fields([&](const char* cause, auto, auto member) {
    if (std::string_view(cause) != "all" && account.*member != 0) {
      parts.push_back({cause, account.*member});
    }
  });
  drawing.down(kBarHeight);
  drawing.text(12, "name", name);
  double x = kLeft;
  for (const Part& part : parts) {
    const double width = kBarWidth * share(part.count, account.all);
    drawing.box(x, 18, width, kBarHeight, color_of(part.cause));
    x += width;
  }
  drawing.down(16);
  drawing.text(12, "note", grouped(account.all) + unit);
  drawing.down(10);
  x = kLeft;
  for (const Part& part : parts) {
    const std::string label =
        fmt::format("{} {} ({:.1f}%)", part.cause, grouped(part.count), 100 * share(part.count, account.all));
    const double width = 16 + text_width(label) + 14;
    if (x != kLeft && x + width > kLeft + kBarWidth) {
      x = kLeft;
      drawing.down(kLineHeight);
    }
    drawing.box(x, 10, 11, 11, color_of(part.cause));
    drawing.text(x + 16, "note", label);
    x += width;
  }
  drawing.down(12);
}

/// What a run costs, beside the run with all switches on.
void draw_cost(Drawing& drawing, std::string_view name, const ledger::RunCost& cost,
               const ledger::RunCost& all_on, std::uint64_t most) {
  constexpr double kText = 370;  // right of the bars
  const double full = kWidth - 230 - kText;
  const double base = full * share(std::min(cost.cycles, all_on.cycles), most);
  const double more = full * share(cost.cycles, most) - base;
  drawing.down(22);
  drawing.text(222, "right", name);
  drawing.box(230, 13, base, 17, "#9aa5b1");
  drawing.box(230 + base, 13, more, 17, "#c0313f");
  const auto change = [](std::uint64_t value, std::uint64_t to) {
    return to == 0 ? 0.0 : 100 * (static_cast<double>(value) / static_cast<double>(to) - 1);
  };
  drawing.text(kWidth - kText + 8, "note",
               fmt::format("{} ({:+.1f}%), {} bytes ({:+.1f}%)", grouped(cost.cycles),
                           change(cost.cycles, all_on.cycles), grouped(cost.read + cost.written),
                           change(cost.read + cost.written, all_on.read + all_on.written)));
}

void draw_savings(Drawing& drawing, const ledger::Savings& savings) {
  std::uint64_t most = std::max(savings.all_on.cycles, savings.all_off.cycles);
  for (const ledger::Saving& saving : savings.switches) {
    most = std::max(most, saving.without.cycles);
  }
  drawing.down(34);
  drawing.text(12, "head", "Cycles and bytes with one switch off, against all on");
  draw_cost(drawing, "all on", savings.all_on, savings.all_on, most);
  for (const ledger::Saving& saving : savings.switches) {
    draw_cost(drawing, saving.key + " off", saving.without, savings.all_on, most);
  }
  draw_cost(drawing, "all off", savings.all_off, savings.all_on, most);
}

}  // namespace

std::string ledger_picture(const LedgerReport& report) {
  Drawing drawing;
  drawing.text(12, "head", report.frame + ": what became of everything");
  Accounts::each([&](const char* name, auto account) {
    const std::string_view of = name;
    draw_account(drawing, of, of == "read" || of == "written" ? " bytes" : "", report.ledger.frame.*account);
  });
  if (report.savings) {
    draw_savings(drawing, *report.savings);
  }
  return drawing.document(fmt::format("The ledger of {}", report.frame));
}

}  // namespace halfspace
