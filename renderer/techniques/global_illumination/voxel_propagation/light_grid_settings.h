// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <variant>

#include "experiments/base/settings_table.h"
#include "renderer/voxels/voxelizer.h"

namespace limen::techniques {

/// Ways in which light goes from a voxel to its neighbours.
struct MomentTransport {
  static constexpr const char
      *kKind = "moments",
      *kSummary =
          "each direction of the lobe that has a voxel's flux and mean direction goes "
          "on as it was";
};
struct FaceTransport {
  static constexpr const char *kKind = "faces",
                              *kSummary =
                                  "flux through the five far faces of each neighbour, lobes along the axes, "
                                  "scaled to what the voxel holds (Kaplanyan and Dachsbacher 2010)";
};
struct ConeTransport {
  static constexpr const char *kKind = "cones",
                              *kSummary = "flux within a cone to each neighbour, as printed (R1)";
  double halfAngleDeg = 45.0;
  bool normalised = true;
  static const SettingsTable<ConeTransport>& table();
};
struct ComponentTransport {
  static constexpr const char *kKind = "components",
                              *kSummary = "harmonics times those of the cone, one by one (R2)";
  double halfAngleDeg = 45.0;
  static const SettingsTable<ComponentTransport>& table();
};
using LightTransport = std::variant<MomentTransport, FaceTransport, ConeTransport, ComponentTransport>;

enum class LightSources {
  Steady,  ///< put in at each step: the field tends to the light of a lasting source
  Once     ///< put in before the first step; what arrives is summed up over the steps
};
constexpr EnumNames<LightSources, 2> enumNames(LightSources) {
  return {{{{LightSources::Steady, "steady"}, {LightSources::Once, "once"}}}};
}
enum class GridReflection {
  Axis,    ///< mirrored at the face between the voxels (GI-07)
  Normal,  ///< mirrored at the mean normal (GI-08)
  Diffuse  ///< a cosine lobe about the mean normal
};
constexpr EnumNames<GridReflection, 3> enumNames(GridReflection) {
  return {{{{GridReflection::Axis, "axis"},
            {GridReflection::Normal, "normal"},
            {GridReflection::Diffuse, "diffuse"}}}};
}
enum class GridAlbedo { Stored, Half };
constexpr EnumNames<GridAlbedo, 2> enumNames(GridAlbedo) {
  return {{{{GridAlbedo::Stored, "stored"}, {GridAlbedo::Half, "half"}}}};
}
enum class FieldFormat { Half, Single };
constexpr EnumNames<FieldFormat, 2> enumNames(FieldFormat) {
  return {{{{FieldFormat::Half, "16f"}, {FieldFormat::Single, "32f"}}}};
}

struct InjectionSettings {
  double shift = 0.5;
  int samplesAside = 4;
  static const SettingsTable<InjectionSettings>& table();
};

/// Where voxels are.
struct BoxOfScene {
  static constexpr const char *kKind = "scene", *kSummary = "around the scene";
  int margin = 1;
  static const SettingsTable<BoxOfScene>& table();
};
struct BoxAroundCamera {
  static constexpr const char *kKind = "camera",
                              *kSummary = "a cube around the camera, moved by whole voxels (GI-13)";
  double side = 8.0;
  static const SettingsTable<BoxAroundCamera>& table();
};
using GridBox = std::variant<BoxOfScene, BoxAroundCamera>;

/// What of the light is made anew in a frame.
struct UpdateAll {
  static constexpr const char *kKind = "all", *kSummary = "everything, from nothing";
};
struct UpdateEvery {
  static constexpr const char *kKind = "every", *kSummary = "everything, in one of several frames";
  int frames = 3;
  static const SettingsTable<UpdateEvery>& table();
};
struct UpdateAxes {
  static constexpr const char *kKind = "axis",
                              *kSummary = "light of the surfaces that face one axis; the field goes on";
};
struct UpdateOn {
  static constexpr const char *kKind = "continued", *kSummary = "light of all surfaces; the field goes on";
};
using GridUpdate = std::variant<UpdateAll, UpdateEvery, UpdateAxes, UpdateOn>;

/// How steps are given to the GPU, with the same result.
struct FittingDispatch {
  static constexpr const char *kKind = "fitting", *kSummary = "all in one where that works, else one each";
};
struct OneDispatch {
  static constexpr const char *kKind = "once", *kSummary = "all in one, whose groups wait for each other";
};
struct DispatchEach {
  static constexpr const char *kKind = "each", *kSummary = "one each";
};
using StepDispatch = std::variant<FittingDispatch, OneDispatch, DispatchEach>;

/// How often light is reflected.
struct AllBounces {
  static constexpr const char *kKind = "all", *kSummary = "as often as steps allow, all in one field";
};
struct LimitedBounces {
  static constexpr const char
      *kKind = "limited",
      *kSummary =
          "light of each bounce in a field of its own, one after another, at the cost of as many "
          "propagations; surfaces absorb the last";
  int most = 2;
  static const SettingsTable<LimitedBounces>& table();
};
using GridBounces = std::variant<AllBounces, LimitedBounces>;

struct StepSettings {
  LightSources sources = LightSources::Steady;
  StepDispatch dispatch;
  GridBounces bounces;
  double stopBelow = 0.0;
  static const SettingsTable<StepSettings>& table();
  void check() const;
};

struct LightGridSettings {
  int resolution = 16, iterations = 64;
  StepSettings steps;
  LightTransport transport;
  GridReflection reflection = GridReflection::Diffuse;
  GridAlbedo albedo = GridAlbedo::Stored;
  FieldFormat format = FieldFormat::Half;
  voxels::Coverage coverage = voxels::Coverage::Thin;
  GridBox box;
  GridUpdate update;
  InjectionSettings injection;
  static const SettingsTable<LightGridSettings>& table();
  void check() const;
  /// Whether the field goes on from frame to frame.
  bool goesOn() const {
    return std::holds_alternative<UpdateOn>(update) || std::holds_alternative<UpdateAxes>(update);
  }
  /// Fields that light goes through one after another.
  int generations() const {
    const auto* limited = std::get_if<LimitedBounces>(&steps.bounces);
    return limited ? limited->most : 1;
  }
  /// Whether what arrives is added up.
  bool sumsArrivals() const { return steps.sources == LightSources::Once || generations() > 1; }
};

}  // namespace limen::techniques
