/// halfspace record: keeps the packet stream of a frame, for `halfspace retime`.
#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "halfspace/cli/commands.hpp"
#include "halfspace/cli/options.hpp"
#include "halfspace/cli/progress.hpp"
#include "halfspace/timing/record/frame_record_file.hpp"

namespace halfspace {
namespace {

struct RecordOptions {
  InputOptions input;
  WhatIfOptions what_if;
  MachineOptions machine;
  CoreOption core;
  std::string out;
};

class RecordObserver final : public PacketObserver {
 public:
  explicit RecordObserver(const std::string& name) : bar_(name) {}
  void draw_done(std::size_t done, std::size_t of) override { bar_.update(done, of); }

 private:
  ProgressBar bar_;
};

void record(const RecordOptions& options) {
  const Config config = options.machine.config(Samples::kAny);
  const Frame frame = whatif::apply(options.input.frames(), options.what_if.what_if()).frame;
  RecordObserver observer(frame.name);
  const FrameRecord record = record_frame(
      frame, config, {.count_pixels = false, .observer = &observer, .core = options.core.core()});
  write_record(options.out, record);
  const PacketStream& packets = record.packets;
  fmt::print("{}: {} triangles with {} tile jobs, {} bursts with depth; {} bytes in {}\n", record.name,
             packets.triangles.size(), packets.jobs.size(), packets.accesses.size(),
             std::filesystem::file_size(options.out), options.out);
}

}  // namespace

void add_record_command(CLI::App& app, ExitStatus& /*status*/) {
  auto options = std::make_shared<RecordOptions>();
  CLI::App* command = app.add_subcommand("record", "record the packets of a frame, for `halfspace retime`");
  options->input.add_several_to(*command);
  options->what_if.add_to(*command);
  options->machine.add_to(*command);
  options->core.add_to(*command);
  command->add_option("--out", options->out, "file to write")->type_name("RECORD")->required();
  command->callback([options] { record(*options); });
}

}  // namespace halfspace
