// SPDX-License-Identifier: BSD-3-Clause
// What decides which of two surfaces a pixel sees: as the raster does, by reversed depth, then by the smaller
// triangle number (frame::TriangleIds).
struct Key {
  float depth;  // 0: nothing
  uint triangle;
};

bool isNearer(Key a, Key b) { return a.depth > b.depth || (a.depth == b.depth && a.triangle < b.triangle); }
