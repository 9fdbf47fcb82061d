/// Options that several subcommands share.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "halfspace/cli/draw_options.hpp"
#include "halfspace/config/config.hpp"
#include "halfspace/report/timeline.hpp"
#include "halfspace/run/run.hpp"
#include "halfspace/scene/camera.hpp"
#include "halfspace/scene/frame.hpp"
#include "halfspace/timing/rtl/verilated_pipeline.hpp"
#include "halfspace/timing/stall_plan.hpp"
#include "halfspace/whatif/what_if.hpp"

namespace halfspace {

/// Checks the configuration of a file, which settings have changed or not. Throws InputError where the file
/// alone is wrong, OptionError where a setting has a part in it.
void check_config(const Config& config, const std::string& file, bool changed);

/// Which samples of a pixel a command takes.
enum class Samples : std::uint8_t { kCentre, kAny };

/// Throws OptionError unless a pixel has one sample, at its centre, which is all that `what` takes.
void require_centre(const Config& config, std::string_view what);

/// --config and --set.
struct MachineOptions {
  std::string file;
  std::vector<std::string> settings;

  void add_to(CLI::App& command);
  [[nodiscard]] Config config(Samples taken = Samples::kCentre) const;  ///< throws InputError
};

/// --core.
struct CoreOption {
  std::string name{kCoreName[0]};

  void add_to(CLI::App& command);
  [[nodiscard]] Core core() const;
};

/// --threads.
struct ThreadsOption {
  int count = 1;

  /// `share`: what each of them does.
  void add_to(CLI::App& command, const std::string& share);
};

/// INPUT, how it is drawn and, for meshes, the camera.
struct InputOptions {
  std::vector<std::string> paths;  ///< one, or more where several are taken
  std::string eye;
  std::string at;
  std::string up;
  std::string mesh_camera;
  std::string size;
  double fov_degrees = 60;
  DrawOptions draws;

  void add_to(CLI::App& command);
  /// Takes several, which follow each other.
  void add_several_to(CLI::App& command);
  [[nodiscard]] Frame frame() const;  ///< loaded and validated; throws InputError
  /// All of them; throws InputError. `content`: of meshes.
  [[nodiscard]] std::vector<Frame> frames(MeshContent content = MeshContent::kGeometry) const;

 private:
  CLI::Option* add_input_to(CLI::App& command, const std::string& more);
  /// Throws OptionError, too where an option of it is given and no INPUT is a mesh.
  [[nodiscard]] Camera camera() const;

  std::vector<CLI::Option*> of_meshes_;  ///< what only a mesh takes
};

/// --lod, --sort, --order, --prepass and --delay.
struct WhatIfOptions {
  std::optional<double> lod_pixels;
  std::string sort;
  std::string order;
  bool prepass = false;
  std::optional<std::uint64_t> delay;

  void add_to(CLI::App& command);
  [[nodiscard]] whatif::WhatIf what_if() const;
};

/// --stall and --seed: what is injected into a run that has time.
struct StallOptions {
  std::vector<std::string> stalls;
  std::string seed;

  void add_to(CLI::App& command);
  [[nodiscard]] StallPlan plan() const;  ///< throws OptionError
};

/// --rtl-folder, --rtl-seed and --wave: the verilated pipeline of a run.
struct RtlOptions {
  std::string folder;  ///< empty: lib/halfspace beside the program's folder
  std::string seed;
  std::string wave;
  bool every_cycle = false;

  void add_to(CLI::App& command);
  void add_folder_to(CLI::App& command);
  /// Throws OptionError where one is given and the fidelity is not that of the RTL.
  void check(Fidelity fidelity) const;
  /// Puts them where a run takes them. Throws InputError.
  void apply(RunOptions& run) const;
  /// Throws InputError.
  [[nodiscard]] std::unique_ptr<rtl::VerilatedPipeline> pipeline(const Config& config) const;
};

/// --timeline and what part of the frame it shows.
struct TimelineOptions {
  bool wanted = false;
  std::string draws;
  std::string cycles;

  void add_to(CLI::App& command, CLI::Option* out);
  [[nodiscard]] TimelineChoice choice() const;  ///< throws OptionError
};

}  // namespace halfspace
