// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/references/shadow_tracer.h"

#include <limits>

#include "experiments/base/error.h"
#include "renderer/references/compute_tracer.h"
#include "renderer/references/embree_tracer.h"

namespace limen::references {

std::unique_ptr<ShadowTracer> makeShadowTracer(Tracer tracer, frame::Frame& frame,
                                               const Triangles& triangles) {
  if (tracer == Tracer::Cpu || (tracer == Tracer::Auto && frame.context().device().software))
    return std::make_unique<EmbreeTracer>(triangles);
  try {
    return std::make_unique<ComputeTracer>(frame.context(), frame.gpuScene().rays(frame.context()),
                                           triangles);
  } catch (const Error& error) {
    if (tracer == Tracer::Gpu) throw;
    return std::make_unique<EmbreeTracer>(triangles, "on the GPU, " + error.message());
  }
}

double seenShare(const ShadowCounts& counts, int64_t samples) {
  if (counts.seen & kShadowRayCutShort) return std::numeric_limits<double>::quiet_NaN();
  return double(counts.seen) / double(samples);
}

}  // namespace limen::references
