// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/many_lods/fixed_points.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <string>

#include "experiments/base/error.h"

namespace limen::many_lods {
namespace {

gl::Buffer fixedList(int64_t entries) {
  GLint64 most = 0;
  glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &most);
  if (8 * entries > most)
    throw Error("the points of the views take " + std::to_string(8 * entries) +
                    " bytes in one buffer; this device allows " + std::to_string(most),
                {}, "use fewer views or points");
  return {8 * entries, nullptr};
}

}  // namespace

FixedPoints::FixedPoints(gl::Context& context, uint32_t views, uint32_t perView, int depth, int tilePx,
                         uint32_t seed)
    : views_(views),
      radiusScale_(std::max(std::sqrt(static_cast<float>(1U << depth) / static_cast<float>(perView)), 1.0F)),
      list_(fixedList(int64_t{views} * perView)),
      control_(sizeof(CutControl), nullptr),
      fill_(context.programs().compute("renderer/many_lods/push_pull.comp.glsl",
                                       {{"SIDE", std::to_string(tilePx)}})) {
  assert(tilePx <= 64 && (tilePx & (tilePx - 1)) == 0);
  CutControl control{};
  control.count = views * perView;
  control.drawX = std::min((control.count + kSplatGroup - 1) / kSplatGroup, uint32_t{kMostCutGroups});
  control.drawY = control.drawZ = 1;
  control_.write(0, sizeof control, &control);
  const gl::Program& fixed = context.programs().compute("renderer/many_lods/fixed_points.comp.glsl");
  fixed.set("leaves", 1U << depth);
  fixed.set("perView", perView);
  fixed.set("count", control.count);
  fixed.set("seed", seed);
  list_.bindStorage(kCutListBuffer);
  fixed.use();
  glDispatchCompute(control.drawX, 1, 1);
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

void FixedPoints::fill(const ViewAtlas& atlas, int levels, float tolerance) const {
  if (levels == 0) return;
  atlas.depths().bindStorage(kSplatDepthsBuffer);
  fill_.set("levels", levels);
  fill_.set("tolerance", tolerance);
  fill_.use();
  glDispatchCompute(views_, 1, 1);
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

}  // namespace limen::many_lods
