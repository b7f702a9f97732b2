// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "experiments/base/parameter.h"
#include "experiments/base/quantity.h"
#include "experiments/store/descriptions.h"

namespace limen::experiments {

/// What a descriptor may say about one registered scene, technique or metric.
struct CatalogueEntry {
  int version = 1;
  std::string summary, source;
  std::vector<Parameter> parameters;
  std::function<void(const ParameterValues&)>
      check;  ///< throws Error if values do not go together; null: all do

  // Techniques only.
  std::string product;             ///< kind of the product; only equal kinds can be compared
  std::vector<std::string> needs;  ///< scene traits
  bool reference = false;          ///< made to be compared with
  bool onCpu = false;
  std::vector<Quantity> counters;  ///< what its runs may have beside the common measurements

  // Metrics only.
  std::string title;  ///< as Quantity::title
  std::string unit;
  Direction direction = Direction::LowerIsBetter;
  bool needsReference = true;
};

using CatalogueKind = std::map<std::string, CatalogueEntry>;

/// Everything that descriptors can name. Descriptors and plans depend on this alone, so they are checked
/// without a GL context and without the code behind the names.
struct Catalogue {
  CatalogueKind scenes, techniques, metrics;
  /// Values that every run has whatever its metrics ("gpu_ms"): expectations and report axes may name them.
  std::vector<store::QuantityRow> measurements;
};

/// Names of one kind, sorted.
std::vector<std::string> names(const CatalogueKind& kind);
/// Names of the values that every run has.
std::vector<std::string> measurementNames(const Catalogue& catalogue);
/// What the given techniques count, each name once.
std::vector<std::string> counterNames(const Catalogue& catalogue, const std::vector<std::string>& techniques);

/// The registries' contents.
Catalogue catalogueFromRegistries();

/// Text for `--list WHAT`: "" (everything, one line each), "scenes", "techniques", "metrics", or the name of
/// an entry (its parameters too). Throws Error on another name.
std::string describe(const Catalogue& catalogue, const std::string& what);
nlohmann::json describeAsJson(const Catalogue& catalogue, const std::string& what);

}  // namespace limen::experiments
