/* A rasterizer of somebody else's for `halfspace stress --engine library:FILE`: a page of C that needs nothing but the
 * header. It covers exactly and clips nothing, so it is right on what lies inside of the clip volume with w = 1. */
#include <math.h>
#include <string.h>

#include "halfspace/stress/halfspace_rasterizer.h"

enum { kDraw = 1, kDepthWrite = 1 << 1, kAlways = 7, kUnorm24 = 2 };

typedef struct {
  int64_t x, y; /* in sub-pixels */
  double z;
} vertex;

static int64_t area(const vertex* a, const vertex* b, int64_t x, int64_t y) {
  return (b->x - a->x) * (y - a->y) - (x - a->x) * (b->y - a->y);
}

/* Left and top edges own the samples on them; y is down, and the triangle goes round with positive area. */
static int inside(const vertex* a, const vertex* b, int64_t x, int64_t y) {
  const int64_t e = area(a, b, x, y);
  return e > 0 || (e == 0 && (b->y < a->y || (b->y == a->y && b->x > a->x)));
}

static void draw_triangle(const halfspace_scene* scene, halfspace_scene_picture* picture, vertex v[3]) {
  const int64_t one = (int64_t)1 << scene->sub_pixel_bits;
  int64_t all = area(&v[0], &v[1], v[2].x, v[2].y);
  if (all == 0) {
    return;
  }
  if (all < 0) {
    const vertex second = v[1];
    v[1] = v[2];
    v[2] = second;
    all = -all;
  }
  for (uint32_t py = 0; py < scene->height; ++py) {
    for (uint32_t px = 0; px < scene->width; ++px) {
      const int64_t x = px * one + one / 2;
      const int64_t y = py * one + one / 2;
      if (inside(&v[0], &v[1], x, y) && inside(&v[1], &v[2], x, y) && inside(&v[2], &v[0], x, y)) {
        const double z = ((double)area(&v[1], &v[2], x, y) * v[0].z + (double)area(&v[2], &v[0], x, y) * v[1].z +
                          (double)area(&v[0], &v[1], x, y) * v[2].z) /
                         (double)all;
        const size_t at = (size_t)py * scene->width + px;
        ++picture->fragments[at];
        ++picture->survivors[at];
        picture->codes[at] = (uint32_t)llround(z * 0xFFFFFF);
      }
    }
  }
}

int halfspace_rasterize(const halfspace_scene* scene, halfspace_scene_picture* picture, char* error,
                        size_t error_size) {
  const double one = (double)(1u << scene->sub_pixel_bits);
  if (scene->depth_format != kUnorm24) {
    strncpy(error, "only unorm24", error_size - 1);
    return 1;
  }
  for (size_t at = 0; at < (size_t)scene->width * scene->height; ++at) {
    picture->codes[at] = 0xFFFFFF;
  }
  for (uint32_t c = 0; c < scene->command_count; ++c) {
    const halfspace_scene_command* command = &scene->commands[c];
    if (command->kind != kDraw) {
      continue; /* clears to 1 */
    }
    if (command->depth_func != kAlways || (command->flags & kDepthWrite) == 0) {
      strncpy(error, "only draws that pass and write", error_size - 1);
      return 1;
    }
    for (uint32_t i = 0; i + 2 < command->index_count; i += 3) {
      vertex v[3];
      for (uint32_t k = 0; k < 3; ++k) {
        const uint32_t index = command->first_vertex + scene->indices[command->first_index + i + k];
        const float* p = &scene->vertices[4 * (size_t)index];
        v[k].x = llrint(((double)p[0] / p[3] + 1) * 0.5 * command->viewport[2] * one);
        v[k].y = llrint(((double)p[1] / p[3] + 1) * 0.5 * command->viewport[3] * one);
        v[k].z = (double)p[2] / p[3];
      }
      draw_triangle(scene, picture, v);
    }
  }
  return 0;
}
