// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "experiments/base/parameter.h"
#include "experiments/base/quantity.h"

namespace limen {

/// What a descriptor or protocol may say about one registered scene, technique or metric.
struct CatalogueEntry {
  int version = 1;
  std::string summary = {}, source = {};
  std::vector<Parameter> parameters = {};
  std::function<void(const ParameterValues&)> check = {};  ///< throws Error if values conflict; null: none do

  // Techniques only.
  std::string product = {};             ///< kind of the product; only equal kinds can be compared
  std::vector<std::string> needs = {};  ///< scene traits
  bool reference = false;               ///< a reference to compare with
  bool onCpu = false;
  std::vector<Quantity> counters = {};  ///< what its runs may measure besides the common quantities

  // Metrics only.
  Quantity quantity = "";              ///< what it measures
  std::vector<Quantity> figures = {};  ///< if it measures several things (MetricInfo::figures)
  bool needsReference = true;
  /// Of a technique: it makes tessellated surfaces; of a metric: it evaluates them.
  bool tessellates = false, needsTessellation = false;
};

using CatalogueKind = std::map<std::string, CatalogueEntry>;

/// Everything that descriptors and protocols can name. Readers and plans depend on this alone, so that files
/// can be checked without a GL context and without the code behind the names.
struct Catalogue {
  CatalogueKind scenes, techniques, metrics;
  /// What a stimulus that switches levels of detail declares about its shading.
  std::vector<Parameter> shading;
};

/// Names of one kind, sorted.
std::vector<std::string> names(const CatalogueKind& kind);
/// The counters of the given techniques, each name once.
std::vector<std::string> counterNames(const Catalogue& catalogue, const std::vector<std::string>& techniques);

}  // namespace limen
