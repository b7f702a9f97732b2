// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "experiments/base/enum_names.h"
#include "experiments/base/settings_table.h"
#include "renderer/frame/frame.h"
#include "renderer/gl/program.h"
#include "renderer/visibility_fields/rigid_objects.h"

namespace limen::techniques {

/// How much a surface at some distance leaves to see (Gaitatzes 2012, equation 3, which does not say).
enum class Falloff { Binary, Linear, Exponential };
constexpr EnumNames<Falloff, 3> enumNames(Falloff) {
  return {
      {{{Falloff::Binary, "binary"}, {Falloff::Linear, "linear"}, {Falloff::Exponential, "exponential"}}}};
}

/// The rays of a pixel and what their distances mean. A field and the tracer that it is compared with take
/// the same.
struct OcclusionRays {
  int64_t rays = 64;
  bool turned = false;
  int64_t seed = 1;
  Falloff falloff = Falloff::Binary;
  double radius = 0.1;
  bool selfOcclusion = true;
  visibility_fields::ObjectForm objects = visibility_fields::ObjectForm::Parts;
  static const SettingsTable<OcclusionRays>& table();
  /// Throws Error unless `rays` is a square number.
  void check() const;

  int side() const;
  /// Uniforms of occlusion_rays.glsl.
  void configure(const gl::Program& program, const frame::Frame& frame) const;
};

}  // namespace limen::techniques
