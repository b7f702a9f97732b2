// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/soft_shadows/bitmask/visibility_filter.h"

#include <epoxy/gl.h>

#include <cmath>

#include "experiments/base/error.h"
#include "renderer/frame/g_buffer.h"

namespace limen::techniques {
namespace {

constexpr const char *kFilterPass = "soft_shadows/visibility_filter",
                     *kFilterShader = "renderer/techniques/soft_shadows/bitmask/visibility_filter.comp.glsl",
                     *kFilterSource = "Schwarz 2009, section 4.2.3 (not given there)";
constexpr double kDefaultStep = 0.125, kDefaultPlaneShare = 0.1, kDefaultAngle = 15.0;

}  // namespace

std::vector<Parameter> VisibilityFilter::parameters() {
  return {
      integerParameter("filter_radius", 0, 0, 16, "px",
                       "Neighbours on either side over which visibility is averaged; 0: none", kFilterSource),
      realParameter("filter_step", kDefaultStep, 0.001, 1.0, "",
                    "Largest step of visibility between neighbours that samples are taken to explain: two "
                    "rows of 16 by 16",
                    kFilterSource),
      realParameter("filter_plane_share", kDefaultPlaneShare, 0.0, 1.0, "",
                    "Distance of a neighbour's point from the pixel's plane, as a share of that from its "
                    "point, up to which both are of one surface",
                    kFilterSource),
      realParameter("filter_angle", kDefaultAngle, 0.0, 90.0, "deg",
                    "Angle between normals up to which both are of one surface", kFilterSource)};
}

void VisibilityFilter::check(const ParameterValues& values) {
  if (values.integer("filter_radius") > 0) return;
  for (const auto& [name, usual] : {std::pair("filter_step", kDefaultStep),
                                    {"filter_plane_share", kDefaultPlaneShare},
                                    {"filter_angle", kDefaultAngle}})
    if (values.real(name) != usual)
      throw Error("'" + std::string(name) + "' is about the visibility filter, and there is none", name,
                  "leave it out, or give a filter_radius");
}

VisibilityFilter::VisibilityFilter(const ParameterValues& values)
    : radius_(static_cast<int>(values.integer("filter_radius"))),
      step_(static_cast<float>(values.real("filter_step"))),
      planeShare_(static_cast<float>(values.real("filter_plane_share"))),
      normalCosine_(static_cast<float>(std::cos(glm::radians(values.real("filter_angle"))))) {}

void VisibilityFilter::prepare(frame::Frame& frame) {
  program_ = &frame.context().programs().compute(kFilterShader);
  rows_.emplace(gl::Format::R32F, frame.sizePx());
  filtered_.emplace(gl::Format::R32F, frame.sizePx());
  frame.passes().setBytesHeld(kFilterPass, rows_->bytes() + filtered_->bytes());
}

void VisibilityFilter::run(frame::Frame& frame, const gl::Texture& visibility) const {
  const auto channel = [&](frame::Channel which) -> const gl::Texture& {
    return frame.get<frame::GBufferChannel>(frame::ChannelSetting{which}).texture();
  };
  const gl::Texture& receivers = frame.get<frame::Receivers>().texture();
  const gl::Texture &positions = channel(frame::Channel::Position),
                    &normals = channel(frame::Channel::Normal);
  const auto scope = frame.passes().open(kFilterPass);
  program_->set("sizePx", frame.sizePx());
  program_->set("radius", radius_);
  program_->set("maxStep", step_);
  program_->set("planeShare", planeShare_);
  program_->set("normalCosine", normalCosine_);
  receivers.bindTexture(0);
  positions.bindTexture(2);
  normals.bindTexture(3);
  for (int axis = 0; axis < 2; ++axis) {
    program_->set("direction", glm::ivec2(1 - axis, axis));
    (axis == 0 ? visibility : *rows_).bindTexture(1);
    (axis == 0 ? *rows_ : *filtered_).bindImage(0, gl::Access::Write);
    program_->dispatch(frame.sizePx());
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
  }
}

}  // namespace limen::techniques
