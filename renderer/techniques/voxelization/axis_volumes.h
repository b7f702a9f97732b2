// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <string>
#include <vector>

#include "experiments/base/enum_names.h"
#include "renderer/techniques/technique.h"
#include "renderer/voxels/volume.h"
#include "renderer/voxels/voxel_lamps.h"

namespace limen::techniques {

/// What becomes of fragments that meet in a voxel.
enum class FragmentBlend {
  Maximum,  ///< of every channel, as with the one blend equation of OpenGL before 4.0; signed ones scaled to
            ///< 0 to 1. A maximum of normals or lobes is no mean, and of none of them
  Separate  ///< opacity and albedo: the largest; normals, light and lobes: their mean, from sums
};
constexpr EnumNames<FragmentBlend, 2> enumNames(FragmentBlend) {
  return {{{{FragmentBlend::Maximum, "maximum"}, {FragmentBlend::Separate, "separate"}}}};
}

/// Which axes are drawn anew in a frame.
enum class AxisRefresh { All, One };
constexpr EnumNames<AxisRefresh, 2> enumNames(AxisRefresh) {
  return {{{{AxisRefresh::All, "all"}, {AxisRefresh::One, "one"}}}};
}

/// Three volumes, one for each axis along which slices of triangles are drawn, and their union (Gaitatzes
/// 2012, section 6.2). By a geometry shader that sends triangles to layers: a triangle is in the volume of
/// the axis of its normal's largest component. By a pass for each slice: all are in all three.
class AxisVolumes {
 public:
  struct Form {
    std::vector<std::string> stages;  ///< compiled with AXIS = 0, 1 and 2
    gl::ShaderDefines defines;
    bool passPerSlice = false;  ///< with the uniform `slice`; otherwise all layers are the target
    FragmentBlend blend = FragmentBlend::Separate;
    AxisRefresh refresh = AxisRefresh::All;
    voxels::VoxelLamps lamps;
  };
  AxisVolumes(frame::Frame& frame, const voxels::Volume& volume, Form form);
  void fill(frame::Frame& frame, const voxels::Volume& volume);
  int64_t bytes() const;
  /// Draws of the scene in a frame, once all axes have been drawn.
  int64_t draws() const;

 private:
  struct Axis {
    const gl::Program* program;
    std::vector<gl::Texture>
        layers;  // x and y are the next two axes in cyclic order; R8, or one an attribute
    std::vector<gl::Framebuffer> targets;
    std::vector<gl::Texture> slices;  // views, of `layers` that are drawn slice by slice
  };
  void draw(frame::Frame& frame, const voxels::Volume& volume, const Axis& axis) const;
  void setBlending(const voxels::Volume& volume) const;
  void merge(const voxels::Volume& volume) const;
  void bindLayers(size_t attachment, uint32_t firstUnit) const;

  Form form_;
  std::vector<voxels::VoxelAttribute> attributes_;
  std::vector<Axis> axes_;
  const gl::Program& merge_;
  std::vector<const gl::Program*> mergeAttachment_;
  int frame_ = 0;
};

}  // namespace limen::techniques
