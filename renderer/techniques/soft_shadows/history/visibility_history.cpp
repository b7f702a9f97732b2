// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/soft_shadows/history/visibility_history.h"

#include <epoxy/gl.h>

#include <cmath>

#include "renderer/frame/g_buffer.h"
#include "renderer/frame/motion.h"
#include "renderer/techniques/soft_shadows/history/history_bindings.h"

namespace limen::techniques {
namespace {

constexpr const char *kHistoryPass = "soft_shadows/history",
                     *kHistoryShader =
                         "renderer/techniques/soft_shadows/history/visibility_history.comp.glsl";

/// Frame times are sums and differences of doubles; equal steps must not differ in their last digits, since
/// each step length has its own input.
double stepBetween(double fromS, double toS) {
  constexpr double kNanoseconds = 1e9;
  return std::round((toS - fromS) * kNanoseconds) / kNanoseconds;
}

gl::ShaderDefines historyDefines(bool moving, bool fates) {
  gl::ShaderDefines defines;
  if (moving) defines["MOVING"] = "1";
  if (fates) defines["FATES"] = "1";
  return defines;
}

}  // namespace

const SettingsTable<NeighbourhoodClamp>& NeighbourhoodClamp::table() {
  static const SettingsTable<NeighbourhoodClamp> kTable = {
      Binding(&NeighbourhoodClamp::radius, "radius", Range{1, 8}, "px",
              "Half-width of the neighbourhood, excluding the centre")
          .formerly({"clamp_radius"})};
  return kTable;
}

const SettingsTable<HistorySettings>& HistorySettings::table() {
  using S = HistorySettings;
  static const std::string kSource = "Schwarz 2009, section 5.2.2 (suggested there; value not given)";
  static const SettingsTable<S> kTable = {
      {&S::alpha,
       "alpha",
       {0.01, 1},
       "",
       "Weight of the current frame, the rest going to the history; 1: no history",
       kSource},
      {&S::depthTolerance,
       "depth_tolerance",
       {0, 1},
       "",
       "Depth difference at which the history belongs to another surface, as a share of the depth",
       kSource},
      {&S::normalToleranceDeg,
       "normal_tolerance_deg",
       {0, 180},
       "deg",
       "Angle between normals at which the history belongs to another surface",
       kSource},
      Binding(&S::clamp, "clamp", "Bounds of the history", "Karis 2014")};
  return kTable;
}

VisibilityHistory::VisibilityHistory(const HistorySettings& settings)
    : alpha_(static_cast<float>(settings.alpha)),
      depthTolerance_(static_cast<float>(settings.depthTolerance)),
      normalCosine_(static_cast<float>(std::cos(glm::radians(settings.normalToleranceDeg)))) {
  if (const auto* clamp = std::get_if<NeighbourhoodClamp>(&settings.clamp)) clampRadius_ = clamp->radius;
}

void VisibilityHistory::prepare(frame::Frame& frame) {
  int64_t bytes = 0;
  for (size_t i = 0; i < 2; ++i) {
    visibility_[i].emplace(gl::Format::R32F, frame.sizePx());
    surface_[i].emplace(gl::Format::RGBA32F, frame.sizePx());
    bytes += visibility_[i]->bytes() + surface_[i]->bytes();
  }
  frame.passes().setBytesHeld(kHistoryPass, bytes);
  for (const bool moving : {false, true})
    frame.context().programs().compute(kHistoryShader, historyDefines(moving, false));
  forget();
}

void VisibilityHistory::add(frame::Frame& frame, const gl::Texture& visibility) {
  run(frame, visibility, nullptr);
  latest_ = 1 - latest_;
  hasPast_ = true;
  timeS_ = frame.timeS();
}

void VisibilityHistory::run(frame::Frame& frame, const gl::Texture& visibility, const gl::Texture* fates) {
  const gl::Texture& receivers = frame.get<frame::Receivers>().texture();
  const gl::Texture& depths =
      frame.get<frame::GBufferChannel>(frame::ChannelSetting{frame::Channel::Depth}).texture();
  const gl::Texture& normals =
      frame.get<frame::GBufferChannel>(frame::ChannelSetting{frame::Channel::Normal}).texture();
  const double dtS = hasPast_ ? stepBetween(timeS_, frame.timeS()) : 0.0;
  const frame::Motion* motion = dtS == 0.0 ? nullptr : &frame.get<frame::Motion>(frame::MotionSetting{dtS});
  const gl::Program& program =
      frame.context().programs().compute(kHistoryShader, historyDefines(motion != nullptr, fates != nullptr));
  const auto scope = frame.passes().open(kHistoryPass);
  program.set("sizePx", frame.sizePx());
  program.set("hasPast", hasPast_ ? 1 : 0);
  program.set("alpha", alpha_);
  program.set("depthTolerance", depthTolerance_);
  program.set("normalCosine", normalCosine_);
  program.set("clampRadius", clampRadius_);
  receivers.bindTexture(kHistoryReceiversUnit);
  visibility.bindTexture(kHistoryPresentVisibilityUnit);
  depths.bindTexture(kHistoryDepthsUnit);
  normals.bindTexture(kHistoryNormalsUnit);
  visibility_.at(latest_)->bindTexture(kHistoryPastVisibilityUnit);
  surface_.at(latest_)->bindTexture(kHistoryPastSurfaceUnit);
  if (motion) {
    motion->displacement().bindTexture(kHistoryDisplacementUnit);
    motion->previousDepth().bindTexture(kHistoryPreviousDepthUnit);
  }
  if (fates) {
    fates->bindImage(kHistoryFateImage, gl::Access::Write);
  } else {
    visibility_.at(1 - latest_)->bindImage(kHistoryVisibilityImage, gl::Access::Write);
    surface_.at(1 - latest_)->bindImage(kHistorySurfaceImage, gl::Access::Write);
  }
  program.dispatch(frame.sizePx());
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
}

std::vector<Quantity> VisibilityHistory::counters() {
  return {{"history_taken_share", "Share of receivers with a history", "", Direction::Neither},
          {"history_bounded_share", "Share of receivers whose history is clamped", "", Direction::Neither}};
}

std::vector<Counter> VisibilityHistory::count(frame::Frame& frame, const gl::Texture& visibility) {
  const gl::Texture fates(gl::Format::R32UI, frame.sizePx());
  frame.begin();
  run(frame, visibility, &fates);
  frame.end();
  double receivers = 0.0, taken = 0.0, bounded = 0.0;
  for (const uint32_t fate : fates.readUint()) {
    receivers += fate != kFateNoReceiver;
    taken += fate == kFatePastTaken || fate == kFatePastBounded;
    bounded += fate == kFatePastBounded;
  }
  const auto share = [&](double part) { return receivers > 0.0 ? part / receivers : 0.0; };
  return {{"history_taken_share", share(taken)}, {"history_bounded_share", share(bounded)}};
}

}  // namespace limen::techniques
