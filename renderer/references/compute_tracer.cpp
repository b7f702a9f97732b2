// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/references/compute_tracer.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <deque>

#include "experiments/base/cancel.h"
#include "renderer/references/parallel.h"

namespace limen::references {
namespace {

using HostClock = std::chrono::steady_clock;

constexpr uint32_t kBatch = 1U << 18;                             ///< receivers in GPU memory
constexpr uint32_t kMostGroups = 65535;                           ///< of a dispatch
constexpr uint32_t kMostSamples = 4096;                           ///< of a receiver in one dispatch
constexpr uint32_t kFewestRays = 1U << 16, kMostRays = 1U << 24;  ///< of a dispatch
constexpr double kDispatchS = 0.02;

/// At most two dispatches wait for the GPU, so that those that are started know how long others took.
class InFlight {
 public:
  ~InFlight() {
    while (!fences_.empty()) wait();
  }
  /// Returns seconds since the dispatch before, if it can tell.
  double add() {
    fences_.push_back(glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0));
    glFlush();
    if (fences_.size() < 3) return 0.0;
    wait();
    const auto now = HostClock::now(), before = std::exchange(finished_, now);
    return before == HostClock::time_point{} ? 0.0 : std::chrono::duration<double>(now - before).count();
  }

 private:
  void wait() {
    constexpr GLuint64 kSecond = 1'000'000'000;
    while (glClientWaitSync(fences_.front(), GL_SYNC_FLUSH_COMMANDS_BIT, kSecond) == GL_TIMEOUT_EXPIRED) {
    }
    glDeleteSync(fences_.front());
    fences_.pop_front();
  }
  std::deque<GLsync> fences_;
  HostClock::time_point finished_{};
};

uint32_t shapeCode(scene::LightShape shape) {
  switch (shape) {
    case scene::LightShape::Rectangle:
      return kShadowLightRectangle;
    case scene::LightShape::Disc:
      return kShadowLightDisc;
    case scene::LightShape::Polygon:
      break;
  }
  return kShadowLightPolygon;
}

/// Invocations that share a receiver: a power of two.
uint32_t lanesFor(int64_t samples) {
  uint32_t lanes = kShadowRayGroup;
  while (lanes > 1 && lanes / 2 >= samples) lanes /= 2;
  return lanes;
}

ShadowReceiver toBuffer(const ReceiverPoint& point) {
  const glm::dvec3 p = point.position, n = point.normal;
  return {p.x, p.y, p.z, n.x, n.y, n.z, point.triangle, point.pixel};
}

}  // namespace

ComputeTracer::ComputeTracer(gl::Context& context, const ray_tracing::RayScene& scene,
                             const Triangles& triangles)
    : triangles_(triangles),
      scene_(scene),
      program_(context.programs().compute("renderer/references/shadow_rays.comp.glsl")),
      receivers_(int64_t{kBatch} * int64_t{sizeof(ShadowReceiver)}, nullptr),
      counts_(int64_t{kBatch} * int64_t{sizeof(ShadowCounts)}, nullptr),
      raysPerDispatch_(kFewestRays * (context.device().software ? 1 : 4)),
      software_(context.device().software) {}

void ComputeTracer::setLight(const LightSamples& samples, glm::dvec3 anchor) {
  const scene::AreaLight& light = samples.light;
  const glm::dvec3 centre = light.centre - anchor, right = light.axisX * light.size.x,
                   up = light.axisY * light.size.y;
  const uint64_t seed = mixBits(samples.seed);
  ShadowLight out{};
  out.centreX = centre.x, out.centreY = centre.y, out.centreZ = centre.z;
  out.rightX = right.x, out.rightY = right.y, out.rightZ = right.z;
  out.upX = up.x, out.upY = up.y, out.upZ = up.z;
  out.planeTolerance = triangles_.planeTolerance();
  out.cell = samples.side > 0 ? 1.0 / samples.side : 1.0;
  out.shape = shapeCode(samples.map.shape());
  out.outlineCount = static_cast<uint32_t>(samples.map.triangles().size());
  out.side = static_cast<uint32_t>(samples.side);
  out.part = static_cast<uint32_t>(samples.part);
  out.seedLow = static_cast<uint32_t>(seed), out.seedHigh = static_cast<uint32_t>(seed >> 32U);
  out.farEnd = static_cast<float>(1.0 - kLightMargin);
  out.nearDistance = static_cast<float>(kNearTolerances * triangles_.planeTolerance());
  light_.emplace(std::vector{out});
  std::vector<OutlineTriangle> outline;
  for (size_t i = 0; i < samples.map.triangles().size(); ++i) {
    const Triangle2& t = samples.map.triangles()[i];
    outline.push_back({t[0].x, t[0].y, t[1].x, t[1].y, t[2].x, t[2].y, samples.map.cumulativeShares()[i]});
  }
  outline_.emplace(outline);
}

std::vector<ShadowCounts> ComputeTracer::trace(const std::vector<ReceiverPoint>& points,
                                               const LightSamples& samples, glm::dvec3 anchor) {
  std::vector<ShadowCounts> out(points.size());
  setLight(samples, anchor);
  std::vector<ShadowReceiver> batch;
  for (size_t first = 0; first < points.size() && !cancelToken().stop_requested(); first += kBatch) {
    const size_t count = std::min<size_t>(points.size() - first, kBatch);
    batch.resize(count);
    parallelFor(count, [&](size_t, size_t begin, size_t end) {
      for (size_t i = begin; i < end; ++i) batch[i] = toBuffer(points[first + i]);
    });
    receivers_.write(0, static_cast<int64_t>(count * sizeof(ShadowReceiver)), batch.data());
    counts_.clearUint(0);
    traceBatch(static_cast<uint32_t>(count), samples);
    const auto counts = counts_.read<ShadowCounts>(0, static_cast<int64_t>(count));
    std::copy(counts.begin(), counts.end(), out.begin() + static_cast<std::ptrdiff_t>(first));
  }
  return out;
}

std::vector<glm::dvec3> ComputeTracer::lightPoints(gl::Context& context, const LightSamples& samples,
                                                   glm::dvec3 anchor, uint32_t pixel) {
  setLight(samples, anchor);
  const gl::Program& program = context.programs().compute("renderer/references/light_points.comp.glsl");
  const gl::Buffer points(samples.count * int64_t{sizeof(glm::dvec3)}, nullptr);
  light_->bindStorage(kShadowRayLightBuffer);
  outline_->bindStorage(kShadowRayOutlineBuffer);
  points.bindStorage(kShadowRayReceiversBuffer);
  program.set("pixel", pixel);
  program.set("endSample", static_cast<uint32_t>(samples.count));
  program.dispatch({static_cast<int>(samples.count), 1}, {kShadowRayGroup, 1});
  return points.read<glm::dvec3>();
}

void ComputeTracer::traceBatch(uint32_t receivers, const LightSamples& samples) {
  const auto all = static_cast<uint32_t>(samples.count);
  const uint32_t lanes = lanesFor(samples.count), inGroup = kShadowRayGroup / lanes;
  // A software renderer limits the loop iterations of an invocation, over all of its rays.
  const uint32_t atOnce = std::min(all, software_ ? lanes : kMostSamples);
  scene_.bind(program_);
  light_->bindStorage(kShadowRayLightBuffer);
  outline_->bindStorage(kShadowRayOutlineBuffer);
  receivers_.bindStorage(kShadowRayReceiversBuffer);
  counts_.bindStorage(kShadowRayCountsBuffer);
  program_.set("lanes", lanes);
  InFlight inFlight;
  for (uint32_t sample = 0; sample < all; sample += atOnce) {
    const uint32_t end = std::min(sample + atOnce, all);
    program_.set("firstSample", sample);
    program_.set("endSample", end);
    for (uint32_t first = 0; first < receivers;) {
      if (cancelToken().stop_requested()) return;
      const uint32_t count = std::min(
          {std::max(raysPerDispatch_ / (end - sample), 1U), kMostGroups * inGroup, receivers - first});
      program_.set("firstReceiver", first);
      program_.set("endReceiver", first + count);
      program_.dispatch({static_cast<int>((count + inGroup - 1) / inGroup), 1}, {1, 1});
      first += count;
      const double seconds = inFlight.add();
      if (seconds > 2.0 * kDispatchS)
        raysPerDispatch_ = std::max(raysPerDispatch_ / 2, kFewestRays);
      else if (seconds > 0.0 && seconds < 0.5 * kDispatchS)
        raysPerDispatch_ = std::min(raysPerDispatch_ * 2, kMostRays);
    }
  }
}

}  // namespace limen::references
