// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "renderer/frame/shadow_map.h"
#include "renderer/techniques/technique.h"

namespace limen::techniques {

/// Which techniques a technique can be wrapped around that runs another one: for chosen points, for the
/// samples of a pixel, for the frames of a motion.
enum class InnerKind {
  Backprojecting,  ///< soft_shadows/backprojection and soft_shadows/bitmask
  OrRayTraced,     ///< these, and soft_shadows/ray_traced
  OrExact          ///< these, and soft_shadows/exact_union
};

/// `inner`, and those parameters of the inner techniques that matter for speed and error, as these declare
/// them: resolution, budget, structure, fixed_level, occluders, bias, slope_bias, max_slope; `rays` where one
/// may be ray traced. All others keep their defaults.
std::vector<Parameter> innerParameters(InnerKind kind);

/// Throws Error where a value is about another technique than the inner one, or the inner one refuses it.
void checkInner(const ParameterValues& values);

/// The inner technique; its frame decides which points it sees.
std::unique_ptr<Technique> makeInner(const ParameterValues& values);

/// The map that a backprojecting inner technique reads.
frame::ShadowMapSettings innerMap(const ParameterValues& values);

/// What count() of the inner technique returns, as far as innerCounterNames() holds it.
std::vector<Counter> countInner(Technique& inner, frame::Frame& frame);
std::vector<Quantity> innerCounterNames();

}  // namespace limen::techniques
