/**
 * The units of halfspace as a golden model for other people's RTL: packets of a link in, the packets that
 * must be on the links behind it out, bit for bit. docs/guides/golden_model.md shows it from C and from a
 * SystemVerilog simulator.
 *
 * Packets are the packed structs of rtl/raster_pkg.sv: an array of 32-bit words, bit 0 of the struct in bit 0
 * of word 0 (svBitVecVal of DPI-C). Bits above the packet in its last word are ignored on the way in and 0 on
 * the way out.
 *
 * Errors. A function that fails returns a negative status and changes nothing; halfspace_error() then says in
 * one line what was wrong, its value, and what is legal. Null pointers are refused like any other value. No
 * exception leaves the library and nothing is printed.
 *
 * Threads. A model is used by one thread at a time. Models share nothing.
 *
 * Stability. What this file declares keeps its meaning while HALFSPACE_ABI_VERSION stays; additions do not
 * raise it.
 */
#ifndef HALFSPACE_H
#define HALFSPACE_H

#include <stdint.h>  // NOLINT(modernize-deprecated-headers): the header is C99

#ifdef __cplusplus
extern "C" {
#endif

#ifdef __GNUC__
#define HALFSPACE_API __attribute__((visibility("default")))
#else
#define HALFSPACE_API
#endif

#define HALFSPACE_ABI_VERSION 7

/** Words that hold any packet of any configuration. */
#define HALFSPACE_MAX_PACKET_WORDS 80

/** What functions return. Success is not negative. */
enum {
  HALFSPACE_OK = 0,
  HALFSPACE_NONE = 1,           /**< halfspace_get: no packet is expected on the link */
  HALFSPACE_DIFFERENT = 2,      /**< halfspace_check: the packet is not the one expected */
  HALFSPACE_REFUSED = -1,       /**< an argument, a packet or a configuration cannot be used */
  HALFSPACE_OUT_OF_MEMORY = -2, /**< the model can only be destroyed */
  HALFSPACE_INTERNAL = -3       /**< a defect of the library; the model can only be destroyed */
};

/**
 * Links, in the order of the units. Where a link carries several structs, its packet is their concatenation,
 * the first in the highest bits, as {triangle, state} in SystemVerilog.
 */
enum {
  HALFSPACE_TRIANGLE = 0,       /**< into setup: screen_triangle_t, draw_state_t */
  HALFSPACE_SETUP_TRIANGLE = 1, /**< setup -> block_walker: setup_triangle_t, depth_equation_t, draw_state_t
                                 */
  HALFSPACE_SLOT = 2,           /**< block_walker -> early_z, before the triangle's first beat: slot (8 bits),
                                     depth_equation_t, draw_state_t */
  HALFSPACE_BLOCK_JOB = 3,      /**< block_walker -> tile_walker: block_job_t */
  HALFSPACE_TILE_JOB = 4,       /**< tile_walker -> edge_evaluator: tile_job_t */
  HALFSPACE_COVERAGE = 5,       /**< edge_evaluator -> quad_generator: coverage_t */
  HALFSPACE_QUAD_BEAT = 6,      /**< quad_generator -> early_z: quad_beat_t */
  HALFSPACE_TESTED_BEAT = 7,    /**< out of early_z: tested_beat_t */
  HALFSPACE_LINKS = 8
};

/** Formats of depth surfaces, as in draw_state_t. Codes: 16 or 24 bits, or the bits of a float32 of 0 to 1.
 */
enum { HALFSPACE_UNORM16 = 1, HALFSPACE_UNORM24 = 2, HALFSPACE_FLOAT32 = 4 };

typedef struct halfspace_model halfspace_model;

/** "0.1.0" */
HALFSPACE_API const char* halfspace_version(void);

/** HALFSPACE_ABI_VERSION of the library that is loaded. */
HALFSPACE_API int halfspace_abi_version(void);

/** A model of the default machine, which the caller must destroy. Null when memory is out. */
HALFSPACE_API halfspace_model* halfspace_create(void);

/** Null does nothing. */
HALFSPACE_API void halfspace_destroy(halfspace_model* model);

/**
 * Why the last call with this model did not return HALFSPACE_OK; empty when it did. One line, never null, the
 * model's own: valid until the next call with it.
 */
HALFSPACE_API const char* halfspace_error(const halfspace_model* model);

/*
 * Configuration: the keys of `halfspace config`. It is fixed by the first call of any function below these
 * three; sizes that must fit each other are checked then.
 */

/** The machine of a TOML file, with defaults for what it does not set. Drops what was set before. */
HALFSPACE_API int halfspace_configure_file(halfspace_model* model, const char* path);

/** The same from TOML text. */
HALFSPACE_API int halfspace_configure(halfspace_model* model, const char* toml);

/** One key: "tile_walker.tile_size=16". */
HALFSPACE_API int halfspace_set(halfspace_model* model, const char* assignment);

/** Bits of a link's packet, to be checked against $bits; or a negative status. */
HALFSPACE_API int halfspace_packet_bits(halfspace_model* model, int link);

/** "coverage"; "?" for a number that is no link. */
HALFSPACE_API const char* halfspace_link_name(int link);

/**
 * Expects packets on a link, HALFSPACE_SETUP_TRIANGLE or later, from now on. To be called before the first
 * packet is put. Units work as far as the last link that is watched: whoever watches coverage alone needs no
 * depth surfaces. A watched link keeps its packets until they are taken by halfspace_get() or
 * halfspace_check().
 */
HALFSPACE_API int halfspace_watch(halfspace_model* model, int link);

/**
 * Takes a packet that is on a link, HALFSPACE_QUAD_BEAT or earlier, and expects what follows from it on the
 * watched links behind. `bits` is the size of the packet as the caller knows it and must be
 * halfspace_packet_bits().
 *
 * Refused is what breaks the contract of a unit that has to work on it:
 *  - setup: depth format, bounds, vertex depth above that of the format;
 *  - block_walker: empty bounds, E beyond its width within the blocks of the bounds;
 *  - tile_walker: empty bounds, no tile or one that the bounds do not touch, E beyond its width in the block;
 *  - early_z: a depth test without a surface or outside of it, a depth equation that is not one, a block job
 * whose edges are not those of its slot, E of a covered sample outside the triangle, a slot that was never
 * put, beats that are no burst of quad_generator.
 */
HALFSPACE_API int halfspace_put(halfspace_model* model, int link, const uint32_t* packet, int bits);

/** The next packet expected on a watched link: HALFSPACE_OK and the packet, or HALFSPACE_NONE. */
HALFSPACE_API int halfspace_get(halfspace_model* model, int link, uint32_t* packet, int bits);

/**
 * Compares a packet with the next one expected on a watched link, and takes that: HALFSPACE_OK or
 * HALFSPACE_DIFFERENT, and then halfspace_error() names link, number of the packet expected (from 0) and each
 * field that differs. Where the packet is the one after the next, both are taken and the next is said to be
 * missing; where it is the one before once more, or none is expected, none is taken.
 */
HALFSPACE_API int halfspace_check(halfspace_model* model, int link, const uint32_t* packet, int bits);

/** Packets that are expected on a watched link and were not taken yet, or a negative status. 0 at the end of
 * a test. */
HALFSPACE_API int64_t halfspace_pending(halfspace_model* model, int link);

/**
 * As after a reset of the RTL: no packet is expected or under way, the next triangle with a block job has
 * slot 0, packets are counted from 0. Configuration, watched links and depth surfaces stay.
 */
HALFSPACE_API int halfspace_reset(halfspace_model* model);

/**
 * Depth surfaces, for early_z. A surface is known by its first tile, the first_tile of draw_state_t. tiles_x
 * of the state is the number of tiles in a row less 1. clear_code of the state is passed on and not looked
 * at: what a clear does, halfspace_clear_surface() says, in order with the packets.
 */

/** width, height: 1 to 16384 pixels. All codes are `code`. Tiles of two surfaces must not overlap. */
HALFSPACE_API int halfspace_define_surface(halfspace_model* model, uint32_t first_tile, int format, int width,
                                           int height, uint32_t code);

HALFSPACE_API int halfspace_clear_surface(halfspace_model* model, uint32_t first_tile, uint32_t code);

/** x, y: a pixel of the surface. */
HALFSPACE_API int halfspace_read_depth(halfspace_model* model, uint32_t first_tile, int x, int y,
                                       uint32_t* code);
HALFSPACE_API int halfspace_write_depth(halfspace_model* model, uint32_t first_tile, int x, int y,
                                        uint32_t code);

#ifdef __cplusplus
}
#endif

#endif /* HALFSPACE_H */
