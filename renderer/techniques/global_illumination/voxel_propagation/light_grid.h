// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "renderer/frame/light_paths.h"
#include "renderer/gl/buffer.h"
#include "renderer/gl/program.h"
#include "renderer/gl/texture.h"
#include "renderer/techniques/global_illumination/voxel_propagation/light_grid_settings.h"
#include "renderer/voxels/voxelizer.h"

namespace limen::techniques {

/// Light in a grid of voxels (Gaitatzes 2012, chapter 5): what surfaces emit and reflect of the lamp, put in
/// as cosine lobes, spreads from voxel to voxel through empty ones and is reflected by occupied ones, at
/// whose faces what arrives is kept.
///
/// Unit of the fields: flux over the area of a voxel's face, in radiance times pi. Samples of the surfaces
/// bear their true areas, so that the injected energy does not depend on how many voxels a surface fills.
class LightGrid {
 public:
  LightGrid(frame::Frame& frame, const LightGridSettings& settings,
            const frame::SurfaceLightSettings& lighting);

  /// Light at the faces of occupied voxels, as the settings update it in this frame.
  void update(frame::Frame& frame);

  /// RGBA: flux at each face of occupied voxels, alpha 1 where the voxel beyond is empty. Layer: face * depth
  /// + z.
  const gl::Texture& arrived() const { return *arrived_; }
  const voxels::Volume& volume() const { return *volume_; }
  int64_t bytes() const;

  /// Steps apart, for counting and tests: voxels and sources of the frame, all made anew; one step of light
  /// that was put in once.
  void start(frame::Frame& frame);
  void propagate(bool lasting);
  /// Adds what the field sends to occupied voxels to what has arrived, or replaces it.
  void arrive(bool first);
  /// Array of three channels, flux and vector of each voxel: light on its way. Layer: channel * depth + z.
  const gl::Texture& field() const { return current(); }
  /// Flux that the field holds, per channel, in radiance times world units squared. Waits for the GPU.
  glm::dvec3 flux() const;
  /// Samples of surfaces whose light found no empty voxel. Waits for the GPU.
  uint32_t homeless() const;

 private:
  void compile(frame::Frame& frame);
  /// Where the voxels are in this frame; true if they have moved.
  bool place(const frame::Frame& frame);
  void configureBounds(const gl::Program& program) const;
  void voxelize(frame::Frame& frame);
  /// Of surfaces that face `axis`, if they are put in apart; negative: all.
  void inject(frame::Frame& frame, int axis);
  void restartSteps();
  const gl::Texture& current() const { return begun_ ? *field_ : *source_; }

  LightGridSettings settings_;
  frame::SurfaceLightSettings lighting_;
  scene::Bounds bounds_;
  std::optional<voxels::Volume> volume_;
  std::optional<voxels::Voxelizer> voxelizer_;
  const gl::Program *inject_ = nullptr, *seed_ = nullptr, *propagate_ = nullptr, *arrive_ = nullptr;
  std::optional<gl::Texture> samples_, sums_, source_, field_, next_, arrived_, shares_;
  std::vector<gl::Texture> sumsOfAxis_;
  gl::Buffer counts_, changes_;
  uint32_t sampleCount_ = 0;
  int64_t frames_ = 0;
  int step_ = 0;        ///< of this frame
  bool begun_ = false;  ///< false: the field is the source
};

}  // namespace limen::techniques
