// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/frame/g_buffer.h"
#include "renderer/techniques/soft_shadows/scene_needs/shadow_candidates.h"

namespace limen::techniques {
namespace {

Image receiverMask(frame::Frame& frame) {
  const Image receivers = frame.get<frame::Receivers>().texture().read();
  Image out(receivers.width, receivers.height, 1);
  for (size_t i = 0; i < out.pixels(); ++i) out.data[i] = receivers.data[4 * i + 3] >= 0.0F ? 1.0F : 0.0F;
  return out;
}

}  // namespace

std::vector<Candidate> readCandidates(const std::string& path, const MapSettings& map) {
  const auto withMap = [&map](Candidate& candidate) {
    const TechniqueInfo& info = TechniqueRegistry::instance().get(candidate.technique);
    if (takes(info, "resolution")) candidate.given.emplace("resolution", int64_t{map.resolution});
    if (takes(info, "raster") && map.raster != MapSettings{}.raster)
      candidate.given.emplace("raster", std::string(limen::toText(map.raster)));
  };
  return readCandidateFile(path, {.product = ProductKind::Visibility,
                                  .chooser = "soft_shadows/scene_needs",
                                  .example = "- {name: soft_shadows/bitmask, budget: [64, 256]}",
                                  .complete = withMap});
}

NeedsSubject shadowSubject() {
  return {.reference =
              [](int samples, int64_t seed) {
                return Candidate{"soft_shadows/ray_traced", {{"samples", int64_t{samples}}, {"seed", seed}}};
              },
          .samples = "rays per receiver",
          .mask = receiverMask,
          .depicts = perception::Depicts::ShareOfLight};
}

}  // namespace limen::techniques
