#include "halfspace/timing/rtl/pipeline_library.hpp"

#include <dlfcn.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string>
#include <system_error>
#include <vector>

#include "halfspace/numerics/error.hpp"
#include "halfspace/timing/rtl/pipeline_arguments.hpp"

namespace halfspace::rtl {
namespace {

namespace fs = std::filesystem;

constexpr const char* kPrefix = "halfspace_rtl_";

std::vector<fs::path> libraries_in(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
    if (entry.path().filename().string().starts_with(kPrefix) && entry.path().extension() == ".so") {
      files.push_back(entry.path());
    }
  }
  std::ranges::sort(files);
  return files;
}

/// A symbol of the library; its type is that in tb/raster_pipeline/pipeline.cpp.in.
template <class Symbol>
Symbol* symbol(void* library, const fs::path& file, const char* name) {
  void* const found = dlsym(library, name);
  if (found == nullptr) {
    throw InputError(
        fmt::format("{}: has no '{}': not a verilated pipeline of this version", file.string(), name));
  }
  return reinterpret_cast<Symbol*>(found);
}

/// What no RTL does, whichever is built.
void check_config(const Config& config) {
  if (config.raster.conservative == Conservative::kOuter &&
      config.depth.interpolator != DepthInterpolator::kBarycentric) {
    throw OptionError(
        "configuration key 'depth.interpolator' is plane; legal for the RTL with 'raster.conservative' "
        "outer: "
        "barycentric");
  }
}

}  // namespace

std::unique_ptr<VerilatedPipeline> load_pipeline(const Config& config, const fs::path& folder,
                                                 std::uint64_t seed) {
  check_config(config);
  const std::string wanted = fmt::format("{}", fmt::join(pipeline_arguments(config), " "));
  std::vector<std::string> names;
  for (const fs::path& file : libraries_in(folder)) {
    // Stays loaded: code of it runs until the program ends.
    void* const library = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (library == nullptr) {
      throw InputError(fmt::format("{}: cannot be loaded: {}", file.string(), dlerror()));
    }
    if (symbol<const char* const>(library, file, "halfspace_pipeline_arguments")[0] == wanted) {
      using Make = VerilatedPipeline*(std::uint64_t);
      return std::unique_ptr<VerilatedPipeline>(symbol<Make>(library, file, "halfspace_make_pipeline")(seed));
    }
    names.push_back(file.stem().string().substr(std::string(kPrefix).size()));
  }
  throw InputError(fmt::format(
      "no verilated pipeline of this configuration in {} (there: {}); `make rtl` builds those of the CMake "
      "variable HALFSPACE_RTL_CONFIGS into build/release/lib/halfspace of the source tree, and --rtl-folder "
      "names that folder to an installed program",
      folder.string(), names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "))));
}

}  // namespace halfspace::rtl
