#include "halfspace/report/raster_pkg.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>
#include <stdexcept>
#include <string_view>
#include <type_traits>
#include <vector>

#include "halfspace/config/keys.hpp"
#include "halfspace/machine/shape.hpp"
#include "halfspace/numerics/widths.hpp"
#include "halfspace/timing/contract.hpp"
#include "halfspace/units/link_packets.hpp"
#include "halfspace/units/packets.hpp"
#include "halfspace/units/z_codec.hpp"

namespace halfspace {
namespace {

/// A parameter of the machine, and the define that sets it.
struct Parameter {
  std::string_view name;
  std::string_view define;
  std::string legal;
  int Widths::*member;  ///< null: the positions of samples
};
Parameter parameter_of(std::string_view name, std::string_view define, const std::string& legal,
                       int Widths::*member) {
  return {name, define, legal, member};
}
Parameter parameter_of(std::string_view name, std::string_view define, const std::string& legal,
                       SamplePattern Widths::*) {
  return {name, define, legal, nullptr};
}

// Legal values as the package's comment writes them.
std::string range(int least, int most) { return std::to_string(least) + ".." + std::to_string(most); }
std::string power_of_two(int least, int most) {
  std::string text = std::to_string(least);
  for (int value = 2 * least; value <= most; value *= 2) {
    text += "|" + std::to_string(value);
  }
  return text;
}

std::string sample_list() {
  return std::to_string(8 * kMostSamples) +
         "'h...: x and y of each sample in 16ths of a pixel, the first last";
}

/// Where the samples are unless a define says so: the standard positions of as many as there are.
std::string standard_positions() {
  std::string text;
  for (int samples = 2; samples <= kMostSamples; samples *= 2) {
    text += "PixelSamples == " + std::to_string(samples) + " ? " + to_hex(standard_samples(samples)) +
            " : \\\n  ";
  }
  return "(" + text + to_hex(SamplePattern{}) + ")";
}

std::string default_of(const Parameter& parameter) {
  return parameter.member == nullptr ? standard_positions() : std::to_string(Widths{}.*parameter.member);
}

std::string type_of(const Parameter& parameter) {
  return parameter.member == nullptr ? "logic [" + std::to_string(8 * kMostSamples - 1) + ":0]"
                                     : "int unsigned";
}

#define NOTHING(...)
#define PACKAGE(section, name, type, value, legal, unit, changes, help, parameter, define) \
  parameter_of(#parameter, #define, legal, &Widths::parameter),
const std::vector<Parameter> kParameters{HALFSPACE_KEYS(NOTHING, NOTHING, NOTHING, NOTHING, PACKAGE)};
#undef NOTHING
#undef PACKAGE

struct WidthEntry {
  std::string_view name;
  std::string_view formula;
  std::string_view meaning;
  int Widths::*member;
};

#define W(name, formula, meaning) WidthEntry{#name, #formula, meaning, &Widths::name},
constexpr std::array kWidthTable = {HALFSPACE_WIDTHS(W)};
#undef W

std::string_view name_of(int Widths::*member) {
  const auto* entry = std::ranges::find(kWidthTable, member, &WidthEntry::member);
  if (entry == kWidthTable.end()) {
    throw std::logic_error("raster_pkg: a packet field's width is not in HALFSPACE_WIDTHS");
  }
  return entry->name;
}

/// The parameter or width that is the length of an array.
std::string length_name(int Widths::*member) {
  const auto entry = std::ranges::find(kParameters, member, &Parameter::member);
  return std::string(entry != kParameters.end() ? entry->name : name_of(member));
}

/// Of at most 100 characters: a choice goes on in the next.
std::string in_lines(const std::string& text) {
  constexpr std::size_t kMost = 100;
  const std::size_t end = text.size() <= kMost ? std::string::npos : text.rfind(" : ", kMost - 2);
  return end == std::string::npos ? text : text.substr(0, end + 2) + "\n      " + text.substr(end + 3);
}

/// "TileCoordBits" -> "tile_coord_t".
std::string type_name(std::string_view width_name) {
  if (width_name.ends_with("Bits")) {
    width_name.remove_suffix(4);
  }
  std::string text;
  for (const char c : width_name) {
    if (std::isupper(static_cast<unsigned char>(c)) != 0 && !text.empty()) {
      text += '_';
    }
    text += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  return text + "_t";
}

/// Elements of an array field; 0 for a field that is one number. A TileMask is one number of MaskBits.
template <class Field>
constexpr std::size_t kElements = 0;
template <class Element, std::size_t N>
constexpr std::size_t kElements<std::array<Element, N>> = N;

/// An element of a packed array is signed only when its type has a name, so each width of a signed field has
/// one.
template <class Packet>
void add_signed_types(std::vector<int Widths::*>& types) {
  Packet::fields([&](const char*, auto, int Widths::*width, Sign sign, auto...) {
    if (sign == Sign::kSigned && std::ranges::find(types, width) == types.end()) {
      types.push_back(width);
    }
  });
}

template <class Packet>
std::string packed_struct(std::string_view type, std::string_view meaning) {
  std::string text = "\n  // " + std::string(meaning) + "\n  typedef struct packed {\n";
  Packet::fields([&](const char* name, auto member, int Widths::*width, Sign sign, auto... count) {
    using Field = std::remove_cvref_t<decltype(std::declval<Packet>().*member)>;
    const std::string range = "[" + std::string(name_of(width)) + "-1:0]";
    text += "    " + (sign == Sign::kSigned ? type_name(name_of(width)) : std::string("logic"));
    if constexpr (sizeof...(count) != 0) {
      text += " [" + length_name(count...) + "-1:0]";
    } else if constexpr (kElements<Field> != 0) {
      text += " [" + std::to_string(kElements<Field> - 1) + ":0]";
    }
    text += (sign == Sign::kSigned ? "" : " " + range) + " " + std::string(name) + ";\n";
  });
  return text + "  } " + std::string(type) + ";\n";
}

/// "no_triangle" -> "NoTriangle".
std::string camel_case(std::string_view name) {
  std::string text;
  bool up = true;
  for (const char c : name) {
    if (c != '_') {
      text += up ? static_cast<char>(std::toupper(static_cast<unsigned char>(c))) : c;
    }
    up = c == '_';
  }
  return text;
}

/// What a stage spends a cycle on, in the order of StageInfo: its counters have the same numbers.
std::string activity_enum(const StageInfo& stage) {
  const std::string prefix = camel_case(stage.name);
  std::string text =
      "\n  // a cycle of " + std::string(stage.name) + "\n  typedef enum logic [ActivityBits-1:0] {\n";
  text += "    " + prefix + "Busy = 0";
  for (std::size_t i = 0; i < stage.stall.size() && !stage.stall[i].empty(); ++i) {
    text += ",\n    " + prefix + camel_case(stage.stall[i]) + " = " + std::to_string(i + 1);
  }
  return text + "\n  } " + std::string(stage.name) + "_activity_e;\n";
}

/// Numbers that no parameter changes.
std::string constants() {
  struct Constant {
    std::string_view name;
    int value;
    std::string_view meaning;
  };
  static constexpr std::array kConstants = {
      Constant{"LeastCodedBytes", kLeastCodedBytes, "a line of depth is not coded in fewer"},
      Constant{"MostCodedShift", kMostCodedShift, "a coded line has its bytes >> 1 to this"},
      Constant{"ZEncodeLatency", kZEncodeLatency, "cycles from a line of depth to its bytes"},
      Constant{"ZDecodeLatency", kZDecodeLatency, "and back"}};
  std::string text;
  for (const Constant& constant : kConstants) {
    text.append("  // ").append(constant.meaning);
    text.append("\n  parameter int unsigned ").append(constant.name);
    text.append(" = ").append(std::to_string(constant.value)).append(";\n");
  }
  return text;
}

}  // namespace

std::string raster_pkg() {
  std::string text =
      R"(// Widths and packets of the links between the units, for every configuration.
//
// Printed by the target print_raster_pkg from model/halfspace/numerics/widths.hpp, model/halfspace/units/packets.hpp,
// model/halfspace/units/link_packets.hpp, model/halfspace/units/z_codec.hpp, model/halfspace/machine/shape.hpp and
// model/halfspace/timing/contract.hpp: change those and print this file again. A configuration is chosen by defines:
)";
  for (const Parameter& parameter : kParameters) {
    text += "// -D" + std::string(parameter.define) + "=" + std::string(parameter.legal) + "\n";
  }
  for (const Parameter& parameter : kParameters) {
    text.append("\n`ifndef ").append(parameter.define);
    text.append("\n`define ").append(parameter.define).append(" ");
    text.append(default_of(parameter)).append("\n`endif");
  }
  text += "\n\npackage raster_pkg;\n\n";
  for (const Parameter& parameter : kParameters) {
    text += "  parameter " + type_of(parameter) + " " + std::string(parameter.name) + " = `" +
            std::string(parameter.define) + ";\n";
  }
  text += "\n";
  for (const WidthEntry& entry : kWidthTable) {
    text += "  // " + std::string(entry.meaning) + "\n";
    text += in_lines("  parameter int unsigned " + std::string(entry.name) + " = " +
                     std::string(entry.formula) + ";\n");
  }
  text += constants();
  std::vector<int Widths::*> types;
  add_signed_types<ScreenTrianglePacket>(types);
  add_signed_types<SetupTrianglePacket>(types);
  add_signed_types<DepthEquationPacket>(types);
  add_signed_types<BlockJob>(types);
  add_signed_types<TileJob>(types);
  add_signed_types<Coverage>(types);
  add_signed_types<QuadBeat>(types);
  add_signed_types<AttributeQuad>(types);
  text += "\n";
  for (int Widths::*width : types) {
    const std::string name(name_of(width));
    text += "  typedef logic signed [" + name + "-1:0] " + type_name(name) + ";\n";
  }
  text +=
      packed_struct<ScreenTrianglePacket>("screen_triangle_t", "front end -> setup: on the sub-pixel grid");
  text +=
      packed_struct<DrawStatePacket>("draw_state_t", "the state of a draw, as it travels with its triangles");
  text +=
      packed_struct<SetupTrianglePacket>("setup_triangle_t", "setup -> block_walker: what the walk needs");
  text += packed_struct<DepthEquationPacket>("depth_equation_t",
                                             "setup -> early_z, by way of the slots of block_walker");
  text += packed_struct<BlockJob>("block_job_t", "block_walker -> tile_walker");
  text += packed_struct<TileJob>("tile_job_t", "tile_walker -> edge_evaluator");
  text += packed_struct<Coverage>("coverage_t", "edge_evaluator -> quad_generator");
  text += packed_struct<QuadBeat>("quad_beat_t", "quad_generator -> early_z: a beat of a burst");
  text += packed_struct<HiZUpdatePacket>("hi_z_update_t", "early_z -> hi_z: what is stored behind a burst");
  text += packed_struct<TestedBeat>("tested_beat_t", "early_z -> fragment shader: a beat of a burst");
  text += packed_struct<AttributeQuad>("attribute_quad_t",
                                       "early_z -> interpolator: a quad, an attribute, and their triangle");
  text += packed_struct<ShadedQuad>(
      "shaded_quad_t", "interpolator -> fragment shader: the attribute at the pixels of the quad");
  text +=
      "\n  // stages that count their cycles, and what each of them may spend one on: busy, or a reason to "
      "wait\n";
  text += "  parameter int unsigned StageCount = " + std::to_string(kStages) + ";\n";
  text += "  parameter int unsigned ActivityCount = " + std::to_string(kMostStallReasons + 1) + ";\n";
  text += "  parameter int unsigned ActivityBits = $clog2(ActivityCount);\n";
  for (const StageInfo& stage : kStageInfo) {
    text += activity_enum(stage);
  }
  text += "\n  // what can happen in a cycle: bits of the probe of the pipeline's bench\n";
  for (std::size_t i = 0; i < kEvents; ++i) {
    text.append("  parameter int unsigned Event").append(kEventInfo[i].name);
    text.append(" = ").append(std::to_string(i)).append(";  // ").append(kEventInfo[i].meaning).append("\n");
  }
  text += "  parameter int unsigned EventCount = " + std::to_string(kEvents) + ";\n";
  text += "\nendpackage : raster_pkg\n\n";
  for (const Parameter& parameter : kParameters) {
    text += "`undef " + std::string(parameter.define) + "\n";
  }
  return text;
}

}  // namespace halfspace
