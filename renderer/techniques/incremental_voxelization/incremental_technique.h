// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "renderer/incremental_voxels/depth_view.h"
#include "renderer/incremental_voxels/injection.h"
#include "renderer/incremental_voxels/sampled_volume.h"
#include "renderer/techniques/incremental_voxelization/incremental_settings.h"
#include "renderer/techniques/technique.h"

namespace limen::techniques {

/// Base of techniques that voxelize what depth images show, frame after frame. Each rendered frame is one
/// step; prepare() renders those of the sequence. The product is a picture of the voxels, as techniques of
/// voxelization/ make it. Voxels are compared with sets of the mesh as it stands at the frame's time.
class IncrementalTechnique : public Technique {
 public:
  struct Attributes {
    bool volume;  ///< of the volume
    bool lit;     ///< samples are lit, which takes the light's depth image
  };
  IncrementalTechnique(const IncrementalSettings& settings, Attributes attributes)
      : settings_(settings), attributes_(attributes) {}
  void prepare(frame::Frame& frame) final;
  void render(frame::Frame& frame) final;
  const gl::Texture& product() const final { return *picture_; }
  std::vector<Counter> count(frame::Frame& frame) final;
  static std::vector<Quantity> quantities();
  /// Valid after prepare().
  const incremental_voxels::SampledVolume& volume() const { return *volume_; }

  static constexpr const char* kFamily = "incremental_voxelization/";

 protected:
  /// What a step is given.
  struct Step {
    frame::Frame& frame;
    const incremental_voxels::SampledVolume& volume;
    const std::vector<incremental_voxels::DepthView>& views;
    const incremental_voxels::SampleLighting& lighting;
    int number;
  };
  /// Of the views that tell of voxels; valid in prepareForm().
  std::vector<glm::ivec2> viewSizesPx(const frame::Frame& frame, int used) const {
    std::vector<glm::ivec2> out = {frame.sizePx()};
    if (used == 2) out.emplace_back(settings_.lightMap.resolution);
    return out;
  }
  /// Samples that a step takes of each view at most.
  virtual int64_t samplesPerView() const = 0;
  /// Compiles and allocates; `views` are bound, `used` of them tell of voxels. Returns the bytes that it
  /// holds besides the volume.
  virtual int64_t prepareForm(frame::Frame& frame, const incremental_voxels::SampledVolume& volume, int views,
                              int used) = 0;
  /// Brings the volume from the last frame to this one. Opens passes.
  virtual void update(const Step& step) = 0;
  /// Renders the product of a step; by default a picture of the voxels.
  virtual void show(const Step& step, const gl::Texture& picture);
  /// The grid moved by so many voxels; by all of an axis if nothing stayed.
  virtual void moved(const voxels::VoxelGrid&, glm::ivec3) {}
  /// Whether the volume counts what a step does.
  virtual bool countsSteps() const { return true; }

 private:
  Step step(frame::Frame& frame);
  std::vector<uint8_t> oncePresent(const frame::Frame& frame) const;

  IncrementalSettings settings_;
  Attributes attributes_;
  std::optional<incremental_voxels::SampledVolume> volume_;
  std::optional<incremental_voxels::LightMap> lightMap_;
  std::optional<gl::Texture> picture_;
  const gl::Program* show_ = nullptr;
  std::vector<incremental_voxels::DepthView> views_;
  incremental_voxels::SampleLighting lighting_;
  int number_ = 0, restarts_ = 0, scrolls_ = 0;
};

}  // namespace limen::techniques
