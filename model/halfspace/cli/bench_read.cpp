/// halfspace bench read: how fast meshes are read.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "halfspace/cli/bench.hpp"
#include "halfspace/cli/load_input.hpp"
#include "halfspace/numerics/error.hpp"
#include "halfspace/scene/byte_source.hpp"
#include "halfspace/scene/mesh.hpp"
#include "halfspace/speed/grid_meshes.hpp"
#include "halfspace/speed/speed_table.hpp"
#include "halfspace/speed/surface_cost.hpp"

namespace halfspace {
namespace {

struct ReadOptions {
  std::vector<std::string> meshes;
  std::uint32_t side = 400;
  std::string folder;
  int repeat = 7;
};

/// A folder of its own, removed at the end.
class TemporaryFolder {
 public:
  TemporaryFolder() : path_((std::filesystem::temp_directory_path() / "halfspace_XXXXXX").string()) {
    if (mkdtemp(path_.data()) == nullptr) {
      throw InputError(fmt::format("{}: cannot be made; legal: a folder that may be written", path_));
    }
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  std::string path_;
};

void print_row(const std::filesystem::path& path, int repeat) {
  std::size_t triangles = 0;
  std::vector<double> times;
  for (int pass = 0; pass < repeat; ++pass) {
    std::vector<std::string> left_out;
    times.push_back(processor_milliseconds([&] {
      Mesh mesh = read_mesh(path);
      triangles = mesh.indices.size() / 3;
      left_out = std::move(mesh.left_out);
    }));
    if (pass == 0) say_left_out(path, left_out);
  }
  const auto bytes = static_cast<double>(std::filesystem::file_size(path));
  const double peak = cost_of_fresh_run([&] { triangles += read_mesh(path).indices.size(); }).megabytes;
  const Spread ms = spread(times);
  fmt::print("| {} | {:.1f} | {} | {:.1f} ({:.1f} to {:.1f}) | {:.0f} | {:.1f} | {:.1f} |\n",
             display_name(path.filename()), bytes / 1e6, triangles, ms.median, ms.least, ms.most,
             bytes / ms.median / 1e3, static_cast<double>(triangles) / ms.median / 1e3, peak * 1e6 / bytes);
}

void bench_read(const ReadOptions& options) {
  std::vector<std::filesystem::path> paths(options.meshes.begin(), options.meshes.end());
  std::optional<TemporaryFolder> temporary;
  if (paths.empty()) {
    if (options.folder.empty()) temporary.emplace();
    paths = write_grid_meshes(temporary ? temporary->path() : options.folder, options.side);
  }
  fmt::print(
      "one thread, processor time, medians of {} runs (least to most), from the file that the system holds "
      "in memory to the mesh; MB: 10^6 bytes; memory: at the peak, in sizes of the file\n\n",
      options.repeat);
  fmt::print(
      "| mesh | MB | triangles | ms | MB/s | Mtriangles/s | memory |\n|---|---:|---:|---:|---:|---:|---:|\n");
  for (const std::filesystem::path& path : paths) print_row(path, options.repeat);
}

}  // namespace

void add_bench_read(CLI::App& bench) {
  auto options = std::make_shared<ReadOptions>();
  CLI::App* command = bench.add_subcommand("read", "how fast meshes are read, by format");
  CLI::Option* const meshes =
      command->add_option("MESH", options->meshes, "meshes (OBJ, PLY, glTF); none: a grid in each format");
  command->add_option("--side", options->side, "vertices of the grid on a side")
      ->check(CLI::Range(2, 4096))
      ->capture_default_str();
  command
      ->add_option("--keep", options->folder, "write the grid's files into this folder, and leave them there")
      ->check(CLI::ExistingDirectory);
  for (const char* const of_grid : {"--side", "--keep"}) {
    command->get_option(of_grid)->excludes(meshes);
  }
  command->add_option("--repeat", options->repeat, "number of timed runs of each")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  command->callback([options] { bench_read(*options); });
}

}  // namespace halfspace
