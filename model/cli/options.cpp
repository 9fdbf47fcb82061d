#include "halfspace/cli/options.hpp"

#include <fmt/format.h>

#include <charconv>

#include "halfspace/numerics/error.hpp"
#include "halfspace/scene/load.hpp"

namespace halfspace {
namespace {

/// Parses numbers separated by `separator`; an empty list where the text is anything else.
template <class Number>
std::vector<Number> parse_list(const std::string& text, char separator) {
  std::vector<Number> numbers;
  const char* at = text.data();
  const char* end = at + text.size();
  while (true) {
    Number number{};
    const auto [next, error] = std::from_chars(at, end, number);
    if (error != std::errc{} || (next != end && *next != separator)) {
      return {};
    }
    numbers.push_back(number);
    if (next == end) {
      return numbers;
    }
    at = next + 1;
  }
}

glm::vec3 parse_point(const char* option, const std::string& text) {
  const std::vector<float> v = parse_list<float>(text, ',');
  if (v.size() != 3) {
    throw InputError(fmt::format("{} is '{}'; it must be three numbers X,Y,Z", option, text));
  }
  return {v[0], v[1], v[2]};
}

}  // namespace

void MachineOptions::add_to(CLI::App& command) {
  command.add_option("--config", file, "configuration file (TOML)")->type_name("FILE");
  command.add_option("--set", settings, "override one key, repeatable; see 'halfspace config'")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
}

Config MachineOptions::config() const {
  Config config = file.empty() ? Config{} : read_config(file);
  for (const std::string& setting : settings) {
    set_config(config, setting);
  }
  validate(config);
  return config;
}

void InputOptions::add_to(CLI::App& command) {
  command.add_option("INPUT", path, "frame (.ptf, .ptf.gz, .ptf.xz) or mesh (.obj, .ply, .gltf, .glb)")
      ->required();
  command.add_option("--eye", eye, "mesh: camera position (default: the whole mesh is seen)")
      ->type_name("X,Y,Z");
  command.add_option("--at", at, "mesh: point looked at (default: its middle)")->type_name("X,Y,Z");
  command.add_option("--fov", fov_degrees, "mesh: vertical field of view in degrees")->capture_default_str();
  command.add_option("--size", size, "mesh: picture size in pixels (default: 1920x1080)")->type_name("WxH");
}

Camera InputOptions::camera() const {
  Camera camera;
  camera.fov_degrees = fov_degrees;
  if (!eye.empty()) {
    camera.eye = parse_point("--eye", eye);
  }
  if (!at.empty()) {
    camera.at = parse_point("--at", at);
  }
  if (!size.empty()) {
    const std::vector<std::uint32_t> v = parse_list<std::uint32_t>(size, 'x');
    if (v.size() != 2) {
      throw InputError(fmt::format("--size is '{}'; it must be WIDTHxHEIGHT in pixels, each 1 to {}", size,
                                   kMaxTargetSize));
    }
    camera.width = v[0];
    camera.height = v[1];
  }
  return camera;
}

Frame InputOptions::frame() const { return load(path, camera()); }

}  // namespace halfspace
