/// halfspace info: what a frame holds.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <memory>

#include "halfspace/cli/commands.hpp"
#include "halfspace/cli/options.hpp"
#include "halfspace/scene/quote.hpp"
#include "halfspace/scene/synthetic.hpp"

namespace halfspace {
namespace {

struct InfoOptions {
  InputOptions input;
  bool commands = false;
};

constexpr const char* kFuncNames[] = {"never",   "less",     "equal",  "lequal",
                                      "greater", "notequal", "gequal", "always"};

std::string flag_names(const Command& command) {
  static const std::pair<Flag, const char*> kNames[] = {{Flag::kDepthTest, "depth_test"},
                                                        {Flag::kDepthWrite, "depth_write"},
                                                        {Flag::kDepthClamp, "depth_clamp"},
                                                        {Flag::kCullFront, "cull_front"},
                                                        {Flag::kCullBack, "cull_back"},
                                                        {Flag::kBlend, "blend"},
                                                        {Flag::kShaderDiscards, "shader_discards"},
                                                        {Flag::kShaderWritesDepth, "shader_writes_depth"},
                                                        {Flag::kStencilTest, "stencil_test"},
                                                        {Flag::kColorWrite, "color_write"},
                                                        {Flag::kAlphaToCoverage, "alpha_to_coverage"},
                                                        {Flag::kNotFilled, "not_filled"},
                                                        {Flag::kEarlyTestsForced, "early_tests_forced"},
                                                        {Flag::kPolygonOffset, "polygon_offset"},
                                                        {Flag::kShaderSideEffects, "shader_side_effects"},
                                                        {Flag::kClearColor, "clear_color"},
                                                        {Flag::kClearDepth, "clear_depth"},
                                                        {Flag::kClearStencil, "clear_stencil"},
                                                        {Flag::kBottomLeftRule, "bottom_left_rule"}};
  std::string text;
  for (const auto& [flag, name] : kNames) {
    text += command.has(flag) ? fmt::format(" {}", name) : "";
  }
  return text;
}

void print_command(std::size_t index, const Command& c) {
  const std::string scissor =
      fmt::format("{},{} {}x{}", c.scissor.x, c.scissor.y, c.scissor.width, c.scissor.height);
  if (c.kind == CommandKind::kClear) {
    fmt::print("{:>6} clear target {} depth {} rectangle {}{}\n", index, c.target, c.clear_depth, scissor,
               flag_names(c));
    return;
  }
  fmt::print(
      "{:>6} draw  target {} {} {} vertices {} func {} viewport {},{} {}x{} scissor {} depth "
      "{}..{}{}\n",
      index, c.target, kPrimitiveName[static_cast<std::size_t>(c.primitive)], c.primitive_count(),
      c.vertex_count, kFuncNames[static_cast<std::size_t>(c.depth_func)], c.viewport.x, c.viewport.y,
      c.viewport.z, c.viewport.w, scissor, c.depth_range.x, c.depth_range.y, flag_names(c));
}

void info(const InfoOptions& options) {
  const Frame frame = options.input.frame();
  std::uint64_t draws = 0;
  std::uint64_t triangles = 0;
  for (const Command& command : frame.commands) {
    draws += command.kind == CommandKind::kDraw ? 1 : 0;
    triangles += command.kind == CommandKind::kDraw ? command.primitive_count() : 0;
  }
  fmt::print("{}: {} targets, {} draws, {} clears, {} triangles, {} vertices\n", frame.name,
             frame.targets.size(), draws, frame.commands.size() - draws, triangles, frame.vertices.size());
  for (std::size_t i = 0; i < frame.targets.size(); ++i) {
    const Target& t = frame.targets[i];
    const std::string surface =
        t.depth_surface == kNoSurface ? "" : fmt::format(" surface {}", t.depth_surface);
    fmt::print("target {}: {}x{} depth {}{} colors {}{}\n", i, t.width, t.height, name(t.depth_format),
               surface, t.color_count, t.presented ? " presented" : "");
  }
  if (!frame.left_out.empty()) {
    fmt::print("left out: {}\n", fmt::join(frame.left_out, ", "));
  }
  for (std::size_t i = 0; i < frame.cameras.size(); ++i) {
    fmt::print("camera {}: {}\n", i, printable(frame.cameras[i]));
  }
  for (std::size_t i = 0; options.commands && i < frame.commands.size(); ++i) {
    print_command(i, frame.commands[i]);
  }
  if (!frame.meta.empty()) {
    fmt::print("{}\n", frame.meta);
  }
}

}  // namespace

void add_info_command(CLI::App& app, ExitStatus& /*status*/) {
  auto options = std::make_shared<InfoOptions>();
  CLI::App* command = app.add_subcommand("info", "show what a frame or a mesh holds");
  options->input.add_to(*command);
  command->footer("Synthetic frames, built in memory:\n" + synthetic_help());
  command->add_flag("--commands", options->commands, "print a line for each draw and clear");
  command->callback([options] { info(*options); });
}

}  // namespace halfspace
