// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <variant>
#include <vector>

#include "experiments/base/settings_table.h"
#include "renderer/frame/frame.h"
#include "renderer/gl/program.h"
#include "renderer/visibility_fields/rigid_objects.h"

namespace limen::techniques {

template <class S>
Binding<S> objectsBinding(visibility_fields::ObjectSetting S::*member) {
  return {member, "objects", "What of the scene is one rigid object", "bench (auto)"};
}

/// What is made of interleaved pixels.
struct NoFilter {
  static constexpr const char *kKind = "none", *kSummary = "each pixel has the mean of its own rays";
  static const SettingsTable<NoFilter>& table();
};
struct BilateralFilter {
  static constexpr const char
      *kKind = "bilateral",
      *kSummary =
          "means over a window as wide as a tile of interleaved pixels, of pixels on the "
          "same surface";
  double angleDeg = 20.0;
  static const SettingsTable<BilateralFilter>& table();
};
using FilterSetting = std::variant<NoFilter, BilateralFilter>;

/// Where the rays of a pixel lie in their cells.
struct SamePattern {
  static constexpr const char *kKind = "same", *kSummary = "in the middle, for all pixels alike";
  static const SettingsTable<SamePattern>& table();
};
struct TurnedPattern {
  static constexpr const char *kKind = "turned", *kSummary = "other rays for each pixel, at random";
  int64_t seed = 1;
  static const SettingsTable<TurnedPattern>& table();
};
struct InterleavedPattern {
  static constexpr const char *kKind = "interleaved",
                              *kSummary =
                                  "pixels of a tile have other rays of a finer grid, one in every "
                                  "cell of their own";
  int side = 4;
  FilterSetting filter;
  static const SettingsTable<InterleavedPattern>& table();
};
using PatternSetting = std::variant<SamePattern, TurnedPattern, InterleavedPattern>;

/// Rays a pixel, its receiver and the objects that may block them: the same for a field and for the tracer
/// that it is compared with.
struct ReceiverRays {
  int64_t rays = 64;
  PatternSetting pattern;
  bool selfOcclusion = true;
  visibility_fields::ObjectSetting objects;
  static const SettingsTable<ReceiverRays>& table();
  /// Throws Error unless `rays` is a square number.
  void check() const;

  int side() const;
  /// Pixels along the side of a tile that share a grid of rays; 1: none do.
  int interleave() const;
  /// Makes the inputs of field_receiver.glsl, before a pass is opened.
  static void makeInputs(frame::Frame& frame);
  /// Textures and uniforms of field_receiver.glsl and of the rays' cells; after makeInputs().
  void configure(const gl::Program& program, frame::Frame& frame) const;
};

/// Throws Error, with how to mend it, if there are more objects than can have fields.
void checkObjectCount(const std::vector<visibility_fields::RigidObject>& objects, const char* mend);

/// The scene's objects. Throws Error if there are too many.
visibility_fields::RigidObjects objectsOf(const frame::Frame& frame,
                                          const visibility_fields::ObjectSetting& setting);

}  // namespace limen::techniques
