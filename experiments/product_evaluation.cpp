// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/product_evaluation.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <future>

#include "experiments/base/hash.h"
#include "experiments/measured_quantities.h"
#include "experiments/measurement_name.h"
#include "perception/metrics/error_map.h"
#include "renderer/references/sampling_noise.h"
#include "renderer/techniques/technique.h"

namespace limen::experiments {

std::vector<store::Measurement> evaluate(const PlannedRun& run, const perception::ComparisonInput& input,
                                         MetricPictures& shown) {
  const references::SamplingNoise* noise =
      run.reference.name.empty() ? nullptr
                                 : references::SamplingNoiseRegistry::instance().find(run.reference.name);
  std::vector<store::Measurement> out;
  for (const Configuration& metric : run.metrics) {
    const perception::MetricInfo& info = perception::MetricRegistry::instance().get(metric.name);
    perception::MetricResult result = info.compare(input, metric.values);
    const std::vector<std::string> names =
        measurementNames(metric, run.metrics, info.parameters, info.figures);
    const auto store = [&](const std::string& name, double value, const Quantity& quantity) {
      out.push_back({name, std::isfinite(value) ? std::optional(value) : std::nullopt, quantity.unit,
                     quantity.direction == Direction::Neither ? "fact" : "error"});
    };
    if (info.figures.empty()) store(names[0], result.value, info.quantity());
    for (size_t i = 0; i < info.figures.size(); ++i) store(names[i], result.figures.at(i), info.figures[i]);
    if (info.averagesPixels && noise != nullptr && result.evaluatedPixels > 0)
      out.push_back({names[0] + kNoiseSuffix,
                     noiseOfDifference(noise->deviation(run.reference.values), result.evaluatedPixels),
                     info.unit, "fact"});
    const auto known = [](const auto& list, const std::string& name, auto nameOf) {
      return std::any_of(list.begin(), list.end(), [&](const auto& one) { return nameOf(one) == name; });
    };
    if (result.map && !known(shown.maps, result.mapName, [](const auto& map) { return map.first; }))
      shown.maps.emplace_back(result.mapName, std::move(*result.map));
    for (perception::MetricPicture& picture : result.pictures)
      if (!known(shown.pictures, picture.name, [](const auto& one) { return one.name; }))
        shown.pictures.push_back(std::move(picture));
  }
  return out;
}

std::vector<store::Artefact> writeArtefacts(const PlannedRun& run, const std::string& folder,
                                            const Image& product, const Image* reference,
                                            const Image& shading, const MetricPictures& shown,
                                            const std::map<std::string, techniques::PictureMaker>& views) {
  const std::string base = "artefacts/" + run.key.substr(0, 16) + "/";
  // In parallel: compressing one picture takes as long as many frames of a fast technique.
  std::vector<std::future<store::Artefact>> files;
  const auto picture = [&](const std::string& kind, std::function<Image()> make) {
    files.push_back(std::async(std::launch::async, [kind, make = std::move(make), base, folder] {
      const std::string file = base + kind + ".png";
      writePng(folder + "/" + file, make());
      return store::Artefact{kind + "_png", file, sha256File(folder + "/" + file)};
    }));
  };
  const auto exr = [&](const std::string& kind, const Image& image) {
    files.push_back(std::async(std::launch::async, [kind, &image, base, folder] {
      const std::string file = base + kind + ".exr";
      writeExr(folder + "/" + file, image);
      return store::Artefact{kind + "_exr", file, sha256File(folder + "/" + file)};
    }));
  };
  if (run.artefacts.pictures) {
    const techniques::ProductKind kind =
        techniques::TechniqueRegistry::instance().get(run.technique.name).product;
    picture("product", [kind, &product, &shading] { return productPicture(kind, product, shading); });
    if (reference)
      picture("reference", [kind, reference, &shading] { return productPicture(kind, *reference, shading); });
    for (const auto& [name, view] : views) picture("view_" + name, [&view = view] { return view(); });
  }
  if (run.artefacts.exr) {
    exr("product", product);
    if (reference) exr("reference", *reference);
  }
  for (const auto& [name, map] : shown.maps) {
    const std::string kind = name == "absolute_error" ? "error" : name;
    if (run.artefacts.pictures)
      picture(kind, [&name = name, &map = map] { return perception::errorPicture(map, mapWhite(name)); });
    if (run.artefacts.exr) exr(kind, map);
  }
  for (const perception::MetricPicture& one : shown.pictures) {
    if (one.coded)
      picture("view_" + one.name, [&one] { return one.image; });
    else
      exr(one.name, one.image);
  }
  std::vector<store::Artefact> out;
  for (std::future<store::Artefact>& file : files) out.push_back(file.get());
  return out;
}

}  // namespace limen::experiments
