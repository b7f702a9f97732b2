// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "renderer/frame/shadow_map.h"
#include "renderer/techniques/technique.h"

namespace limen::techniques {

/// Which techniques a technique can be wrapped around that runs another one for chosen points alone.
enum class InnerKind {
  Backprojecting,  ///< soft_shadows/backprojection and soft_shadows/bitmask
  AnyVisibility    ///< these, and soft_shadows/ray_traced
};

/// `inner`, and those parameters of the backprojecting techniques that matter for speed and error, as these
/// declare them: resolution, budget, structure, bias, slope_bias, max_slope. All others keep their defaults.
std::vector<Parameter> innerParameters(InnerKind kind);

/// Throws Error where the values that go to the inner technique do not go together.
void checkInner(const ParameterValues& values);

/// The inner technique; its frame decides which points it sees.
std::unique_ptr<Technique> makeInner(const ParameterValues& values);

/// The map that a backprojecting inner technique reads.
frame::ShadowMapSettings innerMap(const ParameterValues& values);

}  // namespace limen::techniques
