// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/soft_shadows/sparse/reconstruction.h"

#include "renderer/frame/g_buffer.h"
#include "renderer/techniques/soft_shadows/sparse/sparse_bindings.h"

namespace limen::techniques {

SurfaceChannels SurfaceChannels::of(frame::Frame& frame) {
  using frame::Channel, frame::ChannelSetting, frame::GBufferChannel;
  return {&frame.get<frame::Receivers>().texture(),
          &frame.get<GBufferChannel>(ChannelSetting{Channel::Depth}).texture(),
          &frame.get<GBufferChannel>(ChannelSetting{Channel::Normal}).texture()};
}

void SurfaceChannels::bind(uint32_t unit) const {
  static_assert(kSparseDepthsUnit == kSparseReceiversUnit + 1 &&
                kSparseNormalsUnit == kSparseReceiversUnit + 2);
  static_assert(kSparseUpsampleGridDepthsUnit == kSparseUpsampleGridReceiversUnit + 1 &&
                kSparseUpsampleGridNormalsUnit == kSparseUpsampleGridReceiversUnit + 2);
  receivers->bindTexture(unit);
  depths->bindTexture(unit + 1);
  normals->bindTexture(unit + 2);
}

void Reconstruction::configure(const frame::Frame& frame, const gl::Program& program) const {
  program.set("depthTolerance", static_cast<float>(depthTolerance_));
  program.set("normalPower", static_cast<float>(normalPower_));
  program.set("anchorToCamera", glm::mat4(frame.anchorToCamera()));
  program.set("rayScale", rayScale(frame));
  program.set("sizePx", frame.sizePx());
}

glm::vec2 rayScale(const frame::Frame& frame) {
  return {frame.tanHalfFov() * frame.aspect(), frame.tanHalfFov()};
}

}  // namespace limen::techniques
