// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/viewer/ui_texture.h"

#include <epoxy/gl.h>

namespace limen::viewer {

UiTexture::~UiTexture() {
  if (id_ != 0) glDeleteTextures(1, &id_);
}

void UiTexture::show(const std::shared_ptr<const ScreenPicture>& picture) {
  if (picture == shown_) return;
  shown_ = picture;
  if (!picture) return;
  if (picture->sizePx != sizePx_) {
    if (id_ != 0) glDeleteTextures(1, &id_);
    sizePx_ = picture->sizePx;
    glCreateTextures(GL_TEXTURE_2D, 1, &id_);
    glTextureStorage2D(id_, 1, GL_RGBA8, sizePx_.x, sizePx_.y);
    // No filtering when enlarged: the pixel values are what matters.
    glTextureParameteri(id_, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTextureParameteri(id_, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glTextureParameteri(id_, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTextureParameteri(id_, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  }
  glTextureSubImage2D(id_, 0, 0, 0, sizePx_.x, sizePx_.y, GL_RGBA, GL_UNSIGNED_BYTE, picture->rgba.data());
}

}  // namespace limen::viewer
