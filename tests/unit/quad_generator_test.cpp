// quad_generator: every covered sample in one quad, every quad once, in order and aligned.
#include "halfspace/units/quad_generator.hpp"

#include <catch2/catch.hpp>
#include <random>

using namespace halfspace;

TEMPLATE_TEST_CASE_SIG("quad_generator: quads partition the mask", "", ((int TileSize), TileSize), 4, 8, 16) {
  std::mt19937_64 random(TileSize);
  for (int n = 0; n < 500; ++n) {
    Coverage coverage;
    for (std::size_t i = 0; i < kMaskWords<TileSize>; ++i) {
      coverage.mask.word[i] = n == 0       ? 0
                              : n == 1     ? ~0ull
                              : n % 2 == 0 ? random() & random() & random()
                                           : random();
    }
    coverage.mask &= full_mask<TileSize>();
    const QuadBurst burst = quad_generator<TileSize>(coverage);

    TileMask seen;
    int quads = 0;
    int full = 0;
    int last = -1;
    for_each_quad<TileSize>(burst, [&](const Quad& quad) {
      ++quads;
      REQUIRE(quad.x % 2 == 0);
      REQUIRE(quad.y % 2 == 0);
      REQUIRE(quad.mask != 0);
      REQUIRE(quad.y * TileSize + quad.x > last);
      last = quad.y * TileSize + quad.x;
      full += quad.mask == 15;
      for (int i = 0; i < 4; ++i) {
        const int x = quad.x + i % 2;
        const int y = quad.y + i / 2;
        REQUIRE(test<TileSize>(coverage.mask, x, y) == ((quad.mask >> i & 1) != 0));
        if ((quad.mask >> i & 1) != 0) {
          set_row<TileSize>(seen, y, 1u << x);
        }
      }
    });
    REQUIRE(seen == coverage.mask);
    REQUIRE(quads == popcount(burst.quads));
    REQUIRE(full == popcount(full_quads<TileSize>(burst)));
  }
}
