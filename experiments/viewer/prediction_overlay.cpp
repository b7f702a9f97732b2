// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/viewer/prediction_overlay.h"

#include <algorithm>
#include <cmath>

#include "experiments/base/error.h"
#include "experiments/product.h"
#include "experiments/viewer/number_text.h"
#include "perception/metrics/error_map.h"
#include "perception/popping/overlay.h"
#include "perception/popping/predictor.h"
#include "perception/threshold_maps/reference.h"
#include "perception/thresholds/thresholds.h"

namespace limen::viewer {
namespace {

/// Light of a display-coded picture, as the display emits it.
Image lightOf(Image coded, const perception::DisplayProfile& display) {
  for (float& value : coded.data) value = static_cast<float>(display.decode(value));
  return coded;
}

void paintThresholds(const Image& picture, const EvaluationRequest& request, EvaluationResult& result) {
  perception::ThresholdSettings settings;
  if (request.overlay == Overlay::SingleThresholds) settings = perception::ThresholdMapSettings{};
  const perception::Thresholds made = perception::computeThresholds(
      perception::luminancePlane(lightOf(picture, request.display), request.display), request.display,
      settings);
  const Image thresholds = perception::toImage(made.thresholdCdM2);
  result.overlay = std::make_shared<ScreenPicture>(screenPicture(perception::thresholdPicture(thresholds)));
  const auto [least, most] = std::minmax_element(thresholds.data.begin(), thresholds.data.end());
  result.overlayNote = (request.overlay == Overlay::SingleThresholds ? "single threshold map, "
                                                                     : "thresholds of all bands, ") +
                       numberText(*least) + " to " + numberText(*most) + " cd/m2 on " + request.display.name;
}

void paintPopping(const Image& actual, const Image& before, const EvaluationRequest& request,
                  EvaluationResult& result) {
  perception::PoppingInput input;
  input.actual = actual;
  input.predicted = before;
  input.isSwitch = true;
  const perception::PoppingResult popping = perception::predictPopping(input, request.display);
  perception::OverlayOptions options;
  options.legend = false;
  result.overlay = std::make_shared<ScreenPicture>(
      screenPicture(perception::poppingOverlay(actual, popping.regions, options)));
  const perception::PoppingSummary& summary = popping.summary;
  result.overlayNote =
      popping.regions.regions.empty()
          ? "no popping region"
          : std::to_string(popping.regions.regions.size()) + " popping regions, " +
                numberText(std::round(1000.0 * summary.coverage) / 10.0) + " % of the picture, largest R " +
                numberText(std::round(100.0 * summary.largestRating) / 100.0) + ", " +
                numberText(std::round(100.0 * summary.detectionProbability)) + " % would see it";
  result.overlayNote += " on " + request.display.name;
}

}  // namespace

bool overlayNeedsReference(const EvaluationRequest& request) {
  return request.overlay == Overlay::Popping && !request.second;
}

void paintOverlay(const EvaluationRequest& request, EvaluationResult& result) {
  result.overlayKind = request.overlay;
  if (request.overlay == Overlay::None || !request.product || !request.view) return;
  try {
    const auto pictureOf = [&](const Image& product) {
      return experiments::productPicture(request.kind, product, request.view->shading);
    };
    const Image picture = pictureOf(*request.product);
    if (isThresholds(request.overlay)) {
      paintThresholds(picture, request, result);
      return;
    }
    const Image* before = request.second ? request.second.get() : result.reference.get();
    if (!before) throw Error("popping needs two pictures", {}, "choose a second technique or a reference");
    paintPopping(picture, pictureOf(*before), request, result);
  } catch (const std::exception& error) {
    result.overlayNote = error.what();
  }
}

}  // namespace limen::viewer
