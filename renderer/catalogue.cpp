// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/catalogue.h"

#include "perception/metrics/metric.h"
#include "renderer/frame/shaded.h"
#include "renderer/scene/scene.h"
#include "renderer/techniques/technique.h"

namespace limen {

namespace {

Catalogue readRegistries() {
  Catalogue out;
  for (const auto& [name, info] : scene::SceneRegistry::instance().all()) {
    CatalogueEntry& entry = out.scenes[name];
    entry.version = info.version;
    entry.summary = info.summary;
    entry.source = info.source;
    entry.parameters = info.allParameters();
    entry.check = [&scene = info](const ParameterValues& complete) { scene.checkValues(complete); };
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
    entry.tessellates = info.tessellates;
    entry.counters = info.counters;
    entry.check = info.check;
  }
  for (const auto& [name, info] : perception::MetricRegistry::instance().all()) {
    CatalogueEntry& entry = out.metrics[name];
    entry.version = info.version;
    entry.summary = info.summary;
    entry.source = info.source;
    entry.parameters = info.parameters;
    entry.quantity = info.quantity();
    entry.figures = info.figures;
    entry.needsReference = info.needsReference;
    entry.needsTessellation = info.needsTessellation;
  }
  out.shading = frame::ShadedSetting::table().parameters();
  return out;
}

}  // namespace

std::shared_ptr<const Catalogue> catalogueFromRegistries() {
  static const auto kCatalogue = std::make_shared<const Catalogue>(readRegistries());
  return kCatalogue;
}

}  // namespace limen
