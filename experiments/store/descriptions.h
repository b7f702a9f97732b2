// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "experiments/base/quantity.h"

namespace limen::store {

/// What a measured name means: a row of table `quantity`.
struct QuantityRow {
  std::string name;
  std::string title;  ///< as an axis label, without the unit
  std::string unit;
  std::optional<Direction> direction;  ///< nullopt: unknown; only in stores written before schema 3
  std::string kind;                    ///< as Measurement::kind
  std::string pass;                    ///< the FrameTime::pass whose median it is; "": none
  std::string source;

  friend bool operator==(const QuantityRow&, const QuantityRow&) = default;
};

/// What a parameter means: a row of table `parameter`.
struct ParameterRow {
  std::string subject;  ///< technique, scene, reference, metric or image: its object in Run::parameters
  std::string owner;    ///< registered name; "" for images
  std::string path;     ///< "budget.rim": its key in that object
  nlohmann::json when = nlohmann::json::object();  ///< choices under which it exists: {"budget": "radial"}
  std::string title;                               ///< as an axis label, without the unit
  std::string unit;
  std::string type;  ///< describeType(): "number", "choice", ...
  std::string defaultValue, description, source;

  friend bool operator==(const ParameterRow&, const ParameterRow&) = default;
};

/// What the names in an experiment's runs mean.
struct Descriptions {
  std::vector<QuantityRow> quantities;
  std::vector<ParameterRow> parameters;

  /// Null if there is none with that name.
  const QuantityRow* quantity(const std::string& name) const;

  friend bool operator==(const Descriptions&, const Descriptions&) = default;
};

/// What was measured under this name before stores described themselves. For names not in the table the title
/// is the name's words and the direction is unknown.
QuantityRow formerQuantity(const std::string& name, const std::string& unit, const std::string& kind);

}  // namespace limen::store
