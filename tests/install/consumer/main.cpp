// The smallest user of the library: counts the quads of a frame.
#include <cstdio>
#include <halfspace/core/functional.hpp>
#include <halfspace/scene/load.hpp>

int main(int, char** argv) {
  const halfspace::FrameResult result = halfspace::run_functional(halfspace::load(argv[1]), {});
  std::printf("%llu quads\n", static_cast<unsigned long long>(result.counters.quad_generator.quads));
}
