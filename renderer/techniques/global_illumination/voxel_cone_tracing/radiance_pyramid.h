// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "renderer/frame/light_paths.h"
#include "renderer/gl/buffer.h"
#include "renderer/gl/program.h"
#include "renderer/gl/volume_texture.h"
#include "renderer/techniques/global_illumination/moved_rays.h"
#include "renderer/voxels/voxelizer.h"

namespace limen::techniques {

struct ConeSettings {
  double start = 1.0, step = 0.5, width = 0.5;
  static const SettingsTable<ConeSettings>& table();
};
struct RadiancePyramidSettings {
  int resolution = 32, bounces = 3, samplesAside = 2;
  ConeSettings cones;
  static const SettingsTable<RadiancePyramidSettings>& table();
};

/// What voxels send through each of their six faces, and how opaque they are from there, at all scales:
/// levels of half the resolution each, in which the voxel in front covers that behind (Crassin et al. 2011).
class RadiancePyramid {
 public:
  RadiancePyramid(frame::Frame& frame, const RadiancePyramidSettings& settings,
                  const frame::SurfaceLightSettings& lighting);

  /// Voxels and light of the frame: of the lamp and the surfaces, then a gathering by cones at each face of
  /// each occupied voxel for every bounce but the last, which pixels gather.
  void make(frame::Frame& frame);
  /// For programs that include radiance.glsl.
  gl::ShaderDefines defines() const { return volume_->defines(); }
  void configure(const gl::Program& program) const;
  const voxels::Volume& volume() const { return *volume_; }
  /// That the frame's rays are traced through; null: the one that the scene keeps.
  const ray_tracing::RayTree* tree() const { return rays_.tree(); }
  int64_t bytes() const;
  uint32_t samples() const { return sampleCount_; }

 private:
  void makeLevels() const;

  RadiancePyramidSettings settings_;
  frame::SurfaceLightSettings lighting_;
  MovedRays rays_;
  std::optional<voxels::Volume> volume_;
  std::optional<voxels::Voxelizer> voxelizer_;
  const gl::Program *inject_ = nullptr, *base_ = nullptr, *bounce_ = nullptr, *level_ = nullptr;
  std::optional<gl::Texture> samples_;
  std::optional<gl::Buffer> sums_;
  /// Two sets of six: a bounce reads one and writes the other.
  std::vector<gl::VolumeTexture> faces_;
  size_t now_ = 0;
  uint32_t sampleCount_ = 0;
};

}  // namespace limen::techniques
