// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "perception/popping/predictor.h"
#include "perception/popping/weights.h"
#include "renderer/frame/lod_pair.h"
#include "renderer/techniques/lod/box_view.h"
#include "renderer/techniques/popping/switch_setting.h"

namespace limen::techniques {

/// What the predictor and its weight maps read, in memory.
struct SwitchImages {
  perception::PoppingInput input;                          ///< without weights
  std::vector<perception::DisocclusionView> disocclusion;  ///< empty if the setting uses none
  std::optional<perception::FlickerInput> flicker;
};

/// The views of a level change as shown to a viewer (SP-39). The frame is a window of the display, pixel for
/// pixel; its pictures are supersampled and clamped to the display's range. So are those that flicker is
/// found in, except for the clamping, which CIELAB brings: aliasing that is not shown is no flicker.
/// Displacement and depth are those of the pixel centres.
class SwitchViews {
 public:
  /// Throws Error like SwitchSetting::levels().
  SwitchViews(frame::Frame& parent, const SwitchSetting& setting);
  /// Between the parent's begin() and end().
  void render(frame::Frame& parent);

  const gl::Texture& actual() const { return *shown_[0]; }     ///< RGBA32F in [0, 1]
  const gl::Texture& predicted() const { return *shown_[1]; }  ///< the same
  const frame::LodPair& pair() const { return pair_; }
  /// What flicker is found in. Linear RGB; the last two are null without flicker.
  struct FlickerPictures {
    const gl::Texture *actual, *predicted, *previousShading, *previousFrame;
  };
  FlickerPictures flickerPictures() const { return {shown_[0], shown_[1], previousShading_, previousFrame_}; }
  /// The view whose shading over time is flicker.
  const frame::LodPair::View& flickering() const {
    return setting_.flickerOfBefore ? pair_.predicted() : pair_.actual();
  }
  /// Reads back the results of the last render().
  SwitchImages read() const;

 private:
  SwitchSetting setting_;
  frame::LodPair pair_;
  std::optional<BoxView> supersampled_[2];          // with more than one sample per pixel
  std::optional<BoxView> shadedBefore_, previous_;  // for flicker, with more than one sample per pixel
  const gl::Texture *previousShading_ = nullptr, *previousFrame_ = nullptr;
  const gl::Program* clamp_ = nullptr;  // null if no picture can leave the display's range
  std::vector<gl::Texture> clamped_;
  const gl::Texture* shown_[2] = {nullptr, nullptr};
};

}  // namespace limen::techniques
