// SPDX-License-Identifier: BSD-3-Clause
// Triangles into a depth image, or (IDS) into the indices of those that won. See compute_raster.h.
// Without LARGE: an invocation a triangle; those with many pixels are queued in runs. With LARGE: the queue, a
// group a run.
#include "renderer/frame/scene_buffers.glsl"

layout(local_size_x = 64) in;
// A buffer, not an image: its atomics without a result cost no waiting.
#ifdef IDS
layout(std430, binding = 4) readonly buffer Depths { uint depths[]; };
layout(std430, binding = 5) buffer Ids { uint ids[]; };
#else
layout(std430, binding = 4) buffer Depths { uint depths[]; };
#endif
layout(std430, binding = 3) buffer Queue {
  uint queued;
  uint padding[3];
  uvec2 runs[];  // triangle, first pixel of the run in its bounding box
};

#ifdef PEEL
layout(binding = 0) uniform sampler2D previousDepth;
uniform float peelBias;
#endif

uniform mat4 anchorToClip;
uniform float near;
uniform ivec2 sizePx;
uniform uint triangleCount;  // of all ranges
uniform int rangeCount;      // 0: the triangles from 0 on

// As TriangleRanges has them: first triangle of a range, and the triangles up to its end.
layout(std430, binding = 6) readonly buffer Ranges { uvec2 ranges[]; };

const int kSmall = 32;   // pixels of a bounding box that one invocation takes on
const int kRun = 1024;   // pixels of a run

struct Triangle {
  vec3 a, b, c;   // clip space x, y, w
  ivec2 low, size;  // bounding box in pixels
};

vec3 clipPosition(uint vertex) {
  precise const vec4 clip = anchorToClip * vec4(scenePosition(vertex), 1.0);
  return clip.xyw;
}

// Pixel coordinates of a clip position, centre of pixel (0, 0) at 0. Row 0 is the top of clip space.
vec2 pixelOf(vec3 v) { return (vec2(v.x, -v.y) / v.z * 0.5 + 0.5) * vec2(sizePx) - 0.5; }

// Extends pixel bounds by what an edge shows in front of the near plane: its start, and where it passes the plane.
void extendBounds(vec3 from, vec3 to, inout vec2 low, inout vec2 high) {
  if (from.z >= near) {
    const vec2 at = pixelOf(from);
    low = min(low, at);
    high = max(high, at);
  }
  if ((from.z >= near) != (to.z >= near)) {
    vec3 crossing = mix(from, to, (near - from.z) / (to.z - from.z));
    crossing.z = near;
    // At the near plane a pixel is a tiny length; a share of the picture covers the rounding of the crossing.
    const vec2 at = pixelOf(crossing), slack = 1e-3 * (abs(at) + vec2(sizePx));
    low = min(low, at - slack);
    high = max(high, at + slack);
  }
}

Triangle load(uint index) {
  const uvec3 vertices = sceneTriangle(index);
  Triangle t;
  t.a = clipPosition(vertices.x);
  t.b = clipPosition(vertices.y);
  t.c = clipPosition(vertices.z);
  t.low = ivec2(0);
  t.size = ivec2(0);
  if (max(t.a.z, max(t.b.z, t.c.z)) < near) return t;
  vec2 low = vec2(1e30), high = vec2(-1e30);
  extendBounds(t.a, t.b, low, high);
  extendBounds(t.b, t.c, low, high);
  extendBounds(t.c, t.a, low, high);
  // Slack for the rounding of the quotients, far off the screen included.
  const vec2 limit = vec2(sizePx) + 1.0;
  low = clamp(low - 0.01, vec2(-1.0), limit);
  high = clamp(high + 0.01, vec2(-1.0), limit);
  t.low = max(ivec2(ceil(low)), ivec2(0));
  t.size = max(min(ivec2(floor(high)), sizePx - 1) - t.low + 1, ivec2(0));
  if (t.size.x == 0 || t.size.y == 0) t.size = ivec2(0);
  return t;
}

float product(vec2 a, vec2 b) {
  precise const float result = a.x * b.y - a.y * b.x;
  return result;
}

void shade(Triangle t, uint index, ivec2 pixel) {
  const vec2 ndc = vec2(2.0, -2.0) * (vec2(pixel) + 0.5) / vec2(sizePx) + vec2(-1.0, 1.0);
  precise const vec2 a = t.a.xy - ndc * t.a.z, b = t.b.xy - ndc * t.b.z, c = t.c.xy - ndc * t.c.z;
  const float u = product(b, c), v = product(c, a), w = product(a, b);
  const bool positive = u >= 0.0 && v >= 0.0 && w >= 0.0, negative = u <= 0.0 && v <= 0.0 && w <= 0.0;
  precise const float sum = u + v + w;
  if (!(positive || negative) || sum == 0.0) return;
  precise const float distance = (u * t.a.z + v * t.b.z + w * t.c.z) / sum;
  if (!(distance >= near)) return;
  precise const float depth = near / distance;
#ifdef PEEL
  // Reversed depth: what lies behind is smaller.
  if (!(depth * (1.0 + peelBias) < texelFetch(previousDepth, pixel, 0).x)) return;
#endif
  const uint bits = floatBitsToUint(depth);  // positive floats are ordered as their bits
  const int at = pixel.y * sizePx.x + pixel.x;
#ifdef IDS
  if (depths[at] == bits) atomicMin(ids[at], index);
#else
  atomicMax(depths[at], bits);
#endif
}

// Pixels [first, end) of the bounding box, every `stride`-th from `start`; one division a run, none a pixel.
void shadeRun(Triangle t, uint index, int first, int end, int start, int stride) {
  int x = (first + start) % t.size.x, y = (first + start) / t.size.x;
  const int stepX = stride % t.size.x, stepY = stride / t.size.x;
  for (int i = first + start; i < end; i += stride) {
    shade(t, index, t.low + ivec2(x, y));
    x += stepX;
    y += stepY;
    if (x >= t.size.x) {
      x -= t.size.x;
      ++y;
    }
  }
}

#ifdef LARGE
void main() {
  const uint count = min(queued, QUEUE_CAPACITY);
  for (uint item = gl_WorkGroupID.x; item < count; item += gl_NumWorkGroups.x) {
    const uint index = runs[item].x;
    const Triangle t = load(index);
    const int first = int(runs[item].y);
    shadeRun(t, index, first, min(first + kRun, t.size.x * t.size.y), int(gl_LocalInvocationID.x), 64);
  }
}
#else
// Number in the scene of the n-th triangle drawn.
uint chosenTriangle(uint n) {
  if (rangeCount == 0) return n;
  int low = 0, high = rangeCount - 1;  // the first range that ends after n
  while (low < high) {
    const int middle = (low + high) / 2;
    if (ranges[middle].y > n)
      high = middle;
    else
      low = middle + 1;
  }
  return ranges[low].x + n - (low > 0 ? ranges[low - 1].y : 0u);
}

void main() {
  const uint drawn = gl_GlobalInvocationID.y * (1u << 20) + gl_GlobalInvocationID.x;
  if (gl_GlobalInvocationID.x >= (1u << 20) || drawn >= triangleCount) return;
  const uint index = chosenTriangle(drawn);
  const Triangle t = load(index);
  const int pixels = t.size.x * t.size.y;
  if (pixels <= kSmall) {
    shadeRun(t, index, 0, pixels, 0, 1);
    return;
  }
  for (int first = 0; first < pixels; first += kRun) {
    const uint slot = atomicAdd(queued, 1u);
    if (slot < QUEUE_CAPACITY)
      runs[slot] = uvec2(index, uint(first));
    else
      shadeRun(t, index, first, min(first + kRun, pixels), 0, 1);
  }
}
#endif
