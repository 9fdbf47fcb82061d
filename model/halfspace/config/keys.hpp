/// Every configuration key, declared once: one row a key, by section. From this table come struct Config
/// (config.hpp), reading, checking and printing it (config.cpp), the parameters of the packets' widths
/// (numerics/widths.hpp, rtl/raster_pkg.sv), the arguments of the RTL (timing/rtl/pipeline_arguments.hpp)
/// and docs/config.md.
///
/// A new key is a new row here; `make generated` then writes the committed files that list keys.
#pragma once

// clang-format off
/// HALFSPACE_KEYS(BEGIN, END, KEY, MODULE, PACKAGE)
///
/// BEGIN(section) and END(section) enclose a section's rows; a row before the first section is a key without
/// one. The kind of a row says what the key is in the RTL; what the rows have in common comes first:
///
///   KEY    (section., name, type, default, legal, unit, changes, help)           no parameter
///   MODULE (..., Parameter)           parameter of raster_pipeline.sv, which has them in the order of the rows
///   PACKAGE(..., Parameter, define)   parameter of raster_pkg.sv, and the define that sets it; of an int or
///                                     a SamplePattern
///
/// section  with its dot, as the member is reached: `config.section.name`; empty outside all sections
/// legal    range(least, most), power_of_two(least, most), boolean(), share(), a number from 0 to 1 that is kept
///          in 2^16ths, one_of(names), whose place in the list is the value of the enumeration, or
///          sample_list(), a SamplePattern; what depends on other keys is in validate()
/// unit     empty where there is none
/// changes  function: may change packets; time: only the cycles in which they move
///
/// The smallest FIFO has an output register and a slot; the largest keep the triangles behind hi_z, or behind
/// block_walker, within the 256 slots that a tile job can name.
#define HALFSPACE_KEYS(BEGIN, END, KEY, MODULE, PACKAGE)                                                     \
  BEGIN(raster)                                                                                              \
    PACKAGE(raster., sub_pixel_bits, int, 8, range(4, 8), "bits", function,                                  \
        "fraction bits of a snapped window coordinate", SubPixelBits, HALFSPACE_SUB_PIXEL_BITS)              \
    MODULE(raster., conservative, Conservative, Conservative::kOff, one_of("off", "outer", "inner"), "",     \
        function, "which pixels a triangle has: off = whose centre it covers, outer = that it touches, "     \
        "inner = that it fills", Conservative)                                                               \
    MODULE(raster., uncertainty, int, 1, range(0, 128), "sub-pixels", function,                              \
        "of outer and inner: how much larger than a pixel its square is on each side; at most half a pixel", \
        Uncertainty)                                                                                         \
    MODULE(raster., inner_coverage, bool, false, boolean(), "", function,                                    \
        "of outer: each pixel that is drawn also says whether the triangle fills it", InnerCoverage)         \
    PACKAGE(raster., samples, int, 1, power_of_two(1, 16), "", function,                                     \
        "of a pixel, each with coverage and depth of its own", PixelSamples, HALFSPACE_SAMPLES)              \
    PACKAGE(raster., sample_positions, SamplePattern, kStandardSamples, sample_list(), "", function,         \
        "where they are: standard = the standard positions of Direct3D and Vulkan; or a list in 16ths of a " \
        "pixel from its top left corner, as in \"12,12;4,4\"", SamplePositions, HALFSPACE_SAMPLE_POSITIONS)  \
  END(raster)                                                                                                \
  BEGIN(setup)                                                                                               \
    MODULE(setup., queue, int, 8, range(2, 64), "triangles", time,                                           \
        "triangles in the cull stage and its queue, dropped ones included", SetupQueue)                      \
    MODULE(setup., interval, int, 1, power_of_two(1, 16), "cycles", time,                                    \
        "from a drawn triangle to the next: the time of a divider stage", SetupInterval)                     \
    MODULE(setup., fifo, int, 40, range(2, 64), "triangles", time,                                           \
        "output FIFO of setup", SetupFifo)                                                                   \
    KEY(setup., fill_rule, FillRuleKey, FillRuleKey::kDraw,                                                  \
        one_of("draw", "top_left", "bottom_left", "top_right", "bottom_right", "normal_sign"), "", function, \
        "whose the samples on an edge are: draw = as each draw says; normal_sign = edges with A > 0, or "    \
        "A = 0 and B > 0, which is top_left here")                                                           \
  END(setup)                                                                                                 \
  BEGIN(block_walker)                                                                                        \
    PACKAGE(block_walker., block_size, int, 32, power_of_two(8, 64), "pixels", function,                     \
        "side of the block whose tiles are decided in one step; 2, 4 or 8 tiles", BlockSize,                 \
        HALFSPACE_BLOCK_SIZE)                                                                                \
    MODULE(block_walker., trivial_reject, bool, true, boolean(), "", function,                               \
        "drop tiles that are outside one edge", TrivialReject)                                               \
    MODULE(block_walker., sample_reject, bool, false, boolean(), "", function,                               \
        "drop tiles without a covered sample, of triangles whose bounds hold few", SampleReject)             \
    MODULE(block_walker., levels, int, 2, range(1, 3), "", function,                                            \
        "what a step decides: 1 = a tile, 2 = the tiles of a block, 3 = the blocks of a superblock, then "   \
        "the tiles of each that is left", WalkLevels)                                                                    \
    MODULE(block_walker., order, WalkOrder, WalkOrder::kRaster,                                                 \
        one_of("raster", "boustrophedonic", "backtracking", "zigzag", "morton", "hilbert"), "", function,    \
        "in which a triangle's steps are made", WalkOrder)                                                              \
    MODULE(block_walker., fifo, int, 4, range(2, 8), "blocks", time,                                         \
        "output FIFO of the block walker", BlockFifo)                                                        \
  END(block_walker)                                                                                          \
  BEGIN(hi_z)                                                                                                \
    MODULE(hi_z., enabled, bool, false, boolean(), "", function,                                             \
        "reject the tiles of a block in which no sample can pass the depth test", HiZ)                       \
    MODULE(hi_z., accept, bool, true, boolean(), "", function,                                               \
        "do not fetch lines that a tile overwrites whole, where all of its samples pass for sure", HiZAccept) \
    MODULE(hi_z., bits, int, 8, range(4, 32), "bits", function,                                              \
        "of a bound of depth; those of a block share a base and a shift", HiZBits)                           \
    MODULE(hi_z., lag, int, 128, range(1, 1024), "tile jobs", function,                                      \
        "a block sees what jobs have written that are at least so many older", HiZLag)                       \
    MODULE(hi_z., fifo, int, 12, range(4, 16), "blocks", time,                                               \
        "output FIFO of hi_z", HiZFifo)                                                                      \
  END(hi_z)                                                                                                  \
  BEGIN(tile_walker)                                                                                         \
    PACKAGE(tile_walker., tile_size, int, 8, power_of_two(4, 16), "pixels", function,                        \
        "side of the tile that the edge evaluator takes in one step; a line of the z cache grows with it",   \
        TileSize, HALFSPACE_TILE_SIZE)                                                                       \
    MODULE(tile_walker., trivial_accept, bool, true, boolean(), "", function,                                \
        "skip an edge that has all samples of the tile inside", TrivialAccept)                               \
    MODULE(tile_walker., order, TileOrder, TileOrder::kRaster,                                                  \
        one_of("raster", "boustrophedonic", "morton", "hilbert"), "", function,                              \
        "in which the tiles of a block leave", TileOrder)                                                               \
    MODULE(tile_walker., fifo, int, 16, range(2, 64), "tile jobs", time,                                     \
        "output FIFO of the tile walker", WalkerFifo)                                                        \
  END(tile_walker)                                                                                           \
  BEGIN(edge_evaluator)                                                                                      \
    MODULE(edge_evaluator., pipe_stages, int, 2, range(1, 3), "registers", time,                             \
        "pipeline registers before the output FIFO", PipeStages)                                             \
    MODULE(edge_evaluator., fifo, int, 4, range(2, 32), "tiles", time,                                       \
        "output FIFO of the edge evaluator", EdgeFifo)                                                       \
  END(edge_evaluator)                                                                                        \
  BEGIN(quad_generator)                                                                                      \
    PACKAGE(quad_generator., quads_per_cycle, int, 4, power_of_two(1, 16), "quads", time,                    \
        "width of a beat; at most the quads of a tile", QuadWidth, HALFSPACE_QUAD_WIDTH)                     \
    MODULE(quad_generator., fifo, int, 4, range(2, 64), "bursts", time,                                      \
        "output FIFO of the quad generator; a burst is the quads of one tile", QuadFifo)                     \
  END(quad_generator)                                                                                        \
  BEGIN(early_z)                                                                                             \
    PACKAGE(early_z., quads_per_cycle, int, 4, power_of_two(1, 16), "quads", time,                           \
        "quads tested in a cycle; at most quad_generator.quads_per_cycle", TestWidth, HALFSPACE_TEST_WIDTH)  \
    MODULE(early_z., pending, int, 32, range(2, 64), "bursts", time,                                         \
        "bursts between z_lookup and z_test", PendingDepth)                                                  \
    MODULE(early_z., fifo, int, 16, range(2, 64), "bursts", time,                                            \
        "output FIFO of early_z", EarlyZFifo)                                                                \
  END(early_z)                                                                                               \
  BEGIN(late_z)                                                                                              \
    MODULE(late_z., mode, LateZ, LateZ::kOpaque, one_of("opaque", "no_write", "late"), "", function,         \
        "draws whose shader may discard, writes depth or has side effects: opaque = test and write, "        \
        "no_write = test only, late = test, and write when the shader is through; `late_z = MODE` is short " \
        "for it", LateZMode)                                                                                 \
    MODULE(late_z., queue, int, 16, range(1, 64), "bursts", time,                                            \
        "late writes that may be out", LateQueue)                                                            \
    KEY(late_z., latency, int, 200, range(1, 65535), "cycles", time,                                         \
        "from the last beat of a burst at the shader to its answer")                                         \
    KEY(late_z., discard, int, 0, share(), "", function,                                                     \
        "share of the fragments that the shader discards: those that a hash of draw, triangle and pixel "    \
        "chooses")                                                                                           \
    KEY(late_z., seed, int, 1, range(1, 65535), "", function,                                                \
        "seed of that hash")                                                                                 \
  END(late_z)                                                                                                \
  BEGIN(depth)                                                                                               \
    MODULE(depth., interpolator, DepthInterpolator, DepthInterpolator::kPlane,                               \
        one_of("plane", "barycentric"), "", function,                                                        \
        "plane = additions alone for a sample, barycentric = products; both within one unit of the last "    \
        "place", Interpolator)                                                                               \
    MODULE(depth., latency, int, 12, range(12, 32), "cycles", time,                                            \
        "pipeline registers of the interpolator", InterpolatorLatency)                                       \
  END(depth)                                                                                                 \
  BEGIN(interpolator)                                                                                        \
    KEY(interpolator., enabled, bool, false, boolean(), "", function,                                        \
        "interpolate the attributes of what passes, behind early_z")                                         \
    KEY(interpolator., attributes, int, 2, range(1, 8), "", function,                                        \
        "of four components each that the shader of a draw reads")                                           \
    KEY(interpolator., bits, int, 24, range(8, 24), "bits", function,                                        \
        "of mantissas and weights; even")                                                                    \
    KEY(interpolator., fifo, int, 35, range(2, 64), "quads", time,                                           \
        "output FIFO, a quad with one attribute each; below half of 'interpolator.bits' and 23 not one in "  \
        "every cycle")                                                                                       \
  END(interpolator)                                                                                          \
  BEGIN(z_cache)                                                                                             \
    MODULE(z_cache., lines, int, 128, power_of_two(1, 4096), "lines", time,                                  \
        "lines of the z cache, all parts and ways together; each holds tile_size^2 / parts samples of "      \
        "4 bytes, so a larger tile makes the cache larger", Lines)                                           \
    MODULE(z_cache., ways, int, 4, power_of_two(1, 16), "lines", time,                                       \
        "lines of a set", Ways)                                                                              \
    PACKAGE(z_cache., parts, int, 1, power_of_two(1, 4), "", time,                                           \
        "lines of a tile: each holds an equal band of its rows", ZParts, HALFSPACE_Z_PARTS)                  \
    MODULE(z_cache., misses_in_flight, int, 16, range(1, 64), "lines", time,                                 \
        "fill buffers; at least z_cache.parts", MissesInFlight)                                              \
    MODULE(z_cache., write_buffers, int, 4, range(1, 64), "lines", time,                                     \
        "lines on their way to memory; at least z_cache.parts", WriteBuffers)                                \
    KEY(z_cache., fast_clear, bool, true, boolean(), "", function,                                           \
        "clear a whole surface by marking its lines; off: draw the clear")                                   \
    MODULE(z_cache., compression, bool, false, boolean(), "", function,                                      \
        "keep lines of depth in memory in an eighth, a quarter or half of their bytes where they fit",       \
        Compression)                                                                                         \
    MODULE(z_cache., clear_tiles, int, 64, power_of_two(1, 1024), "tiles", time,                             \
        "tiles that a fast clear marks in a cycle", ClearTiles)                                              \
  END(z_cache)                                                                                               \
  BEGIN(memory)                                                                                              \
    KEY(memory., latency, int, 100, range(1, 65535), "cycles", time,                                         \
        "from a request to its first data")                                                                  \
    MODULE(memory., read_bytes, int, 64, power_of_two(1, 1024), "bytes", time,                               \
        "read in a cycle", ReadBytes)                                                                        \
    MODULE(memory., write_bytes, int, 64, power_of_two(1, 1024), "bytes", time,                              \
        "written in a cycle", WriteBytes)                                                                    \
  END(memory)
// clang-format on
