// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/references/receiver_points.h"

#include <algorithm>
#include <cmath>

#include "renderer/frame/g_buffer.h"
#include "renderer/references/parallel.h"

namespace limen::references {

std::vector<ReceiverPoint> readReceiverPoints(frame::Frame& frame, const Triangles& triangles) {
  const auto& ids = frame.get<frame::TriangleIds>();
  const auto& receivers = frame.get<frame::Receivers>();
  const auto& positions = frame.get<frame::GBufferChannel>(frame::ChannelSetting{frame::Channel::Position});
  const std::vector<uint32_t> id = ids.texture().readUint();
  const Image receiver = receivers.texture().read(), position = positions.texture().read();
  const glm::dvec3 eye(glm::inverse(frame.anchorToCamera())[3]);

  const auto add = [&](uint32_t pixel, std::vector<ReceiverPoint>& points) {
    const float *at = &position.data[4 * size_t{pixel}], slope = receiver.data[4 * size_t{pixel} + 3];
    if (id[pixel] == frame::TriangleIds::kNone || !(slope >= 0.0F)) return;
    ReceiverPoint point{pixel, id[pixel], {at[0], at[1], at[2]}, {}};
    const glm::dvec3 a = triangles.corner(point.triangle, 0);
    const glm::dvec3 n =
        glm::cross(triangles.corner(point.triangle, 1) - a, triangles.corner(point.triangle, 2) - a);
    const double length = glm::length(n);
    // A degenerate triangle has no plane from which to see a light.
    if (!(length > 0.0) || !std::isfinite(length + glm::dot(point.position, point.position))) return;
    point.normal = n / length;
    point.position -= point.normal * glm::dot(point.normal, point.position - a);
    if (glm::dot(point.normal, eye - point.position) < 0.0) point.normal = -point.normal;
    points.push_back(point);
  };
  constexpr size_t kRun = 256;  // pixels
  std::vector<std::vector<ReceiverPoint>> runs((id.size() + kRun - 1) / kRun);
  parallelFor(runs.size(), [&](size_t, size_t first, size_t last) {
    for (size_t run = first; run < last; ++run)
      for (size_t pixel = run * kRun; pixel < std::min((run + 1) * kRun, id.size()); ++pixel)
        add(static_cast<uint32_t>(pixel), runs[run]);
  });
  std::vector<ReceiverPoint> points;
  points.reserve(id.size());
  for (const std::vector<ReceiverPoint>& run : runs) points.insert(points.end(), run.begin(), run.end());
  return points;
}

}  // namespace limen::references
