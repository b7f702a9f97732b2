// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "experiments/base/enum_names.h"
#include "renderer/techniques/visibility_fields/receiver_rays.h"

namespace limen::techniques {

/// How much a surface at some distance leaves to see (Gaitatzes 2012, equation 3, which does not say).
enum class Falloff { Binary, Linear, Exponential };
constexpr EnumNames<Falloff, 3> enumNames(Falloff) {
  return {
      {{{Falloff::Binary, "binary"}, {Falloff::Linear, "linear"}, {Falloff::Exponential, "exponential"}}}};
}

template <class S>
Binding<S> falloffBinding(Falloff S::*member) {
  return {
      member, "falloff",
      "Visibility by distance: 0 within the radius; rising to 1 at the radius; 1 - exp(-distance / radius)",
      "Gaitatzes 2012, equation 3 (form not given there)"};
}
template <class S>
Binding<S> falloffRadiusBinding(double S::*member) {
  return {member,
          "radius",
          {0.0001, 10.0},
          "",
          "Distance of the falloff, as a share of the scene's diagonal",
          "Gaitatzes 2012, equation 3 (value not given there)"};
}

/// Rays over the half space of a receiver, by the cosine, and what their distances mean.
struct OcclusionRays {
  ReceiverRays receiver;
  Falloff falloff = Falloff::Binary;
  double radius = 0.1;
  static const SettingsTable<OcclusionRays>& table();
  static void makeInputs(frame::Frame& frame) { ReceiverRays::makeInputs(frame); }
  /// For occlusion_rays.glsl; after makeInputs().
  void configure(const gl::Program& program, frame::Frame& frame) const;
};

}  // namespace limen::techniques
