// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/soft_shadows/bitmask/visibility_filter.h"

#include <epoxy/gl.h>

#include <cmath>

#include "renderer/frame/g_buffer.h"
#include "renderer/techniques/soft_shadows/bitmask/bitmask_bindings.h"

namespace limen::techniques {
namespace {

constexpr const char *kFilterPass = "soft_shadows/visibility_filter",
                     *kFilterShader = "renderer/techniques/soft_shadows/bitmask/visibility_filter.comp.glsl",
                     *kFilterSource = "Schwarz 2009, section 4.2.3 (not given there)";

}  // namespace

const SettingsTable<SurfaceMean>& SurfaceMean::table() {
  static const SettingsTable<SurfaceMean> kTable = {
      Binding(&SurfaceMean::radius, "radius", Range{1, 16}, "px",
              "Neighbours on either side over which visibility is averaged", kFilterSource)
          .formerly({"filter_radius"}),
      Binding(&SurfaceMean::step, "step", Range{0.001, 1.0}, "",
              "Largest step of visibility between neighbours attributed to sampling", kFilterSource)
          .formerly({"filter_step"}),
      Binding(&SurfaceMean::planeShare, "plane_share", Range{0.0, 1.0}, "",
              "Largest distance of a neighbour's point from the pixel's plane on the same surface, as a "
              "share of the distance between the points",
              kFilterSource)
          .formerly({"filter_plane_share"}),
      Binding(&SurfaceMean::angle, "angle", Range{0.0, 90.0}, "deg",
              "Largest angle between normals on the same surface", kFilterSource)
          .formerly({"filter_angle"})};
  return kTable;
}

void VisibilityFilter::prepare(frame::Frame& frame) {
  program_ = &frame.context().programs().compute(kFilterShader);
  rows_.emplace(gl::Format::R32F, frame.sizePx());
  filtered_.emplace(gl::Format::R32F, frame.sizePx());
  frame.passes().setBytesHeld(kFilterPass, rows_->bytes() + filtered_->bytes());
}

void VisibilityFilter::run(frame::Frame& frame, const gl::Texture& visibility) {
  const auto channel = [&](frame::Channel which) -> const gl::Texture& {
    return frame.get<frame::GBufferChannel>(frame::ChannelSetting{which}).texture();
  };
  const gl::Texture& receivers = frame.get<frame::Receivers>().texture();
  const gl::Texture &positions = channel(frame::Channel::Position),
                    &normals = channel(frame::Channel::Normal);
  const auto scope = frame.passes().open(kFilterPass);
  program_->set("sizePx", frame.sizePx());
  program_->set("radius", settings_.radius);
  program_->set("maxStep", static_cast<float>(settings_.step));
  program_->set("planeShare", static_cast<float>(settings_.planeShare));
  program_->set("normalCosine", static_cast<float>(std::cos(glm::radians(settings_.angle))));
  receivers.bindTexture(kVisibilityFilterReceiversUnit);
  positions.bindTexture(kVisibilityFilterPositionsUnit);
  normals.bindTexture(kVisibilityFilterNormalsUnit);
  for (int axis = 0; axis < 2; ++axis) {
    program_->set("direction", glm::ivec2(1 - axis, axis));
    (axis == 0 ? visibility : *rows_).bindTexture(kVisibilityFilterVisibilitiesUnit);
    (axis == 0 ? *rows_ : *filtered_).bindImage(kVisibilityFilterVisibilityImage, gl::Access::Write);
    program_->dispatch(frame.sizePx());
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
  }
}

}  // namespace limen::techniques
