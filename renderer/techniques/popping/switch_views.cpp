// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/popping/switch_views.h"

#include <epoxy/gl.h>

#include <algorithm>

#include "renderer/techniques/popping/switch_bindings.h"

namespace limen::techniques {
namespace {

frame::LodPairSetting pairSetting(const SwitchSetting& setting) {
  frame::LodPairSetting out;
  out.dtS = setting.dtS;
  out.shaded = setting.shaded;
  out.previousColour = setting.usesFlicker() && setting.samples == 1;
  out.moving = setting.dynamic;
  return out;
}

/// Albedos are at most 1, so only these can raise a pixel above the display's white.
bool mayPassWhite(const frame::ShadedSetting& shaded) {
  return shaded.specular > 0.0 || shaded.ambient + shaded.diffuse > 1.0 || shaded.background > 1.0;
}

}  // namespace

SwitchViews::SwitchViews(frame::Frame& parent, const SwitchSetting& setting)
    : setting_(setting), pair_(parent, pairSetting(setting)) {
  setting_.levels(parent);
  if (setting.samples > 1) {
    supersampled_[0].emplace(parent, "shown_actual", setting.shaded, setting.samples);
    supersampled_[1].emplace(parent, "shown_predicted", setting.shaded, setting.samples);
    if (setting.usesFlicker()) {
      previous_.emplace(parent, "shown_before", setting.shaded, setting.samples);
      if (setting.shaded.specular > 0.0) {  // else shading does not depend on the camera
        frame::ShadedSetting before = setting.shaded;
        before.eyeDtS = setting.dtS;
        shadedBefore_.emplace(parent, "shaded_before", before, setting.samples);
      }
    }
  }
  if (!mayPassWhite(setting.shaded)) return;
  clamp_ = &parent.context().programs().compute("renderer/techniques/popping/clamp.comp.glsl");
  for (int i = 0; i < 2; ++i) clamped_.emplace_back(gl::Format::RGBA32F, parent.sizePx());
  parent.passes().setBytesHeld("popping/clamp", 2 * clamped_[0].bytes());
}

void SwitchViews::render(frame::Frame& parent) {
  const auto [actual, predicted] = setting_.levels(parent);
  pair_.setLevels(actual, predicted);
  pair_.render();
  shown_[0] = pair_.actual().colour;
  shown_[1] = pair_.predicted().colour;
  for (size_t i = 0; i < 2; ++i) {
    if (!supersampled_[i]) continue;
    supersampled_[i]->setLevels(i == 0 ? actual : predicted);
    supersampled_[i]->render();
    shown_[i] = &supersampled_[i]->texture();
  }
  if (setting_.usesFlicker()) {
    previousShading_ =
        setting_.samples > 1 ? shown_[setting_.flickerOfBefore ? 1 : 0] : flickering().shadedBefore;
    previousFrame_ = pair_.previousColour();
    if (shadedBefore_) {
      shadedBefore_->setLevels(setting_.flickerOfBefore ? predicted : actual);
      shadedBefore_->render();
      previousShading_ = &shadedBefore_->texture();
    }
    if (previous_) {
      previous_->setLevels(predicted);
      previous_->renderAt(parent.timeS() - setting_.dtS);
      previousFrame_ = &previous_->texture();
    }
  }
  if (!clamp_) return;
  const auto pass = parent.passes().open("popping/clamp");
  clamp_->set("sizePx", parent.sizePx());
  for (size_t i = 0; i < 2; ++i) {
    shown_[i]->bindTexture(kClampPictureUnit);
    clamped_[i].bindImage(kClampShownImage, gl::Access::Write);
    clamp_->dispatch(parent.sizePx());
    shown_[i] = &clamped_[i];
  }
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
}

SwitchImages SwitchViews::read() const {
  SwitchImages out;
  out.input.actual = actual().read();
  out.input.predicted = predicted().read();
  out.input.linear = true;
  if (!setting_.dynamic) return out;
  out.input.actualDisplacement = pair_.actual().displacement->read();
  out.input.predictedDisplacement = pair_.predicted().displacement->read();
  if (setting_.usesDisocclusion())
    for (const auto* view : {&pair_.actual(), &pair_.predicted()})
      out.disocclusion.push_back(
          {view->previousDepth->read(), view->displacement->read(), view->depthBefore->read()});
  if (setting_.usesFlicker()) {
    const frame::LodPair::View& view = flickering();
    const FlickerPictures pictures = flickerPictures();
    out.flicker = perception::FlickerInput{pictures.actual->read(),
                                           pictures.predicted->read(),
                                           pictures.previousShading->read(),
                                           pictures.previousFrame->read(),
                                           view.displacement->read(),
                                           view.previousDepth->read(),
                                           pair_.predicted().depthBefore->read()};
  }
  return out;
}

}  // namespace limen::techniques
