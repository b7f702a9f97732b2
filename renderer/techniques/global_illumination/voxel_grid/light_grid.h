// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "renderer/frame/light_paths.h"
#include "renderer/gl/program.h"
#include "renderer/gl/texture.h"
#include "renderer/voxels/voxelizer.h"

namespace limen::techniques {

/// Form of a neighbour's harmonics: the cone of the direction to it.
enum class LightCone {
  Right,  ///< of 90 degrees, which the thesis names; six of them leave 12 % of the sphere out
  Sixth   ///< of a sixth of the sphere
};
constexpr EnumNames<LightCone, 2> enumNames(LightCone) {
  return {{{{LightCone::Right, "right_angle"}, {LightCone::Sixth, "sixth"}}}};
}
enum class FluxShares {
  Printed,    ///< each cone's own flux; negative ones are cut off, so that energy grows and shrinks
  Conserving  ///< scaled so that what leaves a voxel is what it holds
};
constexpr EnumNames<FluxShares, 2> enumNames(FluxShares) {
  return {{{{FluxShares::Printed, "printed"}, {FluxShares::Conserving, "conserving"}}}};
}
enum class SolidExchange {
  All,  ///< occupied voxels side by side light each other
  Open  ///< they send light to empty ones alone, if they have any beside them
};
constexpr EnumNames<SolidExchange, 2> enumNames(SolidExchange) {
  return {{{{SolidExchange::All, "all"}, {SolidExchange::Open, "open"}}}};
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

struct LightGridSettings {
  int resolution = 32, iterations = 64;
  LightCone cone = LightCone::Sixth;
  FluxShares shares = FluxShares::Conserving;
  SolidExchange exchange = SolidExchange::Open;
  GridReflection reflection = GridReflection::Diffuse;
  GridAlbedo albedo = GridAlbedo::Stored;
  FieldFormat format = FieldFormat::Half;
  voxels::Coverage coverage = voxels::Coverage::Conservative;
  double shift = 0.5;
  int samplesAside = 4;
  static const SettingsTable<LightGridSettings>& table();
};

/// Light in a grid of voxels (Gaitatzes 2012, chapter 5): what surfaces emit and reflect of the lamp, put in
/// as cosine lobes, spreads from voxel to voxel through empty ones and is reflected by occupied ones, where
/// what arrives is gathered.
///
/// Unit of the fields: harmonics of the intensity over the area of a voxel's face. Samples of the surfaces
/// bear their true areas, so that the injected energy does not depend on how many voxels a surface fills.
class LightGrid {
 public:
  LightGrid(frame::Frame& frame, const LightGridSettings& settings,
            const frame::SurfaceLightSettings& lighting);

  /// Voxels and injected light of the frame.
  void start(frame::Frame& frame);
  /// One step.
  void propagate();
  /// Array of three channels, harmonics (constant, y, z, x): what has arrived at occupied voxels, and what is
  /// on its way after the last step. Layer: channel * depth + z.
  const gl::Texture& gathered() const { return *gathered_; }
  const gl::Texture& field() const { return *field_; }
  const voxels::Volume& volume() const { return *volume_; }
  int64_t bytes() const;
  /// Flux that the field holds, per channel, in radiance times world units squared. Waits for the GPU.
  glm::dvec3 flux() const;

 private:
  void inject(frame::Frame& frame);

  LightGridSettings settings_;
  frame::SurfaceLightSettings lighting_;
  std::optional<voxels::Volume> volume_;
  std::optional<voxels::Voxelizer> voxelizer_;
  const gl::Program *inject_ = nullptr, *seed_ = nullptr, *propagate_ = nullptr;
  std::optional<gl::Texture> samples_, sums_, field_, next_, gathered_;
  uint32_t sampleCount_ = 0;
};

}  // namespace limen::techniques
