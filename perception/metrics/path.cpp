// SPDX-License-Identifier: BSD-3-Clause
#include "perception/metrics/path.h"

namespace limen::perception {

const SettingsTable<PathRequest>& PathRequest::table() {
  using S = PathRequest;
  static const SettingsTable<S> kTable = {
      {&S::steps, "steps", {1, 1024}, "steps", "Steps from frame to frame; the first frame is the run's own"},
      {&S::cameraStepS,
       "camera_step_s",
       {0, 10},
       "s",
       "Time that the camera advances along its path per step; 0: it rests"},
      {&S::lightStep,
       "light_step",
       {0, 100},
       "",
       "Distance that the light moves in its plane per step, as a share of its extents"},
      {&S::directionDeg,
       "direction_deg",
       {0, 360},
       "deg",
       "Direction of that motion, from the light's x axis to its y axis"}};
  return kTable;
}

}  // namespace limen::perception
