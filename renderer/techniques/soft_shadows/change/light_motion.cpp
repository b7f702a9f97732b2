// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/soft_shadows/change/light_motion.h"

#include <cmath>

#include "renderer/frame/g_buffer.h"

namespace limen::techniques {

scene::Scene withMovedLight(const scene::Scene& scene, glm::dvec2 share) {
  scene::Scene moved = scene;
  scene::AreaLight& light = moved.lights.at(0);
  const glm::dvec2 by = share * light.size;
  light.centre += by.x * light.axisX + by.y * light.axisY;
  return moved;
}

const SettingsTable<LightWay>& LightWay::table() {
  static const SettingsTable<LightWay> kTable = {
      {&LightWay::step,
       "light_step",
       {0, 100},
       "",
       "Distance that the light moves in its plane per frame, as a share of its extents"},
      {&LightWay::directionDeg,
       "direction_deg",
       {0, 360},
       "deg",
       "Direction of that motion, from the light's x axis to its y axis"}};
  return kTable;
}

LightMotion::LightMotion(ChosenEntry inner, const LightWay& way, const HistorySettings* history)
    : inner_(std::move(inner)) {
  const double angle = glm::radians(way.directionDeg);
  stepShare_ = way.step * glm::dvec2(std::cos(angle), std::sin(angle));
  if (history) history_.emplace(*history);
}

void LightMotion::prepare(frame::Frame& frame, int steps) {
  for (int back = steps; back >= 0; --back) {
    Place& place = *places_.emplace_back(std::make_unique<Place>());
    place.scene = withMovedLight(frame.scene(), -double(back) * stepShare_);
    place.frame = std::make_unique<frame::Frame>(frame, "place_" + std::to_string(steps - back), place.scene);
    place.technique = makeInner(inner_);
    place.technique->prepare(*place.frame);
  }
  if (history_) history_->prepare(*places_.front()->frame);
}

void LightMotion::render(frame::Frame& frame, const StepVisitor& visit) {
  if (history_) history_->forget();
  last_ = {};
  for (size_t i = 0; i < places_.size(); ++i) {
    Place& place = *places_[i];
    place.frame->setTime(frame.timeS() - double(places_.size() - 1 - i) * cameraStepS_);
    place.frame->begin();
    place.technique->render(*place.frame);
    if (history_) history_->add(*place.frame, place.technique->product());
    Seen before = last_;
    if (history_) before.visibility = &history_->before();
    last_ = {history_ ? &history_->current() : &place.technique->product(),
             &place.frame->get<frame::Receivers>().texture()};
    if (visit && i > 0) visit(static_cast<int>(i) - 1, before, last_);
    place.frame->end();
  }
}

std::vector<Counter> LightMotion::count() {
  Place& place = *places_.back();
  std::vector<Counter> all = countInner(*place.technique, *place.frame);
  if (history_)
    for (Counter& counter : history_->count(*place.frame, place.technique->product()))
      all.push_back(std::move(counter));
  return all;
}

std::vector<Quantity> LightMotion::counters() {
  std::vector<Quantity> all = innerCounters();
  for (Quantity& counter : VisibilityHistory::counters()) all.push_back(std::move(counter));
  return all;
}

}  // namespace limen::techniques
