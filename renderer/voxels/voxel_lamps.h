// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "renderer/frame/frame.h"
#include "renderer/gl/program.h"
#include "renderer/ray_tracing/ray_tree.h"
#include "renderer/voxels/volume_attributes.h"

namespace limen::voxels {

/// The lamps' light of volumes that hold light. As everywhere in the bench lamps are points in the middle of
/// the scene's lights, as bright at any distance (frame/light_paths.h). A surface is lit on the side that
/// faces the lamp.
struct VoxelLamps {
  double strength = 0.8;  ///< radiance of a white surface that faces a lamp
  bool all = false;       ///< all of the scene's lights, kVoxelLamps at most; otherwise the first alone
  bool shadows = true;    ///< by rays, through transparent surfaces straight on
};

/// Whether filling a volume traces rays, for which the scene's tree, or another, is needed.
bool castsShadows(const frame::Frame& frame, const VolumeAttributes& attributes, const VoxelLamps& lamps);

/// For programs that include voxel_surface.glsl and are compiled with Volume::defines() and sumDefines():
/// further defines; and uniforms, and storage but for that of the scene's surfaces. `tree`: null: the
/// scene's.
gl::ShaderDefines surfaceDefines(const frame::Frame& frame, const VolumeAttributes& attributes,
                                 const VoxelLamps& lamps);
void configureSurfaces(const gl::Program& program, frame::Frame& frame, const VolumeAttributes& attributes,
                       const VoxelLamps& lamps, const ray_tracing::RayTree* tree = nullptr);

}  // namespace limen::voxels
