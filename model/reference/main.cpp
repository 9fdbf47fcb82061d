/// halfspace_reference FRAME [DIRECTORY]: counts what the textbook rasterizer does with a frame, one line for
/// each depth surface and each way to take shaders that may discard; with a directory, its depth goes there
/// as well.
#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <string>

#include "halfspace/numerics/error.hpp"
#include "halfspace/reference/rasterizer.hpp"
#include "halfspace/scene/ptf.hpp"

namespace {

namespace fs = std::filesystem;
using halfspace::reference::Counters;
using halfspace::reference::LateZ;
using halfspace::reference::Options;
using halfspace::reference::Surface;

constexpr const char* kColumns =
    "frame\tsurface\topaque\twidth\theight\ttriangles\tclipped_away\tculled\tdrawn\tcovered_fragments\tdepth_"
    "passed\t"
    "quads\thelper_fragments";

/// "dir/truck.ptf.xz" -> "truck".
std::string frame_name(const fs::path& path) {
  const std::string name = path.filename().string();
  return name.substr(0, name.find('.'));
}

void print_row(const std::string& name, bool opaque, const Surface& s) {
  const Counters& c = s.counters;
  std::printf("%s\t%u\t%d\t%u\t%u", name.c_str(), s.index, opaque ? 1 : 0, s.width, s.height);
  for (const auto value : {c.triangles, c.clipped_away, c.culled, c.drawn, c.covered_fragments,
                           c.depth_passed, c.quads, c.helper_fragments}) {
    std::printf("\t%llu", static_cast<unsigned long long>(value));
  }
  std::printf("\n");
}

/// Raw little-endian float32, row by row.
void write_depth(const fs::path& directory, const std::string& name, bool opaque, const Surface& s) {
  const std::string file =
      name + ".depth" + std::to_string(s.index) + (opaque ? ".opaque" : ".no_write") + ".f32";
  std::ofstream out(directory / file, std::ios::binary);
  out.write(reinterpret_cast<const char*>(s.depth.data()),
            static_cast<std::streamsize>(s.depth.size() * sizeof(float)));
  if (!out) throw halfspace::InputError((directory / file).string() + ": cannot be written");
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2 && argc != 3) {
    std::fprintf(stderr, "usage: halfspace_reference FRAME.ptf[.xz|.gz] [DIRECTORY]\n");
    return 2;
  }
  try {
    const halfspace::Frame frame = halfspace::read_ptf(argv[1]);
    const std::string name = frame_name(argv[1]);
    std::printf("%s\n", kColumns);
    for (const bool opaque : {false, true}) {
      Options options;
      options.late_z = opaque ? LateZ::kOpaque : LateZ::kNoWrite;
      for (const Surface& surface : halfspace::reference::rasterize(frame, options)) {
        print_row(name, opaque, surface);
        if (argc == 3) write_depth(argv[2], name, opaque, surface);
      }
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "halfspace_reference: %s\n", error.what());
    return 1;
  }
  return 0;
}
