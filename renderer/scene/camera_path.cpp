// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "renderer/scene/scene.h"

namespace limen::scene {
namespace {

/// The interpolated quantities of a camera, all in one vector.
struct Pose {
  glm::dvec3 eye, target, up;
  double fov;
};

Pose poseOf(const Camera& camera) { return {camera.eye, camera.target, camera.up, camera.verticalFovDeg}; }

template <class Operation>
Pose combine(const Pose& a, const Pose& b, Operation operation) {
  return {operation(a.eye, b.eye), operation(a.target, b.target), operation(a.up, b.up),
          operation(a.fov, b.fov)};
}

/// Mean velocity between two keys; zero if they share a time.
Pose slope(const CameraPath::Key& from, const CameraPath::Key& to) {
  const double span = to.timeS - from.timeS;
  const double inverse = span > 0.0 ? 1.0 / span : 0.0;
  return combine(poseOf(from.camera), poseOf(to.camera), [&](auto a, auto b) { return (b - a) * inverse; });
}

/// Derivative at key i of the parabola through it and its neighbours (Catmull-Rom for uneven times); the
/// slope of the only segment at an end or next to a cut (two keys at one time).
Pose tangent(const std::vector<CameraPath::Key>& keys, size_t i) {
  const double before = i > 0 ? keys[i].timeS - keys[i - 1].timeS : 0.0;
  const double after = i + 1 < keys.size() ? keys[i + 1].timeS - keys[i].timeS : 0.0;
  if (before <= 0.0) return slope(keys[i], keys[i + 1]);
  if (after <= 0.0) return slope(keys[i - 1], keys[i]);
  const double weight = after / (before + after);
  return combine(slope(keys[i - 1], keys[i]), slope(keys[i], keys[i + 1]),
                 [&](auto a, auto b) { return a * weight + b * (1.0 - weight); });
}

}  // namespace

Camera CameraPath::at(double timeS) const {
  if (keys.empty()) return {};
  // Negated so that NaN gives the first key.
  if (!(timeS > keys.front().timeS)) {
    const double ahead = timeS - keys.front().timeS;
    if (!runIn || keys.size() < 2 || !std::isfinite(ahead) || ahead == 0.0) return keys.front().camera;
    const Pose pose =
        combine(poseOf(keys.front().camera), tangent(keys, 0), [&](auto a, auto b) { return a + b * ahead; });
    return {pose.eye, pose.target, pose.up, std::clamp(pose.fov, 0.01, 179.0)};
  }
  if (timeS >= keys.back().timeS) return keys.back().camera;
  const auto next = std::upper_bound(keys.begin(), keys.end(), timeS,
                                     [](double time, const Key& key) { return time < key.timeS; });
  const size_t i = static_cast<size_t>(next - keys.begin()) - 1;
  const double span = keys[i + 1].timeS - keys[i].timeS, u = (timeS - keys[i].timeS) / span;
  const Pose from = poseOf(keys[i].camera), to = poseOf(keys[i + 1].camera);
  const Pose leaving = tangent(keys, i), arriving = tangent(keys, i + 1);
  // Hermite basis, written as offsets from the first key: exact if nothing moves, however far from the
  // origin.
  const double step = u * u * (3.0 - 2.0 * u), out = u * (1.0 - u) * (1.0 - u) * span,
               in = u * u * (u - 1.0) * span;
  Pose pose = combine(from, to, [&](auto a, auto b) { return a + (b - a) * step; });
  pose = combine(pose, leaving, [&](auto a, auto b) { return a + b * out; });
  pose = combine(pose, arriving, [&](auto a, auto b) { return a + b * in; });
  // Opposite up vectors cancel halfway; the picture must stay upright nevertheless.
  if (glm::dot(pose.up, pose.up) < 1e-12) pose.up = from.up;
  return {pose.eye, pose.target, pose.up, std::clamp(pose.fov, 0.01, 179.0)};
}

}  // namespace limen::scene
