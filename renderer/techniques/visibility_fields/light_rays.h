// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "experiments/base/enum_names.h"
#include "renderer/techniques/visibility_fields/receiver_rays.h"

namespace limen::techniques {

/// What rays of a soft shadow are aimed at.
enum class LightForm {
  Rectangle,  ///< the scene's light
  Sphere      ///< a sphere about its centre whose diameter is its longer side
};
constexpr EnumNames<LightForm, 2> enumNames(LightForm) {
  return {{{{LightForm::Rectangle, "rectangle"}, {LightForm::Sphere, "sphere"}}}};
}

/// Rays from a receiver to points of a light, in the cells of a grid over it.
struct LightRays {
  ReceiverRays receiver;
  LightForm light = LightForm::Sphere;
  static const SettingsTable<LightRays>& table();
  static void makeInputs(frame::Frame& frame);
  /// For shadow_rays.glsl; after makeInputs().
  void configure(const gl::Program& program, frame::Frame& frame) const;
};

}  // namespace limen::techniques
