// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/tessellation/compute/trim_pass.h"

#include <epoxy/gl.h>

#include <algorithm>

#include "renderer/techniques/tessellation/tessellation_bindings.h"

namespace limen::techniques {
namespace {

std::vector<PatchTrimRecord> trimRecords(const surfaces::PatchSet& set) {
  std::vector<PatchTrimRecord> out;
  for (const surfaces::PatchTrim& trim : set.trimOf)
    out.push_back({glm::vec2(trim.low), glm::vec2(trim.high), trim.region, 0, glm::ivec2(0)});
  return out;
}

gl::Texture trimTexture(const std::vector<surfaces::TrimMask>& masks, const TrimByTexture& settings) {
  const bool distance = settings.content == surfaces::TrimTexture::Distance;
  const auto layers = static_cast<int>(masks.size());
  gl::Texture out(distance ? gl::Format::R16F : gl::Format::R8, glm::ivec2(settings.resolution), 1, layers,
                  distance ? gl::Sampling::Linear : gl::Sampling::Nearest);
  for (int layer = 0; layer < layers; ++layer) {
    Image image(settings.resolution, settings.resolution, 1);
    image.data = masks[static_cast<size_t>(layer)].texels();
    out.view(layer).write(image);
  }
  return out;
}

}  // namespace

TrimPass::TrimPass(frame::Frame& frame, const TrimByTexture& settings, const gl::ShaderDefines& defines,
                   int64_t vertexCapacity)
    : set_(frame.scene().surfaces),
      test_(set_, settings.mask()),
      program_(frame.context().programs().compute("renderer/techniques/tessellation/compute/trims.comp.glsl",
                                                  defines)),
      patchTrims_(trimRecords(set_)),
      places_(vertexCapacity * int64_t{sizeof(glm::vec4)}, nullptr),
      texture_(trimTexture(test_.masks(), settings)) {}

void TrimPass::run(frame::Frame& frame, int cornerFix, int invocations) const {
  const auto scope = frame.passes().open("tessellation/trims");
  patchTrims_.bindStorage(kPatchTrimsBuffer);
  places_.bindStorage(kTrimPlacesBuffer);
  program_.use();
  program_.set("cornerFix", cornerFix);
  program_.dispatch({invocations, 1}, {kTessellationGroup, 1});
  glMemoryBarrier(GL_VERTEX_ATTRIB_ARRAY_BARRIER_BIT);
}

double TrimPass::error() const {
  constexpr int kSamples = 1000;
  double out = 0.0;
  for (size_t i = 0; i < set_.trims.size(); ++i)
    out = std::max(out, surfaces::trimError(set_.trims[i], test_.masks()[i], kSamples));
  return out;
}

}  // namespace limen::techniques
