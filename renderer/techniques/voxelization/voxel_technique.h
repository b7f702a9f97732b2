// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "experiments/base/enum_names.h"
#include "renderer/techniques/technique.h"
#include "renderer/voxels/volume.h"

namespace limen::techniques {

/// What the grid's tight box holds.
enum class GridBox { Scene, Casters };
constexpr EnumNames<GridBox, 2> enumNames(GridBox) {
  return {{{{GridBox::Scene, "scene"}, {GridBox::Casters, "casters"}}}};
}

struct VoxelGridSettings {
  int resolution = 64;
  GridBox box = GridBox::Scene;
  static const SettingsTable<VoxelGridSettings>& table();
};

/// Base of techniques that fill voxels. The product is a picture of them: along each pixel's ray the first
/// that is occupied, shaded by the side on which the ray enters it, or by its albedo and mean normal if the
/// volume has them. Sets are compared outside the timed frames with those of voxels/exact_voxels.h, of the
/// mesh as it stands at the frame's time.
class VoxelTechnique : public Technique {
 public:
  VoxelTechnique(const VoxelGridSettings& grid, const char* pass) : gridSettings_(grid), pass_(pass) {}
  void prepare(frame::Frame& frame) final;
  void render(frame::Frame& frame) final;
  const gl::Texture& product() const final { return *picture_; }
  std::vector<Counter> count(frame::Frame& frame) final;
  static std::vector<Quantity> quantities();

 protected:
  /// For volumes of a grid.
  virtual voxels::VolumeAttributes attributes(frame::Frame&, const voxels::VoxelGrid&) const { return {}; }
  /// Compiles and allocates; returns the bytes that it holds besides the volume.
  virtual int64_t prepareForm(frame::Frame& frame, const voxels::Volume& volume) = 0;
  /// What fill() needs and passes of their own make.
  virtual void beforeFill(frame::Frame&) {}
  /// Fills the volume, which holds whatever it held.
  virtual void fill(frame::Frame& frame, const voxels::Volume& volume) = 0;
  /// Besides quantities().
  virtual std::vector<Counter> countForm(const voxels::Volume&) const { return {}; }

 private:
  VoxelGridSettings gridSettings_;
  const char* pass_;
  std::optional<voxels::Volume> volume_;
  std::optional<gl::Texture> picture_;
  const gl::Program* show_ = nullptr;
};

}  // namespace limen::techniques
