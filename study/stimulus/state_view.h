// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <glm/glm.hpp>
#include <memory>

#include "renderer/frame/frame.h"
#include "renderer/frame/shaded.h"
#include "renderer/techniques/technique.h"
#include "study/stimulus/stimulus_scene.h"

namespace limen::study {

/// Levels of all objects before the change (`after` false) or after it. Other objects keep, over the whole
/// sequence, the levels that they have at `changeSceneTimeS`: a sequence has one change. Throws Error on an
/// object or a level that the scene does not have. `heightPx`: of the window.
scene::LodSelection levelsOf(const scene::Scene& scene, const LevelChange& change, bool after,
                             double changeSceneTimeS, int heightPx);

/// How a stimulus is shaded; missing settings take their defaults. Throws Error.
frame::ShadedSetting shadingOf(const Stimulus& stimulus);

/// One of the two states of a stimulus, before or after its change, at any scene time. Linear light,
/// `samples` times the window's size along each axis.
class StateView {
 public:
  /// Compiles and allocates; render() does neither. Throws Error: unknown technique, one whose product is not
  /// a picture or which needs something that the scene lacks, a picture larger than the driver's largest
  /// texture, or levels that do not exist.
  StateView(gl::Context& context, std::shared_ptr<const frame::SceneOnGpu> onGpu, const Stimulus& stimulus,
            bool after, glm::ivec2 sizePx, double changeSceneTimeS);
  ~StateView();

  struct Picture {
    const gl::Texture* lit = nullptr;  ///< RGBA32F
    /// For a technique that makes visibility: the picture is unlit + visibility * (lit - unlit), `lit` being
    /// without shadow; otherwise null.
    const gl::Texture *unlit = nullptr, *visibility = nullptr;
  };
  Picture render(double sceneTimeS);
  bool modulates() const { return modulates_; }

 private:
  std::shared_ptr<const frame::SceneOnGpu> scene_;
  frame::ShadedSetting shaded_;
  bool modulates_ = false;
  std::unique_ptr<frame::Frame> frame_;
  std::unique_ptr<techniques::Technique> technique_;
};

}  // namespace limen::study
