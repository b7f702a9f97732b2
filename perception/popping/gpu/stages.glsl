// SPDX-License-Identifier: BSD-3-Clause

// What a debug image may show of a frame.
struct Stages {
  vec3 contrast, response;
  float luminance, velocity;
};
