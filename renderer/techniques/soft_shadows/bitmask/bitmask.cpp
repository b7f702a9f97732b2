// SPDX-License-Identifier: BSD-3-Clause
// Soft shadow mapping with occlusion bitmasks (SS-12, SS-13, SS-14): light samples that some micropatch
// covers are bits that are set once, so overlapping occluders fuse. Source: Schwarz 2009, section 4.2.
#include "renderer/techniques/soft_shadows/occluder_search.h"

namespace limen::techniques {
namespace {

gl::ShaderDefines definesOf(const std::string& pattern) {
  return {{"PATTERN", pattern == "regular_8"    ? "8"
                      : pattern == "regular_16" ? "16"
                      : pattern == "regular_32" ? "32"
                                                : "160"}};
}

class Bitmask : public OccluderSearch {
 public:
  explicit Bitmask(const ParameterValues& values)
      : OccluderSearch(values, "renderer/techniques/soft_shadows/bitmask/bitmask.comp.glsl",
                       "soft_shadows/bitmask", definesOf(values.text("pattern"))) {}
};

std::vector<Parameter> parameters() {
  std::vector<Parameter> all = OccluderSearch::searchParameters();
  all.push_back(choiceParameter(
      "pattern", "jittered_16", {"regular_8", "regular_16", "regular_32", "jittered_16"},
      "Light samples: regular grids, or 16 x 16 in rotated pairs", "Schwarz 2009, section 4.2.2"));
  return all;
}

const Registered<TechniqueInfo> kRegistered{
    {.name = "soft_shadows/bitmask",
     .version = 1,
     .summary = "Micropatches backprojected onto a bit field of light samples",
     .source = "Schwarz 2009, section 4.2 (SS-12, SS-13, SS-14)",
     .product = ProductKind::Visibility,
     .parameters = parameters(),
     .needs = {"rectangular_light"},
     .reference = false,
     .onCpu = false,
     .make = [](const ParameterValues& values) { return std::make_unique<Bitmask>(values); },
     .errorBound = {},
     .counters = OccluderSearch::counterNames()}};

}  // namespace
}  // namespace limen::techniques
