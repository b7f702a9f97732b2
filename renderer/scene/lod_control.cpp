// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/scene/lod_control.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace limen::scene {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

/// Pixels per unit at distance 1, at the centre of the picture.
double focalPx(const LodView& view) {
  return 0.5 * view.heightPx / std::tan(0.5 * glm::radians(view.camera.verticalFovDeg));
}

template <class Choose>
LodSelection choose(const Scene& scene, Choose level) {
  LodSelection out;
  for (const LodObject& object : scene.lodObjects) out.levels.push_back(level(object));
  return out;
}

}  // namespace

double viewDistance(const LodObject& object, const Camera& camera) {
  return glm::length(object.bounds.centre() - camera.eye);
}

double screenExtentPx(const LodObject& object, const LodView& view) {
  const double distance = viewDistance(object, view.camera), radius = 0.5 * object.bounds.diagonal();
  if (!(distance > radius)) return kInfinite;
  // The sphere's tangent cone meets the plane at distance 1 at r / sqrt(d^2 - r^2).
  return 2.0 * focalPx(view) * radius / std::sqrt(distance * distance - radius * radius);
}

double screenErrorPx(const LodObject& object, int level, const LodView& view) {
  const double deviation = object.levels.at(static_cast<size_t>(level)).deviation;
  if (!(deviation > 0.0)) return 0.0;
  const glm::dvec3 outside = glm::max(
      glm::max(object.bounds.low - view.camera.eye, view.camera.eye - object.bounds.high), glm::dvec3(0.0));
  const double nearest = glm::length(outside);
  return nearest > 0.0 ? focalPx(view) * deviation / nearest : kInfinite;
}

LodSelection levelsByDistance(const Scene& scene, const LodView& view, double factor) {
  return choose(scene, [&](const LodObject& object) {
    const double distance = viewDistance(object, view.camera);
    return static_cast<int>(std::count_if(object.switchDistances.begin(), object.switchDistances.end(),
                                          [&](double from) { return distance >= factor * from; }));
  });
}

LodSelection levelsByScreenExtent(const Scene& scene, const LodView& view, double finestPx, double ratio) {
  assert(ratio > 0.0 && ratio < 1.0);
  return choose(scene, [&](const LodObject& object) {
    const double extent = screenExtentPx(object, view);
    int level = 0;
    for (double from = finestPx; extent < from && level + 1 < static_cast<int>(object.levels.size());
         from *= ratio)
      ++level;
    return level;
  });
}

LodSelection levelsByScreenError(const Scene& scene, const LodView& view, double tolerancePx) {
  return choose(scene, [&](const LodObject& object) {
    int level = static_cast<int>(object.levels.size()) - 1;
    while (level > 0 && !(screenErrorPx(object, level, view) <= tolerancePx)) --level;
    return level;
  });
}

double largestScreenErrorPx(const Scene& scene, const LodSelection& selection, const LodView& view) {
  double largest = 0.0;
  for (size_t i = 0; i < scene.lodObjects.size(); ++i)
    if (selection.levels.at(i) != LodSelection::kOmitted)
      largest = std::max(largest, screenErrorPx(scene.lodObjects[i], selection.levels[i], view));
  return largest;
}

}  // namespace limen::scene
