// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "renderer/frame/light_paths.h"
#include "renderer/gl/buffer.h"
#include "renderer/gl/program.h"
#include "renderer/gl/texture.h"
#include "renderer/gl/volume_texture.h"
#include "renderer/techniques/global_illumination/moved_rays.h"
#include "renderer/techniques/global_illumination/voxel_propagation/light_grid_settings.h"
#include "renderer/techniques/global_illumination/voxel_propagation/light_programs.h"
#include "renderer/techniques/global_illumination/voxel_propagation/resident_steps.h"
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

  /// RGBA: flux at each face of occupied voxels, alpha 1 where the voxel beyond is empty; 0 elsewhere. Layer:
  /// face * depth + z.
  const gl::Texture& arrived() const { return *arrived_; }
  const voxels::Volume& volume() const { return *volume_; }
  /// Words of light_cells.glsl.
  const gl::Texture& lightCells() const { return *lightCells_; }
  /// That the frame's rays are traced through; null: the one that the scene keeps.
  const ray_tracing::RayTree* tree() const { return rays_.tree(); }

  /// Steps apart, for counting and tests: voxels and sources of the frame, all made anew; one step of light
  /// that was put in once.
  void start(frame::Frame& frame);
  void propagate();
  /// How steps are given to the GPU: whether all are one dispatch, and why.
  bool stepsAtOnce() const { return resident_.has_value(); }
  const std::string& stepsRemark() const { return stepsRemark_; }
  /// Adds what the field sends to occupied voxels to what has arrived, or replaces it.
  void arrive(bool first);
  /// One layer of the field, flux and vector of each voxel: light on its way. Waits for the GPU.
  Image fieldLayer(int channel, int z) const;
  /// Flux that the field holds, per channel, in radiance times world units squared. Waits for the GPU.
  glm::dvec3 flux() const;
  /// Throws Error if steps in one dispatch have ever waited for each other in vain. Waits for the GPU.
  void checkSteps() const;
  /// Samples of surfaces whose light found no empty voxel. Waits for the GPU.
  uint32_t homeless() const;

 private:
  /// Where the voxels are in this frame; true if they have moved.
  bool place(const frame::Frame& frame);
  void configureBounds(const gl::Program& program) const;
  void voxelize(frame::Frame& frame);
  /// Of surfaces that face `axis`, if they are put in apart; negative: all. `restart`: the field becomes what
  /// is put in.
  void inject(frame::Frame& frame, int axis, bool restart);
  void restartSteps(bool lasting, const gl::Texture& source);
  int reading() const { return 2 * pair_ + from_; }
  int writing() const { return 2 * pair_ + 1 - from_; }
  /// All steps of the field in use, and what arrives by them. `first`: it replaces what has arrived.
  void spread(bool first, bool reflects);
  /// Makes the source of the next bounce, or adds to it, from what the field in use reflects.
  void reflect(bool adds, bool first, bool seeds, int to);
  /// Settles whether steps are one dispatch.
  void tryStepsAtOnce(frame::Frame& frame);

  LightGridSettings settings_;
  frame::SurfaceLightSettings lighting_;
  scene::Bounds bounds_;
  MovedRays rays_;
  std::optional<voxels::Volume> volume_;
  std::optional<voxels::Voxelizer> voxelizer_;
  std::optional<LightPrograms> programs_;
  const gl::Program* residentProgram_ = nullptr;
  std::optional<gl::Texture> samples_, sums_, source_, reflected_, arrived_, lightCells_;
  /// Pairs, of which a step reads one field and writes the other. All are one texture, so that nothing is
  /// bound between steps: drivers take longer for that than small grids do for a step.
  std::optional<gl::Texture> fields_;
  std::optional<gl::VolumeTexture> shares_;
  std::vector<gl::Texture> sumsOfAxis_;
  std::optional<ResidentSteps> resident_;
  std::string stepsRemark_;
  gl::Buffer counts_, layerSums_, changes_;
  uint32_t sampleCount_ = 0;
  int64_t frames_ = 0;
  int step_ = 0;  ///< of this frame
  int pairs_ = 1;
  int pair_ = 0;  ///< of fields, that is in use
  int from_ = 0;  ///< of the pair, the field that holds the light
};

}  // namespace limen::techniques
