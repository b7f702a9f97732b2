// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/visibility_fields/detail_by_size.h"

#include <cmath>
#include <cstdint>
#include <limits>

#include "renderer/visibility_fields/cpu_field.h"

namespace limen::techniques {
namespace vf = visibility_fields;

double objectsSizePx(const scene::Camera& camera, glm::ivec2 sizePx,
                     const std::vector<vf::RigidObject>& objects) {
  const double focalPx = 0.5 * sizePx.y / std::tan(0.5 * glm::radians(camera.verticalFovDeg));
  double squares = 0.0;
  for (const vf::RigidObject& object : objects) {
    const double distance = glm::distance(camera.eye, object.sphere.centre), radius = object.sphere.radius;
    if (!(distance > radius)) return std::numeric_limits<double>::infinity();
    // Of the cone that holds the sphere.
    squares += focalPx * focalPx * radius * radius / (distance * distance - radius * radius);
  }
  return std::sqrt(squares);
}

double boundBySize(const vf::FieldForm& form, double objectsSizePx, glm::ivec2 sizePx) {
  const double wrong = vf::fieldSpacing(form) + (form.bits == 1 ? 1.0 : 0.0);
  return std::sqrt(2.0 * M_PI) * wrong * objectsSizePx / std::sqrt(double(sizePx.x) * sizePx.y);
}

vf::FieldForm formBySize(const vf::FieldForm& finest, double objectsSizePx, glm::ivec2 sizePx, double error) {
  vf::FieldForm best = finest;
  int64_t fewest = std::numeric_limits<int64_t>::max();
  for (const int positions : {82, 290, 1090, 4226, 16642})
    for (const int directions : {8, 16, 32, 64, 128, 256})
      for (const int bits : {1, finest.bits}) {
        if (positions > finest.positions || directions > finest.directions) continue;
        vf::FieldForm form = finest;
        form.positions = positions, form.directions = directions, form.bits = bits;
        const int64_t words = int64_t{positions} * directions * form.wordsPerRow();
        if (words >= fewest || boundBySize(form, objectsSizePx, sizePx) > error) continue;
        best = form, fewest = words;
      }
  return best;
}

}  // namespace limen::techniques
