// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "renderer/scene/lod_set.h"

namespace limen::scene {

/// What level selection is based on: a camera and the height of its picture in pixels.
struct LodView {
  Camera camera;
  int heightPx = 1;
};

/// From the eye to the middle of the object's bounds, world units.
double viewDistance(const LodObject& object, const Camera& camera);
/// Height in px of the object's bounding sphere seen from the eye, as if at the centre of the picture;
/// infinite with the eye inside.
double screenExtentPx(const LodObject& object, const LodView& view);
/// The level's deviation in px where the object is nearest to the eye, as if it were parallel to the image
/// plane there at the centre of the picture: the usual bound (Schwarz 2009, section 10.1). Off-centre,
/// perspective stretches it by up to 1 / cos^2. Infinite with the eye inside the object's bounds, 0 for level
/// 0.
double screenErrorPx(const LodObject& object, int level, const LodView& view);

/// Each object's level from its manually set switch distances, which are multiplied by `factor`: level i + 1
/// from switchDistances[i] on. No hysteresis.
LodSelection levelsByDistance(const Scene& scene, const LodView& view, double factor = 1.0);
/// Level 0 from `finestPx` of screen extent up, level i from finestPx * ratio^i up, 0 < ratio < 1.
LodSelection levelsByScreenExtent(const Scene& scene, const LodView& view, double finestPx, double ratio);
/// Each object's coarsest level whose screenErrorPx() is at most `tolerancePx` (0.5 is the conventional
/// bound).
LodSelection levelsByScreenError(const Scene& scene, const LodView& view, double tolerancePx);

/// Largest screenErrorPx() of a selection's objects; omitted ones do not count.
double largestScreenErrorPx(const Scene& scene, const LodSelection& selection, const LodView& view);

}  // namespace limen::scene
