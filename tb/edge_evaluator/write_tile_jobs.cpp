/// Writes a file of random tile jobs, for the test of replay: write_tile_jobs FILE TILE_SIZE SUB_PIXEL_BITS
/// COUNT.
#include <exception>
#include <iostream>
#include <string>

#include "halfspace/report/tile_job_file.hpp"
#include "stimulus.hpp"

int main(int argc, char** argv) {
  try {
    if (argc != 5) {
      std::cerr << "usage: write_tile_jobs FILE TILE_SIZE SUB_PIXEL_BITS COUNT\n";
      return 1;
    }
    const halfspace::Widths widths{.SubPixelBits = std::stoi(argv[3]), .TileSize = std::stoi(argv[2])};
    halfspace::tb::Random random(1);
    halfspace::TileJobWriter writer(argv[1], widths);
    for (int left = std::stoi(argv[4]); left > 0; --left) {
      writer.write(halfspace::tb::triangle_job(widths, random));
    }
    writer.close();
    return 0;
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
}
