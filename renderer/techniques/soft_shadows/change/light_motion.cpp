// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/soft_shadows/change/light_motion.h"

#include <cassert>
#include <cmath>

#include "experiments/base/error.h"
#include "renderer/frame/g_buffer.h"

namespace limen::techniques {
namespace {

constexpr const char *kUnsmoothed = "none", *kSmoothed = "history";

}  // namespace

scene::Scene withMovedLight(const scene::Scene& scene, glm::dvec2 share) {
  scene::Scene moved = scene;
  scene::AreaLight& light = moved.lights.at(0);
  const glm::dvec2 by = share * light.size;
  light.centre += by.x * light.axisX + by.y * light.axisY;
  return moved;
}

LightMotion::LightMotion(const ParameterValues& values)
    : values_(values), steps_(static_cast<int>(values.integer("steps"))) {
  const double angle = glm::radians(values.real("direction_deg"));
  stepShare_ = values.real("light_step") * glm::dvec2(std::cos(angle), std::sin(angle));
  if (values.text("smoothing") == kSmoothed) history_.emplace(values);
}

std::vector<Parameter> LightMotion::parameters() {
  std::vector<Parameter> all = {
      realParameter("light_step", 0.05, 0.0, 100.0, "",
                    "Way of the light in its plane from one frame to the next, as a share of its extents"),
      realParameter("direction_deg", 0.0, 0.0, 360.0, "deg",
                    "Direction of that way, from the light's x axis to its y axis"),
      integerParameter("steps", 1, 1, 32, "steps",
                       "Steps of the light up to the frame in question; without a history only the last one "
                       "or two frames matter"),
      choiceParameter("smoothing", kUnsmoothed, {kUnsmoothed, kSmoothed},
                      "Whether frames are averaged with those before them, as soft_shadows/history does",
                      "Schwarz 2009, section 5.2.2 (suggested there)")};
  for (Parameter& parameter : innerParameters(InnerKind::OrExact)) all.push_back(std::move(parameter));
  for (Parameter& parameter : VisibilityHistory::parameters()) all.push_back(std::move(parameter));
  return all;
}

void LightMotion::check(const ParameterValues& values) {
  checkInner(values);
  VisibilityHistory::check(values);
  if (values.text("smoothing") == kSmoothed) return;
  for (const Parameter& parameter : VisibilityHistory::parameters())
    if (values.all().at(parameter.name) != parameter.defaultValue)
      throw Error("'" + parameter.name + "' is about the history, and there is none", parameter.name,
                  "leave it out, or give smoothing: history");
}

void LightMotion::prepare(frame::Frame& frame, int places) {
  assert(places >= 1 && places <= steps_ + 1);
  for (int back = places - 1; back >= 0; --back) {
    Place& place = *places_.emplace_back(std::make_unique<Place>());
    place.scene = withMovedLight(frame.scene(), -double(back) * stepShare_);
    place.frame =
        std::make_unique<frame::Frame>(frame, "place_" + std::to_string(steps_ - back), place.scene);
    place.technique = makeInner(values_);
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

std::vector<Quantity> LightMotion::counterNames() {
  std::vector<Quantity> names = innerCounterNames();
  for (Quantity& name : VisibilityHistory::counterNames()) names.push_back(std::move(name));
  return names;
}

}  // namespace limen::techniques
