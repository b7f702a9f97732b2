// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/tessellation/patterns/pattern_meshes.h"

namespace limen::techniques {
namespace {

constexpr int64_t kPatternIndicesPerVertex = 6;

}  // namespace

PatternMeshes::PatternMeshes(int64_t capacity, bool cornerFix)
    : cornerFix_(cornerFix),
      capacity_(capacity),
      samples_(capacity * int64_t{sizeof(glm::ivec4)}, nullptr),
      indices_(capacity * kPatternIndicesPerVertex * 4, nullptr) {}

std::optional<PatternMeshes::Mesh> PatternMeshes::meshOf(surfaces::Domain domain,
                                                         const surfaces::Factors& factors) {
  const auto found = meshes_.find({domain, factors});
  if (found != meshes_.end()) return found->second;
  const surfaces::PatternPlan plan = surfaces::patternOf(domain, factors, cornerFix_);
  if (vertexCount_ + plan.vertices > capacity_ ||
      indexCount_ + plan.indices > capacity_ * kPatternIndicesPerVertex)
    return std::nullopt;
  std::vector<glm::ivec4> samples;
  for (int slot = 0; slot < plan.vertices; ++slot) samples.push_back(surfaces::patternSample(plan, slot));
  const std::vector<uint32_t> indices = surfaces::patternIndices(plan);
  samples_.write(vertexCount_ * 16, static_cast<int64_t>(samples.size()) * 16, samples.data());
  indices_.write(indexCount_ * 4, static_cast<int64_t>(indices.size()) * 4, indices.data());
  const Mesh mesh{static_cast<uint32_t>(indices.size()), static_cast<uint32_t>(indexCount_),
                  static_cast<uint32_t>(vertexCount_), static_cast<uint32_t>(plan.vertices)};
  vertexCount_ += plan.vertices;
  indexCount_ += plan.indices;
  meshes_.emplace(std::pair{domain, factors}, mesh);
  return mesh;
}

}  // namespace limen::techniques
