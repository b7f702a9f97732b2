// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "renderer/frame/frame.h"
#include "renderer/frame/light_paths.h"
#include "renderer/gl/program.h"
#include "renderer/techniques/global_illumination/voxel_propagation/light_grid_settings.h"
#include "renderer/techniques/global_illumination/voxel_propagation/resident_steps.h"
#include "renderer/voxels/volume.h"

namespace limen::techniques {

/// Programs of a grid of light, compiled as its settings ask.
class LightPrograms {
 public:
  LightPrograms(frame::Frame& frame, const LightGridSettings& settings,
                const frame::SurfaceLightSettings& lighting, const voxels::Volume& volume);

  const gl::Program *inject = nullptr, *cells = nullptr, *seed = nullptr, *propagate = nullptr,
                    *reflect = nullptr, *arrive = nullptr, *flux = nullptr;
  /// All steps in one dispatch.
  const gl::Program& residentSteps(frame::Frame& frame, const ResidentSteps::Form& form) const;
  /// In place of `arrive`: light is not a number once groups of the above have got stuck.
  const gl::Program& arriveAfterResident(frame::Frame& frame) const;
  /// How light leaves a voxel, of a program that steps, reflects or arrives. Grids of other cones may share
  /// it.
  void setTransport(const gl::Program& program) const;

 private:
  const gl::Program& step(frame::Frame& frame, const char* shader, const gl::ShaderDefines& defines) const;

  LightTransport transport_;
  gl::ShaderDefines stepDefines_, arriveDefines_;
};

}  // namespace limen::techniques
