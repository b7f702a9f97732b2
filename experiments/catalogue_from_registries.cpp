// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/catalogue.h"
#include "perception/metrics/metric.h"
#include "renderer/scene/scene.h"
#include "renderer/techniques/technique.h"

namespace limen::experiments {

Catalogue catalogueFromRegistries() {
  Catalogue out;
  for (const auto& [name, info] : scene::SceneRegistry::instance().all()) {
    CatalogueEntry& entry = out.scenes[name];
    entry.version = info.version;
    entry.summary = info.summary;
    entry.source = info.source;
    entry.parameters = info.allParameters();
    entry.check = [&info](const ParameterValues& complete) { info.checkValues(complete); };
  }
  for (const auto& [name, info] : techniques::TechniqueRegistry::instance().all()) {
    CatalogueEntry& entry = out.techniques[name];
    entry.version = info.version;
    entry.summary = info.summary;
    entry.source = info.source;
    entry.parameters = info.parameters;
    entry.product = techniques::toText(info.product);
    entry.needs = info.needs;
    entry.reference = info.reference;
    entry.onCpu = info.onCpu;
    for (const Quantity& counter : info.counters) entry.counters.push_back(counter.name);
    entry.check = info.check;
  }
  for (const auto& [name, info] : perception::MetricRegistry::instance().all()) {
    CatalogueEntry& entry = out.metrics[name];
    entry.version = info.version;
    entry.summary = info.summary;
    entry.source = info.source;
    entry.parameters = info.parameters;
    entry.unit = info.unit;
    entry.needsReference = info.needsReference;
  }
  out.measurements = {"gpu_ms",     "gpu_ms_p95", "technique_ms",     "wall_ms",      "cpu_ms",
                      "prepare_ms", "bytes_held", "non_finite_count", "gpu_clock_mhz"};
  return out;
}

}  // namespace limen::experiments
