// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>

#include "renderer/gl/buffer.h"
#include "renderer/techniques/tessellation/patterns/pattern_meshes.h"

namespace limen::techniques {

/// Uniform patterns of powers of two, whose vertices are those of the finest (SC-61), and strips between two
/// numbers of segments along one side (SC-62). (Schwarz 2009, section 7.5.2)
class ConnectionPatterns {
 public:
  /// Of one domain; `most`: a power of two.
  ConnectionPatterns(surfaces::Domain domain, int most);

  PatternMeshes::Mesh levelOf(int segments) const { return levels_.at(segments); }
  /// Between the coarser patch's segments and the finer one's or as many, turned as the coarser patch.
  PatternMeshes::Mesh stripOf(int coarse, int fine) const { return strips_.at({coarse, fine}); }
  /// A band along a side: samples (q, segments, 0 or 1 on either edge, 0).
  PatternMeshes::Mesh borderOf(int segments) const { return borders_.at(segments); }
  const std::vector<glm::ivec4>& samples() const { return samples_; }  ///< of strips: (q, segments, finer, 0)
  const std::vector<uint32_t>& indices() const { return indices_; }

 private:
  void addStrip(int coarse, int fine);
  void addBorder(int segments);

  std::vector<glm::ivec4> samples_;
  std::vector<uint32_t> indices_;
  std::map<int, PatternMeshes::Mesh> levels_, borders_;
  std::map<std::pair<int, int>, PatternMeshes::Mesh> strips_;
};

}  // namespace limen::techniques
