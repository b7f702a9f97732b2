// SPDX-License-Identifier: BSD-3-Clause
#include "study/stimulus/prepared_stimulus.h"

#include <epoxy/gl.h>
#include <fmt/format.h>

#include <algorithm>

namespace limen::study {
namespace {

constexpr int64_t kUnknownBudget = int64_t{1} << 30;

/// Free video memory in KiB, if the driver reports it.
std::optional<int64_t> freeKib() {
  GLint kib[4] = {0, 0, 0, 0};
  if (epoxy_has_gl_extension("GL_NVX_gpu_memory_info"))
    glGetIntegerv(GL_GPU_MEMORY_INFO_CURRENT_AVAILABLE_VIDMEM_NVX, kib);
  else if (epoxy_has_gl_extension("GL_ATI_meminfo"))
    glGetIntegerv(GL_TEXTURE_FREE_MEMORY_ATI, kib);
  if (kib[0] <= 0) return std::nullopt;
  return kib[0];
}

void copy(const gl::Texture& from, const gl::Texture& to, int layer) {
  glCopyImageSubData(from.id(), GL_TEXTURE_2D, 0, 0, 0, 0, to.id(), GL_TEXTURE_2D_ARRAY, 0, 0, 0, layer,
                     from.sizePx().x, from.sizePx().y, 1);
}

}  // namespace

int64_t pictureBudgetBytes() {
  const std::optional<int64_t> kib = freeKib();
  return kib ? *kib * 1024 / 2 : kUnknownBudget;
}

PreparedStimulus::PreparedStimulus(std::unique_ptr<StimulusRenderer> renderer, int64_t budgetBytes,
                                   const std::function<void(int done, int all)>& progress)
    : timeline_(renderer->timeline()), sizePx_(renderer->sizePx()) {
  GLint mostLayers = 0;
  glGetIntegerv(GL_MAX_ARRAY_TEXTURE_LAYERS, &mostLayers);
  const int pictures = renderer->pictureCount();
  const int64_t needed = int64_t{4} * sizePx_.x * sizePx_.y * pictures;
  if (needed > budgetBytes || pictures > mostLayers) {
    warning_ = fmt::format(
        "{} pictures of {} x {} px take {} MiB, and {} MiB or {} pictures fit: they are rendered during "
        "presentation and may be late",
        pictures, sizePx_.x, sizePx_.y, needed >> 20, budgetBytes >> 20, mostLayers);
    layers_.emplace(gl::Format::RGBA8, sizePx_, 1, 1);
    layerOfFrame_.assign(static_cast<size_t>(timeline_.frames), 0);
    live_ = std::move(renderer);
    picture(0);
    glFinish();
    return;
  }
  layers_.emplace(gl::Format::RGBA8, sizePx_, 1, pictures);
  for (int frame = 0; frame < timeline_.frames; ++frame) layerOfFrame_.push_back(renderer->pictureOf(frame));
  for (int i = 0; i < pictures; ++i) {
    copy(renderer->render(renderer->firstFrameOf(i)), *layers_, i);
    if (progress) progress(i + 1, pictures);
  }
  glFinish();
}

int PreparedStimulus::picture(int frame) {
  const int layer = layerOfFrame_[static_cast<size_t>(frame)];
  if (live_ && live_->pictureOf(frame) != shown_) {
    shown_ = live_->pictureOf(frame);
    copy(live_->render(frame), *layers_, layer);
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
  }
  return layer;
}

}  // namespace limen::study
