// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// Unstructured: back-projection with the reference camera, re-projection with another one (eq. 10),
//   (U, V, Z) = M (u, v, 1) + h m,  seen at (U / Z, V / Z)
// rays: 16 floats per view: three rows of (M, m), for hypotheses of the reference view; then a, b, c
// of the hypothesis there, (a + b h) / Z - c; then nothing. Twin of UnstructuredSampler.

#define RAY_TABLE 16
#define BEHIND 1e-4f  // nearer to the plane of the other camera counts as behind it

static inline int locate(__global const float* rays, int other, float u, float v, float h,
                         float* u_other, float* v_other, float* h_other) {
  __global const float* r = rays + RAY_TABLE * other;
  const float z = r[8] * u + r[9] * v + r[10] + h * r[11];
  if (!(z > BEHIND)) return 0;
  *u_other = (r[0] * u + r[1] * v + r[2] + h * r[3]) / z;
  *v_other = (r[4] * u + r[5] * v + r[6] + h * r[7]) / z;
  *h_other = (r[12] + h * r[13]) / z - r[14];
  return 1;
}

// The same for LANES pixels, and how the place changes with the pixel. Lanes behind the camera get a
// place outside of every picture.
static inline void locate_lanes(__global const float* rays, int other, vfloat u, vfloat v, float h,
                                LanePlaces* at) {
  __global const float* r = rays + RAY_TABLE * other;
  const vfloat z = r[8] * u + (r[9] * v + (r[10] + h * r[11]));
  const vfloat per_z = 1.0f / z;
  const vfloat x = (r[0] * u + (r[1] * v + (r[2] + h * r[3]))) * per_z;
  const vfloat y = (r[4] * u + (r[5] * v + (r[6] + h * r[7]))) * per_z;
  at->x = VSELECT((vfloat)(-1e6f), x, z > BEHIND);
  at->y = y;
  at->x_u = (r[0] - x * r[8]) * per_z;
  at->x_v = (r[1] - x * r[9]) * per_z;
  at->y_u = (r[4] - y * r[8]) * per_z;
  at->y_v = (r[5] - y * r[9]) * per_z;
}
