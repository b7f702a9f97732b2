// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

#include "renderer/gl/buffer.h"
#include "renderer/gl/program.h"
#include "renderer/techniques/global_illumination/voxel_propagation/light_grid_settings.h"

namespace limen::techniques {

/// All steps of light in one dispatch, whose groups send the lights at their sides to those around them and
/// wait for theirs after each step (propagate_resident.comp.glsl). That takes a GPU that runs all groups at a
/// time, which OpenGL neither promises nor tells: each grid is tried before it is used, and waiting in vain
/// ends, is kept as a fact, and makes all light that arrives not a number.
class ResidentSteps {
 public:
  /// What the shader is compiled for.
  struct Form {
    FieldFormat field = FieldFormat::Half;
    glm::ivec3 tile{1};  ///< voxels of a group along each axis: the whole of a small grid
    /// Of lights in shared memory: two, one of which is read while the other is written, where there is room.
    int shells = 1;
    bool threads = false;  ///< groups are a software renderer's threads
    void define(gl::ShaderDefines& defines) const;
    glm::ivec3 groups(glm::ivec3 gridSize) const { return (gridSize + tile - 1) / tile; }
  };
  static Form formOf(FieldFormat field, glm::ivec3 gridSize, bool software);

  ResidentSteps(const gl::Program& program, const Form& form, glm::ivec3 gridSize);

  int64_t bytes() const { return stuck_.bytes() + lights_.bytes(); }
  /// From one field to another; all else is set and bound as for a step. Steps: at least 1, the same number
  /// in all frames.
  void run(int from, int to, int steps);
  /// Some steps of whatever the fields hold, to find out whether groups get stuck. Waits for the GPU.
  bool works();
  /// Whether groups have ever waited in vain. Waits for the GPU.
  bool stuck() const;
  /// For arrive.comp.glsl.
  const gl::Buffer& stuckBuffer() const { return stuck_; }

 private:
  void dispatch(int from, int to, int steps, uint32_t mostPolls);

  const gl::Program& program_;
  glm::ivec3 groups_;
  gl::Buffer stuck_, lights_;
  uint32_t pollsOfTrial_, pollsOfFrame_;
  /// Some steps before it wraps, so that it does so in every use soon after the trial.
  static constexpr uint32_t kFirstTag = (1U << 16U) - 100U;
  uint32_t firstTag_ = kFirstTag;
};

}  // namespace limen::techniques
