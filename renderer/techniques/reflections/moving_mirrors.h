// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "experiments/base/error.h"
#include "renderer/frame/frame.h"

namespace limen::techniques {

/// Whether a part of the scene moves.
inline bool movesPart(const scene::Scene& scene, size_t part) {
  for (const scene::PartMotion& motion : scene.motions)
    if (motion.part == part) return true;
  return false;
}

/// Throws Error with this reason if a mirror that the frame shows moves.
inline void refuseMovingMirrors(const frame::Frame& frame, const std::string& reason) {
  const scene::Scene& scene = frame.scene();
  for (const scene::PartMotion& motion : scene.motions)
    if (frame.shownMirrors().has(motion.part) &&
        scene.materials[scene.parts[motion.part].material].reflects())
      throw Error(reason + ", and part '" + scene.parts[motion.part].name + "' moves", scene.name,
                  "choose reflections/ray_traced or reflections/ray_hierarchy");
}

}  // namespace limen::techniques
