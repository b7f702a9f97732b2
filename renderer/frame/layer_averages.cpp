// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/frame/layer_averages.h"

#include <epoxy/gl.h>

#include <bit>

#include "experiments/base/error.h"
#include "renderer/frame/frame_bindings.h"

namespace limen::frame {

LayerAverages::LayerAverages(gl::Context& context, const Form& form, const std::string& name,
                             const std::string& hint)
    : resolution_(form.resolution), layers_(form.layers) {
  if (form.prefilter == Prefilter::Sums) {
    sums_.emplace(context, form.resolution, form.layers, form.channels, form.sums);
    return;
  }
  try {
    mips_.emplace(form.texel, glm::ivec2(form.resolution),
                  static_cast<int>(std::bit_width(static_cast<unsigned>(form.resolution))), form.layers,
                  gl::Sampling::Linear);
  } catch (const Error& error) {
    throw Error(name + " does not fit: " + error.message(), {}, hint);
  }
  reduce_ =
      &context.programs().compute("renderer/frame/average_pyramid.comp.glsl", {{"TEXEL", form.texelLayout}});
}

void LayerAverages::bind(uint32_t unit) const {
  if (sums_)
    sums_->bind(unit);
  else
    mips_->bindTexture(unit);
}

void LayerAverages::build() const {
  if (sums_) {
    sums_->build();
    return;
  }
  for (int level = 1; level < mips_->levels(); ++level) {
    glMemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
    mips_->bindImage(kAverageBelowImage, gl::Access::Read, level - 1);
    mips_->bindImage(kAverageAboveImage, gl::Access::Write, level);
    const int side = resolution_ >> level;
    reduce_->set("side", side);
    reduce_->set("layers", layers_);
    reduce_->dispatch(glm::ivec2(side));
  }
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
}

}  // namespace limen::frame
