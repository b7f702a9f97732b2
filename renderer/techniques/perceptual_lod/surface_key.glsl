// SPDX-License-Identifier: BSD-3-Clause
// What decides which of two surfaces a pixel sees: as the raster does, by reversed depth, then by the smaller
// triangle number (frame::TriangleIds).
const uint kNoTriangle = 0xffffffffu;
const uint kBackgroundLayer = 0u;  // layers of objects count from 1

struct Key {
  float depth;  // 0: nothing
  uint triangle, layer;
};

bool isNearer(Key a, Key b) { return a.depth > b.depth || (a.depth == b.depth && a.triangle < b.triangle); }
uvec4 packKey(Key key) { return uvec4(floatBitsToUint(key.depth), key.triangle, key.layer, 0u); }
Key unpackKey(uvec4 packedKey) { return Key(uintBitsToFloat(packedKey.x), packedKey.y, packedKey.z); }
