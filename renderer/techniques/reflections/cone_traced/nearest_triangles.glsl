// SPDX-License-Identifier: BSD-3-Clause
// The nearest LAYERS triangles of a cone, kept in a heap whose root is the farthest, then in order. Of two at the same
// distance the one of the lower number is nearer, so that the order of lists changes nothing.
uvec2 kept[LAYERS];  // bits of the distance, triangle
int keptCount;

void keepNone() {
  kept[0] = uvec2(0u);
  keptCount = 0;
}

bool isNearer(uvec2 a, uvec2 b) { return a.x < b.x || (a.x == b.x && a.y < b.y); }

void siftDown(int at, int count) {
  const uvec2 item = kept[at];
  while (true) {
    int child = 2 * at + 1;
    if (child >= count) break;
    if (child + 1 < count && isNearer(kept[child], kept[child + 1])) ++child;
    if (!isNearer(item, kept[child])) break;
    kept[at] = kept[child];
    at = child;
  }
  kept[at] = item;
}

void keep(uvec2 item) {
  if (keptCount < LAYERS) {
    int at = keptCount++;
    while (at > 0) {
      const int above = (at - 1) / 2;
      if (!isNearer(kept[above], item)) break;
      kept[at] = kept[above];
      at = above;
    }
    kept[at] = item;
  } else if (isNearer(item, kept[0])) {
    kept[0] = item;
    siftDown(0, LAYERS);
  }
}

void sortKept() {
  for (int end = keptCount - 1; end > 0; --end) {
    const uvec2 farthest_ = kept[0];
    kept[0] = kept[end];
    kept[end] = farthest_;
    siftDown(0, end);
  }
}
