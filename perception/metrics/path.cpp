// SPDX-License-Identifier: BSD-3-Clause
#include "perception/metrics/path.h"

namespace limen::perception {

const SettingsTable<LightPath>& LightPath::table() {
  using S = LightPath;
  static const SettingsTable<S> kTable = {
      {&S::step,
       "step",
       {1e-6, 100},
       "",
       "Distance that the light moves from frame to frame, as a share of its extents"},
      {&S::directionDeg,
       "direction_deg",
       {0, 360},
       "deg",
       "Direction of that motion, from the light's x axis to its y axis"}};
  return kTable;
}

const SettingsTable<CameraPath>& CameraPath::table() {
  using S = CameraPath;
  static const SettingsTable<S> kTable = {
      {&S::stepS, "step_s", {1e-4, 10}, "s", "Time from frame to frame on the scene's camera path"}};
  return kTable;
}

const SettingsTable<PathRequest>& PathRequest::table() {
  using S = PathRequest;
  static const SettingsTable<S> kTable = {
      {&S::path, "path", "What moves; the first frame is the run's own"},
      {&S::steps, "steps", {1, 1024}, "steps", "Steps from frame to frame"}};
  return kTable;
}

}  // namespace limen::perception
