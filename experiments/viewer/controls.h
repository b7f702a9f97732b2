// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "experiments/base/parameter.h"
#include "experiments/viewer/setup.h"

namespace limen::viewer {

/// Where the controls of the last frame are, by name ("technique.budget.rim"), so that tests can use them as
/// the mouse does.
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

struct ParameterChange {
  std::string path;
  std::optional<ParameterValue> value;  ///< none: back to the default
};

/// Controls for an entry's parameters, made from their declarations alone: check box, slider with range and
/// unit, list or text, a tooltip with description, range and source, and a button to reset a value that is
/// not the default. Groups, and the parameters of chosen
/// alternatives, are collapsible; within others, or where they are many, they start closed unless one is not
/// at its default. the parameters of the chosen alternative follow below its choice, those of the others are
/// hidden. Returns the change that the user made, if any; it is valid.
std::optional<ParameterChange> parameterControls(const std::string& prefix,
                                                 const std::vector<Parameter>& declared, const Entry& entry,
                                                 ControlMap& places);

/// A list of names to choose from, grouped by their folders, with a filter. `about` gives a tooltip for a
/// name. Returns the name if another one was chosen.
std::optional<std::string> nameChooser(const std::string& label, const std::vector<std::string>& names,
                                       const std::string& chosen,
                                       const std::function<std::string(const std::string&)>& about,
                                       ControlMap& places);

}  // namespace limen::viewer
