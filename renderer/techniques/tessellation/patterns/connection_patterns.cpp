// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/tessellation/patterns/connection_patterns.h"

namespace limen::techniques {

ConnectionPatterns::ConnectionPatterns(surfaces::Domain domain, int most) {
  const auto uniform = [&](int n) { return surfaces::patternOf(domain, {n, n, n, n}); };
  const surfaces::PatternPlan finest = uniform(most);
  for (int slot = 0; slot < finest.vertices; ++slot)
    samples_.push_back(surfaces::patternSample(finest, slot));
  for (int n = 1; n <= most; n *= 2) {
    const surfaces::PatternPlan plan = uniform(n);
    const int step = most / n;
    const auto first = static_cast<uint32_t>(indices_.size());
    for (const uint32_t slot : surfaces::patternIndices(plan)) {
      if (slot == surfaces::kRestartIndex) {
        indices_.push_back(slot);
        continue;
      }
      const glm::ivec4 s = surfaces::patternSample(plan, static_cast<int>(slot));
      const int row = most - s.x * step;
      indices_.push_back(static_cast<uint32_t>(domain == surfaces::Domain::Rectangle
                                                   ? s.z * step * (most + 1) + s.x * step
                                                   : row * (row + 1) / 2 + s.z * step));
    }
    levels_[n] = {static_cast<uint32_t>(indices_.size()) - first, first, 0};
  }
  for (int coarse = 1; coarse <= most; coarse *= 2)
    for (int fine = coarse; fine <= most; fine *= 2) addStrip(coarse, fine);
  for (int n = 1; n <= most; n *= 2) addBorder(n);
}

void ConnectionPatterns::addStrip(int coarse, int fine) {
  const auto firstVertex = static_cast<uint32_t>(samples_.size()),
             firstIndex = static_cast<uint32_t>(indices_.size());
  for (int q = 0; q <= coarse; ++q) samples_.emplace_back(q, coarse, 0, 0);
  for (int q = 0; q <= fine; ++q) samples_.emplace_back(q, fine, 1, 0);
  const auto inner = [](int q) { return static_cast<uint32_t>(q); };
  const auto outer = [&](int q) { return static_cast<uint32_t>(coarse + 1 + q); };
  for (int step = 0, a = 0; step < coarse + fine; ++step) {
    const int next = surfaces::patternInnerSteps(step + 1, coarse, fine), b = step - a;
    for (const uint32_t index : next > a ? std::array{inner(a), outer(b), inner(a + 1)}
                                         : std::array{outer(b), outer(b + 1), inner(a)})
      indices_.push_back(index);
    indices_.push_back(surfaces::kRestartIndex);
    a = next;
  }
  strips_[{coarse, fine}] = {static_cast<uint32_t>(indices_.size()) - firstIndex, firstIndex, firstVertex};
}

void ConnectionPatterns::addBorder(int segments) {
  const auto firstVertex = static_cast<uint32_t>(samples_.size()),
             firstIndex = static_cast<uint32_t>(indices_.size());
  for (int q = 0; q <= segments; ++q)
    for (const int edge : {0, 1}) {
      indices_.push_back(static_cast<uint32_t>(samples_.size()) - firstVertex);
      samples_.emplace_back(q, segments, edge, 0);
    }
  borders_[segments] = {static_cast<uint32_t>(indices_.size()) - firstIndex, firstIndex, firstVertex};
}

}  // namespace limen::techniques
