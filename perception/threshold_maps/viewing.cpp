// SPDX-License-Identifier: BSD-3-Clause
#include "perception/threshold_maps/viewing.h"

namespace limen::perception {

std::vector<Parameter> viewingParameters() {
  return {choiceParameter("display", "schwarz_2009", displayPresets(), "display and viewing distance",
                          "Schwarz 2009, section 10.4.1"),
          optionalFileParameter("display_file", "profile of another display, in place of a preset"),
          realParameter("distance_m", 0.0, 0.0, 100.0, "m", "viewing distance; 0: the display's", "")};
}

DisplayProfile viewingDisplay(const ParameterValues& values) {
  const std::string& file = values.text("display_file");
  DisplayProfile display = file.empty() ? displayPreset(values.text("display")) : readDisplay(file);
  if (values.real("distance_m") > 0.0) display.distanceM = values.real("distance_m");
  checkDisplay(display, "distance_m");
  return display;
}

}  // namespace limen::perception
