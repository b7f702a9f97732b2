// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/describe_names.h"

#include <algorithm>
#include <set>

#include "experiments/base/text.h"
#include "experiments/measured_quantities.h"
#include "experiments/measurement_name.h"

namespace limen::experiments {
namespace {

// A parameter of an alternative or a group names its parent: "Budget: rim".
std::string titleAt(const Parameter& parameter, const std::string& owner) {
  if (owner.empty())
    return parameter.title.empty() ? titleFromName(parameter.name, parameter.unit) : parameter.title;
  return owner + ": " + (parameter.title.empty() ? wordsOf(parameter.name, parameter.unit) : parameter.title);
}

class Describer {
 public:
  Describer(const Descriptor& descriptor, const Catalogue& catalogue)
      : descriptor_(descriptor), catalogue_(catalogue) {}

  store::Descriptions describe() {
    for (const store::QuantityRow& row : commonQuantities()) add(row);
    addMetrics();
    for (const Entry& entry : descriptor_.techniques) addCounters(catalogue_.techniques.at(entry.name));

    for (const Entry& entry : descriptor_.techniques)
      addParameters("technique", entry.name, catalogue_.techniques);
    for (const Entry& entry : descriptor_.scenes) addParameters("scene", entry.name, catalogue_.scenes);
    if (descriptor_.reference) addParameters("reference", descriptor_.reference->name, catalogue_.techniques);
    for (const Configuration& metric : descriptor_.metrics)
      addParameters("metric", metric.name, catalogue_.metrics);
    for (const char* side : {"width", "height"}) {
      store::ParameterRow row;
      row.subject = "image";
      row.path = side;
      row.title = std::string("Image ") + side;
      row.unit = "px";
      row.type = describeType(ParameterType::Integer);
      row.description = std::string("Image ") + side;
      out_.parameters.push_back(row);
    }
    return std::move(out_);
  }

 private:
  void add(const store::QuantityRow& row) {
    if (out_.quantity(row.name) == nullptr) out_.quantities.push_back(row);
  }

  void addMetrics() {
    for (const Configuration& metric : descriptor_.metrics) {
      const CatalogueEntry& entry = catalogue_.metrics.at(metric.name);
      const std::vector<std::string> names =
          measurementNames(metric, descriptor_.metrics, entry.parameters, entry.figures);
      for (size_t i = 0; i < names.size(); ++i) {
        const Quantity& quantity = entry.figures.empty() ? entry.quantity : entry.figures[i];
        // A metric that declares neither its own name nor a title goes by its registered name.
        const std::string title =
            quantity.title.empty() ? titleFromName(metric.name, quantity.unit) : quantity.title;
        const std::string full = measurementTitle(title, metric, descriptor_.metrics, entry.parameters);
        add({names[i], full, quantity.unit, quantity.direction,
             quantity.direction == Direction::Neither ? "fact" : "error", "", entry.source});
        if (!descriptor_.reference || !entry.figures.empty()) continue;
        add({names[i] + kNoiseSuffix, full + ", noise of the reference", quantity.unit, Direction::Neither,
             "fact", "", "95 % bound on a difference of two runs; docs/analyse.md"});
      }
    }
  }

  void addCounters(const CatalogueEntry& technique) {
    for (const Quantity& counter : technique.counters)
      add({counter.name, titleOf(counter), counter.unit, counter.direction,
           counter.direction == Direction::Neither ? "fact" : "counter", "", counter.source});
  }

  void addParameters(const std::string& subject, const std::string& owner, const CatalogueKind& kind) {
    if (!seen_.insert(subject + " " + owner).second) return;
    addParameters(subject, owner, kind.at(owner).parameters, "", "", nlohmann::json::object());
  }

  void addParameters(const std::string& subject, const std::string& owner,
                     const std::vector<Parameter>& declared, const std::string& prefix,
                     const std::string& titlePrefix, const nlohmann::json& when) {
    for (const Parameter& parameter : declared) {
      store::ParameterRow row;
      row.subject = subject;
      row.owner = owner;
      row.path = joinPath(prefix, parameter.name);
      row.when = when;
      row.title = titleAt(parameter, titlePrefix);
      row.unit = parameter.unit;
      row.type = describeType(parameter.type);
      if (!parameter.required) row.defaultValue = toText(parameter.defaultValue);
      row.description = parameter.description;
      row.source = parameter.source;
      const bool group = parameter.type == ParameterType::Group;
      if (!group) out_.parameters.push_back(row);
      for (const Alternative& alternative : parameter.alternatives) {
        nlohmann::json inner = when;
        if (!group) inner[row.path] = alternative.name;
        addParameters(subject, owner, alternative.parameters, row.path, row.title, inner);
      }
    }
  }

  const Descriptor& descriptor_;
  const Catalogue& catalogue_;
  store::Descriptions out_;
  std::set<std::string> seen_;
};

}  // namespace

store::Descriptions describeNames(const Descriptor& descriptor, const Catalogue& catalogue) {
  return Describer(descriptor, catalogue).describe();
}

}  // namespace limen::experiments
