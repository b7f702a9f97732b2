// SPDX-License-Identifier: BSD-3-Clause
// Whether a viewer can tell a product from the reference: the popping predictor on both as a display shows
// them, with nothing moving, as `limen perceive compare` does for image files. Visibility and light colour
// are shown on the scene's surfaces, the same for both. Pixel figures are over the region that other metrics
// evaluate; rating and detection are of the whole picture, as regions do not end where a mask does. Whatever
// changes the predictor's output raises the versions of both JND metrics.
#include <optional>

#include "perception/metrics/jnd/jnd_figures.h"
#include "perception/metrics/metric_gpu.h"
#include "perception/metrics/metric_texture.h"

namespace limen::perception {
namespace {

constexpr const char* kJndName = "jnd";

MetricResult measureJnd(const ComparisonInput& input, const JndSettings& settings) {
  const Comparison pair(input, kJndName, settings.region.region);
  requireShown(input, kJndName);
  JndGpu& jnd =
      keptJndGpu(*input.gpu, kJndName, settingsKey(settings), {pair.width(), pair.height()}, settings);
  std::optional<gl::Texture> test, reference;
  if (!input.testTexture) test.emplace(metricTexture(*input.test));
  if (!input.referenceTexture) reference.emplace(metricTexture(*input.reference));
  PathFrame frame;
  frame.test = test ? &*test : input.testTexture;
  frame.reference = reference ? &*reference : input.referenceTexture;
  frame.mask = jnd.upload(settings.region.region == Region::Reflectors ? input.mirrors : input.mask);
  if (input.surfaces) frame.surfaces = *input.surfaces;
  jnd.run(frame, input.depicts);

  MetricResult result;
  const JndFigures figures = jnd.figures();
  result.value = figures.p95Jnd;
  result.figures = jndValues(figures);
  result.evaluatedPixels = pair.evaluatedPixels();
  result.map = jnd.readMap();
  result.mapName = kJndName;
  if (input.wantsPictures)
    result.pictures.push_back(regionPicture("jnd_regions", jnd.readActual(), jnd.readRegions()));
  if (input.wantsLight) {
    result.pictures.push_back({"jnd_shown", jnd.readActual(), false});
    result.pictures.push_back({"jnd_shown_reference", jnd.readPredicted(), false});
  }
  return result;
}

const RegisteredMetric<JndSettings> kJndRegistered{
    {.name = kJndName,
     .version = 2,
     .summary =
         "visible difference on a display, by the popping predictor: median, 95th percentile, largest, "
         "share of pixels above 1 JND, rating, probability of detection",
     .source = "Schwarz 2009, section 10.3",
     .title = "Visible difference, 95th percentile",
     .unit = "JND",
     .figures = jndQuantities("Visible difference"),
     .needsGl = true,
     .needsSurfaces = true},
    &measureJnd};

}  // namespace
}  // namespace limen::perception
