// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "renderer/frame/frame.h"
#include "renderer/gl/program.h"
#include "renderer/many_lods/gpu_tree.h"
#include "renderer/many_lods/value_tree.h"
#include "renderer/many_lods/view_atlas.h"

namespace limen::techniques {

/// What the points of a tree reflect of the scene's first light, and its means for all nodes: radiance, and
/// which side it leaves. The light is a point that sends light with the cosine of its direction, as virtual
/// lights have it. Source: Holländer 2013, section 3.6.1.
class LitPoints {
 public:
  LitPoints(frame::Frame& frame, const many_lods::GpuTree& tree);
  /// Opens the pass many_lods/lit_points.
  void make(frame::Frame& frame, const many_lods::GpuTree& tree, double gain) const;
  /// For shaders that include held_light.glsl.
  void bind(const many_lods::GpuTree& tree, const many_lods::ViewAtlas& atlas) const;

 private:
  const gl::Program& program_;
  many_lods::ValueTree values_;
};

}  // namespace limen::techniques
