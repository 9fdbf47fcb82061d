/**
 * A rasterizer that `halfspace stress --engine library:FILE` loads and stresses. A shared library exports
 * halfspace_rasterize(); it needs nothing of halfspace but this header. docs/guides/stress.md names an example.
 *
 * A scene is a frame of the stress campaign: one square target with one depth surface, which starts at
 * depth 1. What its numbers mean is that of the file format, docs/guides/frames.md.
 */
#ifndef HALFSPACE_RASTERIZER_H
#define HALFSPACE_RASTERIZER_H

#include <stddef.h>  // NOLINT(modernize-deprecated-headers): the header is C99
#include <stdint.h>  // NOLINT(modernize-deprecated-headers)

#ifdef __cplusplus
extern "C" {
#endif

/** A draw or a clear. */
typedef struct halfspace_scene_command {
  uint32_t kind;       /**< 1 draw, 2 clear of depth */
  uint32_t flags;      /**< bits as in the file format */
  uint32_t depth_func; /**< numbered as in Vulkan; a fragment passes where `its depth` FUNC `stored depth` */
  uint32_t first_index;
  uint32_t index_count;  /**< three a triangle */
  uint32_t first_vertex; /**< is added to each index */
  float viewport[4];     /**< x, y, width, height in pixels, y down */
  float depth_range[2];  /**< near, far */
  float clear_depth;
  float offset_factor;
  float offset_units;
  float offset_clamp;
  int32_t scissor[4]; /**< x, y, width, height; of a clear: its rectangle */
} halfspace_scene_command;

typedef struct halfspace_scene {
  uint32_t width; /**< pixels */
  uint32_t height;
  uint32_t depth_format;   /**< 1 unorm16, 2 unorm24, 4 float32 */
  uint32_t sub_pixel_bits; /**< of the positions that a triangle's vertices are snapped to */
  uint32_t command_count;
  const halfspace_scene_command* commands;
  uint32_t index_count;
  const uint32_t* indices;
  uint32_t vertex_count;
  const float* vertices; /**< x, y, z, w in clip space, 4 each */
} halfspace_scene;

/** The target after the scene: width * height numbers each, row by row, row 0 on top. The caller's, all 0. */
typedef struct halfspace_scene_picture {
  uint32_t* fragments; /**< that covered each pixel */
  uint32_t* survivors; /**< of these, the ones that passed the depth test */
  uint32_t* codes;     /**< stored depth: a unorm code, or the bits of a float32 */
} halfspace_scene_picture;

/**
 * Draws the scene. Returns 0; or another number where it cannot, with the reason in `error`, a text of less
 * than `error_size` bytes. The case then counts as failed.
 */
int halfspace_rasterize(const halfspace_scene* scene, halfspace_scene_picture* picture, char* error,
                        size_t error_size);

#ifdef __cplusplus
}
#endif

#endif
