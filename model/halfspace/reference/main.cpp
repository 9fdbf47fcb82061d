/// halfspace_reference FRAME [DIRECTORY]: counts what the textbook rasterizer does with a frame, one line for
/// each depth surface and each way to take shaders that may discard; with a directory, its depth goes there
/// as well.
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

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

/// NPY 1.0 (numpy.lib.format): magic, version, length of the header, a header padded to 64 bytes, the values.
void write_depth(const fs::path& directory, const std::string& name, bool opaque, const Surface& s) {
  const fs::path path =
      directory / (name + ".depth" + std::to_string(s.index) + (opaque ? ".opaque" : ".no_write") + ".npy");
  std::string header = "{'descr': '<f4', 'fortran_order': False, 'shape': (" + std::to_string(s.height) +
                       ", " + std::to_string(s.width) + "), }";
  constexpr std::size_t kPreamble = 10;  // magic, version and length
  while ((kPreamble + header.size() + 1) % 64 != 0) header += ' ';
  header += '\n';
  std::ofstream out(path, std::ios::binary);
  out << "\x93NUMPY" << '\x01' << '\x00' << static_cast<char>(header.size()) << '\x00' << header;
  out.write(reinterpret_cast<const char*>(s.depth.data()),
            static_cast<std::streamsize>(s.depth.size() * sizeof(float)));
  if (!out) throw halfspace::InputError(path.string() + ": cannot be written");
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
    Options options;
    options.late_z = LateZ::kNoWrite;
    const std::vector<Surface> no_write = rasterize(frame, options);
    options.late_z = LateZ::kOpaque;
    const std::vector<Surface> opaque = rasterize(frame, options);
    std::printf("%s\n", kColumns);
    for (std::size_t i = 0; i < opaque.size(); ++i) {
      print_row(name, false, no_write[i]);
      print_row(name, true, opaque[i]);
      if (argc != 3) continue;
      write_depth(argv[2], name, false, no_write[i]);
      write_depth(argv[2], name, true, opaque[i]);
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "halfspace_reference: %s\n", error.what());
    return 1;
  }
  return 0;
}
