// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "renderer/techniques/reflections/vertex_reflection/reflected_mesh.h"
#include "renderer/techniques/reflections/vertex_reflection/reflector.h"
#include "renderer/techniques/reflections/vertex_reflection/vertex_reflection_bindings.h"
#include "renderer/techniques/technique.h"

namespace limen::techniques {

/// Costs, failures and errors of solved vertices, over all reflectors. Errors are against the reflection
/// points that the solver finds in double precision on the reflector's own triangles and vertex normals, of
/// up to kTruths vertices of each reflector, spread evenly; only points whose half-vector is the normal to
/// within 1e-6 rad count as true.
class ReflectionStatistics {
 public:
  static constexpr int kTruths = 1000;

  void add(const StarReflector& reflector, const reflections::ReflectedMesh& mesh, const frame::Frame& frame,
           const SecantSettings& settings, const std::vector<glm::vec4>& reflected);
  void setTessellated(const ReflectionCounts& counts) { tessellated_ = counts; }
  std::vector<Counter> counters() const;
  static std::vector<Quantity> quantities();

 private:
  std::vector<int> iterations_;
  std::array<int64_t, 5> outcomes_{};
  int64_t exchanges_ = 0, restarts_ = 0, atCap_ = 0;
  std::array<int64_t, 4> triangles_{};
  std::array<int64_t, 3> extrema_{};  // by reflections::Extremum
  std::vector<double> angles_, distances_;
  ReflectionCounts tessellated_{};
};

}  // namespace limen::techniques
