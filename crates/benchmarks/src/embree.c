/* Embree's packets of eight on segments between points, on one thread: for comparison only.
 *
 * Input file: two 64-bit counts, of triangles and of packets; then the triangles, nine floats each;
 * then the packets: eight x, eight y and eight z of where segments begin, and the same of where they
 * end. Prints the seconds of the fastest of several rounds, and how many segments are blocked. */
#include <embree3/rtcore.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { ROUNDS = 5 };

/* Segments end on faces, which are not to block them. */
static const float MARGIN = 1e-5f;

static double now(void) {
  struct timespec t;
  clock_gettime(CLOCK_MONOTONIC, &t);
  return t.tv_sec + 1e-9 * t.tv_nsec;
}

static void *read_floats(FILE *file, size_t count) {
  /* Embree reads a few bytes beyond the last vertex. */
  float *floats = aligned_alloc(64, ((4 * count + 16 + 63) / 64) * 64);
  if (!floats || fread(floats, 4, count, file) != count) {
    fprintf(stderr, "the input is too short\n");
    exit(1);
  }
  return floats;
}

int main(int argc, char **argv) {
  FILE *file = argc == 2 ? fopen(argv[1], "rb") : NULL;
  uint64_t counts[2];
  if (!file || fread(counts, 8, 2, file) != 2) {
    fprintf(stderr, "give an input file\n");
    return 1;
  }
  const size_t triangles = counts[0], packets = counts[1];
  float *corners = read_floats(file, 9 * triangles);
  float *segments = read_floats(file, 48 * packets);

  RTCDevice device = rtcNewDevice("threads=1");
  RTCScene scene = rtcNewScene(device);
  rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
  rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_HIGH);
  RTCGeometry mesh = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  rtcSetSharedGeometryBuffer(mesh, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, corners, 0, 12,
                             3 * triangles);
  uint32_t *indices = rtcSetNewGeometryBuffer(mesh, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                              12, triangles);
  for (size_t k = 0; k < 3 * triangles; k++) indices[k] = k;
  rtcCommitGeometry(mesh);
  rtcAttachGeometry(scene, mesh);
  rtcCommitScene(scene);

  double best = 1e300;
  size_t blocked = 0;
  for (int round = 0; round < ROUNDS; round++) {
    blocked = 0;
    const double start = now();
    for (size_t k = 0; k < packets; k++) {
      const float *from = segments + 48 * k, *to = from + 24;
      struct RTCRay8 rays;
      memcpy(rays.org_x, from, 32);
      memcpy(rays.org_y, from + 8, 32);
      memcpy(rays.org_z, from + 16, 32);
      _Alignas(32) int valid[8];
      for (int lane = 0; lane < 8; lane++) {
        rays.dir_x[lane] = to[lane] - from[lane];
        rays.dir_y[lane] = to[8 + lane] - from[8 + lane];
        rays.dir_z[lane] = to[16 + lane] - from[16 + lane];
        rays.tnear[lane] = MARGIN;
        rays.tfar[lane] = 1 - MARGIN;
        rays.time[lane] = 0;
        rays.mask[lane] = -1;
        rays.flags[lane] = 0;
        valid[lane] = -1;
      }
      struct RTCIntersectContext context;
      rtcInitIntersectContext(&context);
      context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
      rtcOccluded8(valid, scene, &context, &rays);
      for (int lane = 0; lane < 8; lane++) blocked += rays.tfar[lane] < 0;
    }
    const double seconds = now() - start;
    if (seconds < best) best = seconds;
  }
  printf("%.9f %zu\n", best, blocked);
  return 0;
}
