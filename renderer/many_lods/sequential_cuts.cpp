// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/many_lods/sequential_cuts.h"

#include <epoxy/gl.h>

#include "renderer/many_lods/in_place_cuts.h"

namespace limen::many_lods {

const SettingsTable<SequentialSettings>& SequentialSettings::table() {
  static const SettingsTable<SequentialSettings> kTable = {};
  return kTable;
}

SequentialCuts::SequentialCuts(gl::Context& context, uint32_t views, int depth, Discs discs)
    : views_(views),
      leaves_(1U << depth),
      counts_(int64_t{sizeof(InPlaceCounts)}, nullptr),
      program_(context.programs().compute("renderer/many_lods/sequential.comp.glsl", discDefines(discs))) {}

void SequentialCuts::draw(const gl::Buffer& nodes, const gl::Buffer& views, const ViewAtlas& atlas,
                          const ViewAtlas::Settings& settings) const {
  program_.set("leaves", leaves_);
  program_.set("viewCount", views_);
  beginInPlace(program_, nodes, views, atlas, settings, counts_);
  glDispatchCompute((views_ + kSequentialGroup - 1) / kSequentialGroup, 1, 1);
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

InPlaceCounts SequentialCuts::counts() const { return counts_.read<InPlaceCounts>(0, 1)[0]; }

}  // namespace limen::many_lods
