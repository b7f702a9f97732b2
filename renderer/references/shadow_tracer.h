// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "experiments/base/enum_names.h"
#include "renderer/frame/frame.h"
#include "renderer/references/light_samples.h"
#include "renderer/references/receiver_points.h"
#include "renderer/references/reference_bindings.h"
#include "renderer/references/triangles.h"

namespace limen::references {

/// What traces shadow rays. The rays and the rule for hits at their start are the same (EmbreeScene); rays
/// within rounding of an edge may differ.
enum class Tracer {
  Auto,  ///< Gpu, or Cpu on a software renderer or for a scene that the GPU cannot hold
  Gpu,   ///< ray_tracing::RayScene
  Cpu    ///< Embree
};
constexpr EnumNames<Tracer, 3> enumNames(Tracer) {
  return {{{{Tracer::Auto, "auto"}, {Tracer::Gpu, "gpu"}, {Tracer::Cpu, "cpu"}}}};
}
inline constexpr const char* kTracerSummary =
    "What traces the rays; auto: the GPU, or the CPU (Embree) on a software renderer. They agree but for "
    "rays "
    "within rounding of an edge";

/// Counts, for each receiver, the points of a light that it sees.
class ShadowTracer {
 public:
  virtual ~ShadowTracer() = default;
  /// One for each point. A point of the light behind a receiver's plane counts as hidden without a ray: a
  /// surface is opaque, whether or not the body is closed. `anchor`: what the points are relative to. Ends
  /// early, its result incomplete, if the calling thread's work is cancelled (experiments/base/cancel.h).
  virtual std::vector<ShadowCounts> trace(const std::vector<ReceiverPoint>& points,
                                          const LightSamples& samples, glm::dvec3 anchor) = 0;
  /// For a run's record.
  virtual std::string remark() const = 0;
  /// In GPU memory.
  virtual int64_t bytes() const { return 0; }
};

/// `triangles`, of the frame's scene, must outlive it. Throws Error if the GPU is asked for and cannot hold
/// the scene.
std::unique_ptr<ShadowTracer> makeShadowTracer(Tracer tracer, frame::Frame& frame,
                                               const Triangles& triangles);

/// Share of the light that is seen; NaN if a ray was cut short.
double seenShare(const ShadowCounts& counts, int64_t samples);

}  // namespace limen::references
