// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/reflections/cone_traced/cone_lists.h"

#include <epoxy/gl.h>

#include <algorithm>

#include "renderer/techniques/reflections/cone_traced/cone_traced_bindings.h"

namespace limen::techniques {
namespace {

constexpr uint32_t kMostListGroups = 4096;

uint32_t roundsFor(const gl::Context& context, uint32_t triangles) {
  if (!context.device().software || triangles == 0) return 1;
  return (triangles + kConeEntriesPerRound - 1) / kConeEntriesPerRound;
}

}  // namespace

ConeLists::ConeLists(frame::Frame& frame, const PairTraversal& traversal)
    : triangleCount_(frame.gpuScene().triangleCount()),
      roundCount_(roundsFor(frame.context(), triangleCount_)),
      sizePx_(frame.sizePx()),
      program_(frame.context().programs().compute(
          "renderer/techniques/reflections/cone_traced/lists.comp.glsl",
          roundCount_ > 1 ? gl::ShaderDefines{{"RESUMED", "1"}} : gl::ShaderDefines{})),
      scan_(frame.context(), traversal.tileCount()),
      sums_(compute::PrefixSum::bytesFor(traversal.tileCount(), 1), nullptr),
      lists_((int64_t{2} * traversal.tileCount() + traversal.gatheredRoom()) * 4, nullptr) {
  if (roundCount_ > 1) rounds_.emplace(int64_t{roundCount_} * 12, nullptr);
}

void ConeLists::make(const PairTraversal& traversal) const {
  const uint32_t tiles = traversal.tileCount();
  scan_.run(traversal.tiles(), sums_, tiles);
  program_.set("tileCount", tiles);
  program_.set("gatheredRoom", traversal.gatheredRoom());
  traversal.gathered().bindStorage(kConeGatheredBuffer);
  sums_.bindStorage(kConeSumsBuffer);
  traversal.tiles().bindStorage(kConeTilesBuffer);
  lists_.bindStorage(kConeListsBuffer);
  if (rounds_) {
    rounds_->clearUint(0);
    rounds_->bindStorage(kConeRoundsBuffer);
    program_.set("triangleCount", triangleCount_);
    program_.set("roundGroups", (sizePx_ + kGroupSide - 1) / kGroupSide);
  }
  program_.use();
  // As many groups as a GPU keeps busy; each takes more pairs where there are more.
  const uint32_t most = std::max(tiles, traversal.gatheredRoom()) / kConeGroup + 1;
  glDispatchCompute(std::min(most, kMostListGroups), 1, 1);
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT);
}

}  // namespace limen::techniques
