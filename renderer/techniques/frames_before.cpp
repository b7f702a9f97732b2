// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/frames_before.h"

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>

namespace limen::techniques {

scene::Scene withLightTurned(const scene::Scene& scene, double degrees) {
  scene::Scene out = scene;
  scene::AreaLight& light = out.lights.at(0);
  const glm::dvec3 middle = scene.bounds().centre();
  const glm::dmat4 turn = glm::rotate(glm::dmat4(1.0), glm::radians(degrees), glm::dvec3(0.0, 1.0, 0.0));
  light.centre = middle + glm::dvec3(turn * glm::dvec4(light.centre - middle, 0.0));
  light.axisX = glm::dvec3(turn * glm::dvec4(light.axisX, 0.0));
  light.axisY = glm::dvec3(turn * glm::dvec4(light.axisY, 0.0));
  return out;
}

const SettingsTable<FramesBefore>& FramesBefore::table() {
  using S = FramesBefore;
  static const SettingsTable<S> kTable = {
      {&S::frames, "frames", {0, 4096}, "", "Frames with motion before the first picture"},
      {&S::settled, "settled", {0, 4096}, "", "Frames after these in which nothing moves any more"},
      {&S::stepS, "step_s", {1e-6, 60.0}, "s", "Time of the camera's path from one of them to the next"},
      {&S::lightTurnDeg,
       "light_turn",
       {-180.0, 180.0},
       "deg",
       "Angle by which the light turns about the scene's middle in each of them; at their end it is in its "
       "place"}};
  return kTable;
}

void FramesBefore::renderAll(frame::Frame& frame, const std::function<void(frame::Frame&)>& render) const {
  const double now = frame.timeS();
  const bool turns = lightTurnDeg != 0.0 && !frame.scene().lights.empty();
  for (int left = frames + settled; left > 0; --left) {
    const int away = std::max(left - settled, 0);
    frame.setTime(now - away * stepS);
    frame.begin();
    if (turns && away > 0) {
      const scene::Scene turned = withLightTurned(frame.scene(), -away * lightTurnDeg);
      frame::Frame other(frame, "before", turned);
      other.begin();
      render(other);
    } else {
      render(frame);
    }
    frame.end();
  }
  frame.setTime(now);
}

}  // namespace limen::techniques
