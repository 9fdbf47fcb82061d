/// halfspace bench depth-traffic: lines and bytes of depth by the class of the line, coded and raw.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <vector>

#include "halfspace/cli/bench.hpp"
#include "halfspace/cli/load_input.hpp"
#include "halfspace/cli/options.hpp"
#include "halfspace/whatif/depth_traffic.hpp"

namespace halfspace {
namespace {

using whatif::LineTraffic;

struct DepthTrafficOptions {
  std::vector<std::string> inputs;
  MachineOptions machine;
};

void print_row(const std::string& frame, const std::string& name, const LineTraffic& read,
               const LineTraffic& written) {
  LineTraffic both = read;
  both += written;
  if (both.lines == 0) {
    return;
  }
  fmt::print("| {} | {} |", frame, name);
  for (const LineTraffic& traffic : {read, written}) {
    fmt::print(" {} | {} | {} |", traffic.lines, traffic.raw_bytes, traffic.stored_bytes);
  }
  const double ratio = static_cast<double>(both.raw_bytes) / static_cast<double>(both.stored_bytes);
  fmt::print(" {} |\n", both.stored_bytes == 0 ? "-" : fmt::format("{:.2f}", ratio));
}

void bench_depth_traffic(const DepthTrafficOptions& options) {
  const Config config = options.machine.config();
  fmt::print(
      "lines: that the z cache reads and writes, the flush included; raw, stored: their bytes; ratio: raw / "
      "stored of both; moved: all but cleared, which memory has nothing of\n\n"
      "| frame | class | lines read | raw | stored | lines written | raw | stored | ratio |\n"
      "|---|---|---:|---:|---:|---:|---:|---:|---:|\n");
  for (const std::string& input : options.inputs) {
    const Frame frame = load_input(input);
    const whatif::DepthTraffic traffic = whatif::count_depth_traffic(frame, config);
    for (std::size_t i = 0; i < whatif::kLineClasses; ++i) {
      print_row(frame.name, whatif::kLineClassNames[i], traffic.read[i], traffic.written[i]);
    }
    print_row(frame.name, "moved", moved(traffic.read), moved(traffic.written));
  }
}

}  // namespace

void add_bench_depth_traffic(CLI::App& bench) {
  auto options = std::make_shared<DepthTrafficOptions>();
  CLI::App* command = bench.add_subcommand(
      "depth-traffic", "lines and bytes of depth, coded and raw, by the class of the line");
  command->add_option("INPUT", options->inputs, "frames, meshes or synthetic:NAME")->required();
  options->machine.add_to(*command);
  command->callback([options] { bench_depth_traffic(*options); });
}

}  // namespace halfspace
