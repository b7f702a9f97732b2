// SPDX-License-Identifier: BSD-3-Clause
// What a viewer sees change from frame to frame that should not: flicker, popping and swimming along a path
// of camera or light, beyond the reference's own change. The predictor compares each frame with the same
// frame as it would be had the product's error stayed what it was, on each surface, in the frame before:
//
//     expected = reference(now) + error(before), carried along by the camera's motion
//
// so that a product equal to the reference changes by nothing, an error that moves with its surface counts
// for nothing either, and an error that comes, goes or creeps over surfaces counts in the frame in which it
// does. The definition is this bench's own. Where a surface was not seen in the frame before, its error has
// changed from nothing that was seen, and does not count. Under a moving light an error that moves with a
// shadow creeps over the surfaces, and counts.
#include <algorithm>

#include "experiments/base/error.h"
#include "perception/metrics/jnd/jnd_figures.h"
#include "perception/metrics/metric_gpu.h"

namespace limen::perception {
namespace {

constexpr const char* kChangeName = "jnd_change";

struct ChangeSettings {
  JndSettings jnd;
  PathRequest path;
  static const SettingsTable<ChangeSettings>& table() {
    using S = ChangeSettings;
    static const SettingsTable<S> kTable = {included(&S::path), included(&S::jnd)};
    return kTable;
  }
};

std::vector<Quantity> changeQuantities() {
  std::vector<Quantity> all = jndQuantities("Visible change");
  all.emplace_back("step", "Step with the largest visible change", "", Direction::Neither);
  return all;
}

/// The largest of each figure, wherever on the path.
void include(JndFigures& worst, const JndFigures& step) {
  worst.medianJnd = std::max(worst.medianJnd, step.medianJnd);
  worst.p95Jnd = std::max(worst.p95Jnd, step.p95Jnd);
  worst.largestJnd = std::max(worst.largestJnd, step.largestJnd);
  worst.shareAbove1 = std::max(worst.shareAbove1, step.shareAbove1);
  worst.rating = std::max(worst.rating, step.rating);
  worst.detection = std::max(worst.detection, step.detection);
}

MetricResult measureChange(const ComparisonInput& input, const ChangeSettings& settings) {
  if (settings.jnd.region.region == Region::Reflectors)
    throw Error("metric 'jnd_change' does not know which pixels see mirrors along a path", {},
                "use region: all");
  const Comparison pair(input, kChangeName, settings.jnd.region.region);
  requireShown(input, kChangeName);
  if (!input.path) throw Error("metric 'jnd_change' needs frames of a scene", {}, "run it in a sweep");
  // Displacements are per step: the model takes them for those of one frame of its display.
  const auto* camera = std::get_if<CameraPath>(&settings.path.path);
  const double refreshHz = camera ? 1.0 / camera->stepS : 0.0;
  JndGpu& jnd = keptJndGpu(*input.gpu, kChangeName, settingsKey(settings), {pair.width(), pair.height()},
                           settings.jnd, refreshHz);
  MetricResult result;
  result.evaluatedPixels = pair.evaluatedPixels();
  result.map = Image(pair.width(), pair.height(), 1);
  result.mapName = kChangeName;
  JndFigures worst;
  int worstStep = 0;
  (*input.path)(settings.path, [&](int step, const PathFrame& before, const PathFrame& now) {
    jnd.runStep(before, now, input.depicts);
    const JndFigures figures = jnd.figures();
    const bool isWorst = figures.largestJnd > worst.largestJnd;
    if (step == 1) worst = figures;
    include(worst, figures);
    if (!isWorst) return;
    worstStep = step;
    result.map = jnd.readMap();
    result.pictures.clear();
    if (input.wantsPictures)
      result.pictures.push_back(regionPicture("jnd_change_regions", jnd.readActual(), jnd.readRegions()));
    if (!input.wantsLight) return;
    result.pictures.push_back({"jnd_change_shown", jnd.readActual(), false});
    result.pictures.push_back({"jnd_change_expected", jnd.readPredicted(), false});
  });
  result.value = worst.p95Jnd;
  result.figures = jndValues(worst);
  result.figures.push_back(worstStep);
  return result;
}

const RegisteredMetric<ChangeSettings> kChangeRegistered{
    {.name = kChangeName,
     .version = 2,
     .summary = "visible change from frame to frame of a path of camera or light beyond the reference's own "
                "(flicker, popping, swimming): the figures of jnd, each the largest of all steps",
     .source = "Schwarz 2009, section 10.3, for the model",
     .title = "Visible change, 95th percentile",
     .unit = "JND",
     .figures = changeQuantities(),
     .needsGl = true,
     .needsSurfaces = true,
     .needsPath = true},
    &measureChange};

}  // namespace
}  // namespace limen::perception
