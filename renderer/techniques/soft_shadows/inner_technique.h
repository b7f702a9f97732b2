// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "experiments/base/chosen_entry.h"
#include "renderer/frame/shadow_map.h"
#include "renderer/techniques/soft_shadows/map_settings.h"
#include "renderer/techniques/technique.h"

namespace limen::techniques {

/// The techniques that a wrapper can run: for chosen points, for the samples of a pixel, or for the frames of
/// a motion.
enum class InnerKind {
  Backprojecting,  ///< soft_shadows/backprojection and soft_shadows/bitmask
  OrRayTraced,     ///< these, and soft_shadows/ray_traced
  OrExact,         ///< these, and soft_shadows/exact_union
  OrPcss,          ///< these, and soft_shadows/pcss
  Coloured         ///< others: soft_shadows/bitmask_coloured and soft_shadows/ray_traced_colours
};
/// Their names as registered; the first is the default.
std::vector<std::string> innerEntries(InnerKind kind);

/// Binds the member that holds a wrapper's inner technique with all its settings:
/// `inner: {kind: bitmask, budget: 64}`.
template <class S>
Binding<S> innerBinding(ChosenEntry S::*member, InnerKind kind) {
  return registeredChoice<TechniqueInfo>(member, "inner", innerEntries(kind),
                                         "Technique that finds the visibility, with its settings");
}

/// The inner technique; its frame decides which points it sees.
std::unique_ptr<Technique> makeInner(const ChosenEntry& inner);
/// The map that a backprojecting inner technique reads: that from the light's centre.
frame::ShadowMapSettings innerMap(const ChosenEntry& inner);
/// The bias that a backprojecting inner technique adds for the receiver's slope; none if its bias has another
/// form.
SlopeBias innerBias(const ChosenEntry& inner);
/// What count() of the inner technique returns, as far as innerCounters() holds it.
std::vector<Counter> countInner(Technique& inner, frame::Frame& frame);
/// The counters of any inner technique.
std::vector<Quantity> innerCounters();

}  // namespace limen::techniques
