// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "renderer/scene/lod_control.h"

namespace limen::techniques {

/// Smallest factor of the switch distances with which control by distance draws at least `triangles`
/// (background included); if none does, the factor that makes all objects finest. Larger factors are finer.
double factorForTriangles(const scene::Scene& scene, const scene::LodView& view, uint64_t triangles);

}  // namespace limen::techniques
