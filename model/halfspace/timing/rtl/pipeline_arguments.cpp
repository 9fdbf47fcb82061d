#include "halfspace/timing/rtl/pipeline_arguments.hpp"

#include <fmt/format.h>

#include <type_traits>

#include "halfspace/numerics/error.hpp"

namespace halfspace::rtl {
namespace {

std::string value_text(int value) { return std::to_string(value); }
template <class Enumeration>
requires std::is_enum_v<Enumeration> std::string value_text(Enumeration value) {
  return std::to_string(static_cast<int>(value));
}
// A bit must be written as one: Verilator warns of a wider number.
std::string value_text(bool value) { return value ? "1'b1" : "1'b0"; }
std::string value_text(const SamplePattern& samples) { return to_hex(samples); }

}  // namespace

std::uint32_t memory_tiles(const Config& config) {
  return kMemoryTiles * static_cast<std::uint32_t>(config.raster.samples);
}

std::vector<std::string> pipeline_arguments(const Config& machine) {
  Config config = machine;
  if (config.raster.conservative == Conservative::kOff) {
    config.raster.uncertainty = Config{}.raster.uncertainty;  // of nothing: no other RTL
  }
  config.raster.sample_positions = sample_pattern(machine);
  if (config.interpolator.enabled) {
    throw OptionError("configuration key 'interpolator.enabled' is true; legal in the RTL: false");
  }
  std::vector<std::string> arguments;
  std::vector<std::string> parameters;
#define NOTHING(...)
#define PACKAGE(section, name, type, value, legal, unit, changes, help, Parameter, define) \
  arguments.push_back("-D" #define "=" + value_text(config.section name));
#define MODULE(section, name, type, value, legal, unit, changes, help, Parameter) \
  parameters.push_back("-G" #Parameter "=" + value_text(config.section name));
  HALFSPACE_KEYS(NOTHING, NOTHING, NOTHING, MODULE, PACKAGE)
#undef NOTHING
#undef PACKAGE
#undef MODULE
  arguments.insert(arguments.end(), parameters.begin(), parameters.end());
  arguments.push_back(fmt::format("-GMemoryTiles={}", memory_tiles(config)));
  arguments.push_back(fmt::format("-GMemoryBlocks={}", kMemoryBlocks));
  return arguments;
}

}  // namespace halfspace::rtl
