#include <fmt/format.h>

#include <bit>
#include <cstring>
#include <utility>
#include <vector>

#include "halfspace/numerics/depth.hpp"
#include "halfspace/numerics/error.hpp"
#include "halfspace/report/npy.hpp"
#include "halfspace/stress/subject.hpp"

namespace halfspace::stress {
namespace {

/// An array of the target's size. Throws InputError.
NpyArray read(const std::filesystem::path& path, const Target& target, std::string_view descr) {
  NpyArray array = read_npy(path);
  const std::vector<std::uint64_t> shape{target.height, target.width};
  if (array.descr != descr || array.shape != shape) {
    throw InputError(fmt::format("{} holds {}; it must hold {} of shape ({}, {})", path.string(), array.descr,
                                 descr, target.height, target.width));
  }
  return array;
}

std::vector<std::uint32_t> counts(const std::filesystem::path& path, const Target& target) {
  const NpyArray array = read(path, target, "'<u2'");
  std::vector<std::uint16_t> values(array.data.size() / sizeof(std::uint16_t));
  std::memcpy(values.data(), array.data.data(), array.data.size());
  return {values.begin(), values.end()};
}

/// Every code of every format survives the way through a float32.
std::vector<std::uint32_t> codes(const std::filesystem::path& path, const Target& target) {
  const NpyArray array = read(path, target, "'<f4'");
  std::vector<float> depth(array.data.size() / sizeof(float));
  std::memcpy(depth.data(), array.data.data(), array.data.size());
  std::vector<std::uint32_t> values;
  values.reserve(depth.size());
  for (const float z : depth) {
    if (!(z >= 0 && z <= 1)) {
      throw InputError(fmt::format("{} holds {}; legal: 0 to 1", path.string(), z));
    }
    values.push_back(code_of_depth(target.depth_format, z));
  }
  return values;
}

class Files final : public Subject {
 public:
  explicit Files(std::filesystem::path folder) : folder_(std::move(folder)) {
    if (!std::filesystem::is_directory(folder_)) {
      throw InputError(fmt::format("{} is not a folder; it must hold a folder of results for each case",
                                   folder_.string()));
    }
  }

  [[nodiscard]] std::string name() const override { return fmt::format("files in {}", folder_.string()); }

  Picture draw(const Frame& frame) override {
    const std::filesystem::path results = folder_ / frame.name;
    const Target& target = frame.targets.front();
    return {.width = target.width,
            .height = target.height,
            .fragments = counts(results / "fragments0.npy", target),
            .survivors = counts(results / "survivors0.npy", target),
            .codes = codes(results / "depth0.npy", target)};
  }

 private:
  std::filesystem::path folder_;
};

}  // namespace

std::unique_ptr<Subject> files_subject(const std::filesystem::path& folder) {
  return std::make_unique<Files>(folder);
}

}  // namespace halfspace::stress
