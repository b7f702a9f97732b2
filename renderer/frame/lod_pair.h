// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "renderer/frame/frame.h"
#include "renderer/frame/shaded.h"
#include "renderer/gl/texture.h"

namespace limen::frame {

struct LodPairSetting {
  double dtS = 1.0 / 60.0;  ///< time since the previous frame
  ShadedSetting shaded{};
  /// Also renders what flicker detection needs: the previous frame's picture.
  bool previousColour = true;
  /// False: a change shown at rest, which has no previous frame; of the views only `colour` is made,
  /// everything else is null.
  bool moving = true;
};

/// What a popping predictor needs of a change of levels (SP-39; Schwarz 2009, sections 10.3.1 and 10.3.5):
/// the frame as it is with the new levels (actual), as it would be had the levels not changed (predicted),
/// where each of their points lay in the previous frame, and what both levels hid there. All views have the
/// size and time of the frame that the pair belongs to.
///
/// Use: once per frame `pair.setLevels(new, old)` as needed, then `pair.render()` between the parent's
/// begin() and end(). Textures are valid until the next render().
class LodPair {
 public:
  LodPair(Frame& parent, LodPairSetting setting);
  ~LodPair();
  LodPair(const LodPair&) = delete;
  LodPair& operator=(const LodPair&) = delete;

  /// Levels of this frame and of the frame before it.
  void setLevels(const scene::LodSelection& actual, const scene::LodSelection& predicted);
  void render();

  struct View {
    const gl::Texture* colour = nullptr;  ///< RGBA32F, see Shaded
    /// RGBA32F: the points of this frame shaded as in the previous frame's setup; differs from `colour` by
    /// its highlights; equals `colour` if there are none.
    const gl::Texture* shadedBefore = nullptr;
    const gl::Texture* displacement = nullptr;  ///< RG32F px, see Motion
    const gl::Texture* previousDepth =
        nullptr;                         ///< R32F, of each pixel's point in the previous view, see Motion
    const gl::Texture* depth = nullptr;  ///< R32F, linear, this frame
    /// R32F, linear: what these levels showed at the previous camera. The previous position of a pixel's
    /// point was visible if its previousDepth is no larger than this at that position, plus a bias.
    const gl::Texture* depthBefore = nullptr;
  };
  const View& actual() const { return actual_; }        ///< new levels
  const View& predicted() const { return predicted_; }  ///< old levels
  /// RGBA32F: the previous frame as it was shown, with the old levels; null if not requested.
  const gl::Texture* previousColour() const { return previousColour_; }

 private:
  LodPairSetting setting_;
  Frame& parent_;
  std::unique_ptr<Frame> frames_[4];  // actual and predicted now, then the same before
  View actual_, predicted_;
  const gl::Texture* previousColour_ = nullptr;
};

/// The selections of a frame in which the object numbered `object` changes from `oldLevel` to `newLevel`
/// while all others stay at `others`: {actual, predicted}.
std::pair<scene::LodSelection, scene::LodSelection> objectChange(const scene::LodSelection& others,
                                                                 size_t object, int oldLevel, int newLevel);

}  // namespace limen::frame
