// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <optional>

#include "renderer/gl/buffer.h"
#include "renderer/surfaces/patterns.h"

namespace limen::techniques {

/// Tessellation patterns stored as meshes: samples (patternSample()) and strips of indices, each pattern
/// once.
class PatternMeshes {
 public:
  struct Mesh {
    uint32_t indices = 0, firstIndex = 0, firstVertex = 0, vertices = 0;
  };

  /// Buffers for so many vertices, and six times as many indices.
  PatternMeshes(int64_t capacity, bool cornerFix);
  /// The pattern of the factors, stored now unless it is there; none if it does not fit.
  std::optional<Mesh> meshOf(surfaces::Domain domain, const surfaces::Factors& factors);

  const gl::Buffer& samples() const { return samples_; }  ///< ivec4
  const gl::Buffer& indices() const { return indices_; }
  int64_t count() const { return static_cast<int64_t>(meshes_.size()); }
  int64_t bytesUsed() const { return vertexCount_ * 16 + indexCount_ * 4; }

 private:
  bool cornerFix_;
  int64_t capacity_, vertexCount_ = 0, indexCount_ = 0;
  gl::Buffer samples_, indices_;
  std::map<std::pair<surfaces::Domain, surfaces::Factors>, Mesh> meshes_;
};

}  // namespace limen::techniques
