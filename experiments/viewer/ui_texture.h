// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>

#include "experiments/viewer/presenter.h"

namespace limen::viewer {

/// A picture as a texture of the interface's context.
class UiTexture {
 public:
  UiTexture() = default;
  ~UiTexture();
  UiTexture(const UiTexture&) = delete;
  UiTexture& operator=(const UiTexture&) = delete;

  /// Uploads it unless it is already there. Null: nothing is shown.
  void show(const std::shared_ptr<const ScreenPicture>& picture);
  bool empty() const { return !shown_; }
  uint32_t id() const { return id_; }
  glm::ivec2 sizePx() const { return sizePx_; }

 private:
  std::shared_ptr<const ScreenPicture> shown_;
  glm::ivec2 sizePx_{0};
  uint32_t id_ = 0;
};

}  // namespace limen::viewer
