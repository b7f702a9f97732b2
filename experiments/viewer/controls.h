// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <map>
#include <string>
#include <vector>

#include "experiments/base/parameter.h"
#include "experiments/viewer/choices.h"

namespace limen::viewer {

/// Where the controls of the last frame are, by name ("technique.budget"), so that somebody else than a hand
/// can use them.
class ControlMap {
 public:
  struct Place {
    glm::vec2 leastPx, mostPx;
    glm::vec2 centre() const { return 0.5F * (leastPx + mostPx); }
  };
  void clear() { places_.clear(); }
  /// The item that ImGui made last.
  void note(const std::string& name);
  void note(const std::string& name, glm::vec2 leastPx, glm::vec2 mostPx);
  const Place* find(const std::string& name) const;
  const std::map<std::string, Place>& all() const { return places_; }

 private:
  std::map<std::string, Place> places_;
};

/// A control for each declared parameter, made from its declaration alone: tick box, slider with range and
/// unit, choice or text, a tooltip with description, range and source, and a button back to the default where
/// it is not there. Returns true if a value changed.
bool parameterControls(const std::string& prefix, const std::vector<Parameter>& declared, Chosen& chosen,
                       ControlMap& places);

/// A list of names to choose from, grouped by their folders, with a filter. `about` gives a tooltip for a
/// name. Returns true if another one was chosen.
bool nameChooser(const std::string& label, const std::vector<std::string>& names, std::string& chosen,
                 const std::function<std::string(const std::string&)>& about, ControlMap& places);

}  // namespace limen::viewer
