// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/soft_shadows/sparse/reconstruction.h"

#include "renderer/frame/g_buffer.h"

namespace limen::techniques {

std::vector<Parameter> Reconstruction::parameters() {
  return {
      realParameter(
          "depth_tolerance", 0.02, 1e-4, 1.0, "",
          "Distance from a point's tangent plane, as a share of its distance from the camera, at which "
          "a sample no longer counts for it",
          "Schwarz 2009, section 5.1.3 (value not given there)"),
      realParameter("normal_power", 4.0, 0.0, 64.0, "",
                    "Power of the cosine between a point's normal and a sample's that weighs the sample; 0: "
                    "normals do not matter. Uniform mode only",
                    "Schwarz 2009, section 5.1.3 (value not given there)")};
}

Reconstruction::Reconstruction(const ParameterValues& values)
    : depthTolerance_(values.real("depth_tolerance")), normalPower_(values.real("normal_power")) {}

SurfaceChannels SurfaceChannels::of(frame::Frame& frame) {
  using frame::Channel, frame::ChannelSetting, frame::GBufferChannel;
  return {&frame.get<frame::Receivers>().texture(),
          &frame.get<GBufferChannel>(ChannelSetting{Channel::Depth}).texture(),
          &frame.get<GBufferChannel>(ChannelSetting{Channel::Normal}).texture()};
}

void SurfaceChannels::bind(uint32_t unit) const {
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
