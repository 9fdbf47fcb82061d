/* The smallest user of the C API: one tile job in, its coverage out. */
#include <halfspace.h>
#include <stdio.h>

int main(void) {
  halfspace_model* model = halfspace_create();
  uint32_t job[HALFSPACE_MAX_PACKET_WORDS] = {0};
  uint32_t coverage[HALFSPACE_MAX_PACKET_WORDS];
  int status = HALFSPACE_OK;
  /* All three edges accepted: what is left are the bounds. The last fields of the struct are the lowest bits. */
  const uint32_t accept = 7, x_first = 1, x_last = 2, y_first = 0, y_last = 0;
  job[0] = accept << 12 | x_first << 9 | x_last << 6 | y_first << 3 | y_last;

  if (halfspace_abi_version() != HALFSPACE_ABI_VERSION || halfspace_watch(model, HALFSPACE_COVERAGE) != HALFSPACE_OK) {
    return 1;
  }
  status = halfspace_put(model, HALFSPACE_TILE_JOB, job, halfspace_packet_bits(model, HALFSPACE_TILE_JOB));
  if (status == HALFSPACE_OK) {
    status = halfspace_get(model, HALFSPACE_COVERAGE, coverage, halfspace_packet_bits(model, HALFSPACE_COVERAGE));
  }
  if (status != HALFSPACE_OK) {
    fprintf(stderr, "%s\n", halfspace_error(model));
    return 1;
  }
  printf("mask %08lx%08lx\n", (unsigned long)coverage[1], (unsigned long)coverage[0]);
  halfspace_destroy(model);
  return 0;
}
