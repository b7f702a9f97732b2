// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/many_lods/multi_cut.h"

#include <string>

#include "experiments/base/error.h"
#include "renderer/many_lods/feedback_cuts.h"
#include "renderer/many_lods/hybrid_cuts.h"
#include "renderer/many_lods/listed_cuts.h"

namespace limen::many_lods {
namespace {

std::unique_ptr<CutFinder> finderFor(gl::Context& context, uint32_t views, const TreeShape& shape,
                                     uint32_t capacity, const CutMode& mode) {
  if (views > capacity)
    throw Error("the lists of cuts have room for " + std::to_string(capacity) + " nodes; there are " +
                    std::to_string(views) + " views",
                {}, "raise the capacity");
  const int bits = arityBitsOf(mode);
  if (shape.links && bits > 1)
    throw Error("nodes of a tree that is not complete have two children", "cuts.arity", "choose 2");
  if (!shape.links && shape.height % bits != 0)
    throw Error("a tree of " + std::to_string(shape.height) + " levels has no whole number of levels with " +
                    std::to_string(1 << bits) + " children to a node",
                "levels", "choose a multiple of " + std::to_string(bits));
  if (const auto* feedback = std::get_if<GeometryShaderCuts>(&mode))
    return std::make_unique<FeedbackCuts>(context, views, shape, capacity, *feedback);
  if (const auto* hybrid = std::get_if<HybridSettings>(&mode))
    return std::make_unique<HybridCuts>(context, views, shape, capacity, *hybrid);
  return std::make_unique<ListedCuts>(context, views, shape, capacity, mode);
}

}  // namespace

MultiCut::MultiCut(gl::Context& context, uint32_t views, const TreeShape& shape, uint32_t capacity,
                   const CutMode& mode)
    : views_(views), capacity_(capacity), finder_(finderFor(context, views, shape, capacity, mode)) {}

CutControl MultiCut::control() const { return controlBuffer().read<CutControl>(0, 1)[0]; }

std::vector<glm::uvec2> MultiCut::list() const {
  const CutControl state = control();
  std::vector<glm::uvec2> out =
      listBuffer().read<glm::uvec2>(int64_t{sizeof(glm::uvec2)} * state.readAt, int64_t{state.count});
  for (glm::uvec2& entry : out) entry.y &= ~kEntryDone;
  return out;
}

}  // namespace limen::many_lods
