// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/many_lods/polygon_tiles.h"

#include <epoxy/gl.h>

#include <algorithm>

#include "renderer/techniques/many_lods/many_lods_pass_bindings.h"

namespace limen::techniques {
namespace {

constexpr uint32_t kMostPolygonGroups = 65535;

}  // namespace

PolygonTiles::PolygonTiles(frame::Frame& frame)
    : program_(frame.context().programs().compute("renderer/techniques/many_lods/polygon_tiles.comp.glsl")),
      triangles_(static_cast<uint32_t>(frame.scene().mesh.triangles.size())) {}

void PolygonTiles::draw(frame::Frame& frame, const gl::Buffer& views, uint32_t viewCount,
                        const many_lods::ViewAtlas& atlas) const {
  atlas.clear();
  frame.geometry().bindStorage();
  views.bindStorage(kPolygonViewsBuffer);
  atlas.depths().bindStorage(kPolygonDepthsBuffer);
  program_.set("tilePx", atlas.tilePx());
  program_.set("triangleCount", triangles_);
  program_.set("viewCount", viewCount);
  program_.use();
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
  glDispatchCompute(std::clamp((triangles_ + kPolygonGroup - 1) / kPolygonGroup, 1U, kMostPolygonGroups),
                    std::min(viewCount, kMostPolygonGroups), 1);
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

}  // namespace limen::techniques
