// SPDX-License-Identifier: BSD-3-Clause
#include "study/stimulus/prediction.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "experiments/base/hash.h"
#include "perception/popping/comparator.h"
#include "perception/popping/input.h"
#include "perception/popping/predictor.h"
#include "perception/popping/weights.h"
#include "renderer/frame/g_buffer.h"
#include "renderer/frame/lod_pair.h"
#include "renderer/scene/lod_set.h"
#include "study/stimulus/cued_place.h"
#include "study/stimulus/state_view.h"
#include "study/stimulus/stimulus_renderer.h"

namespace limen::study {
namespace {

/// Light of a picture of `input` as the display shows it.
Image lightOf(const perception::PoppingInput& input, const Image& shown,
              const perception::DisplayProfile& display) {
  Image out(shown.width, shown.height, 3);
  for (int y = 0; y < out.height; ++y)
    for (int x = 0; x < out.width; ++x) {
      const std::array<double, 3> light = perception::pixelLight(input, shown, display, x, y);
      for (int c = 0; c < 3; ++c) out.at(x, y, c) = static_cast<float>(light[static_cast<size_t>(c)]);
    }
  return out;
}

/// Displacements and weights of a change in a moving view (Schwarz 2009, section 10.3.5). `shownBefore`: the
/// frame before the change as shown; empty: flicker, if any, is found in single samples.
void addMotion(perception::PoppingInput& input, const Image& shownBefore,
               const perception::DisplayProfile& display, frame::Frame& parent,
               const frame::LodPairSetting& pairSetting,
               const std::pair<scene::LodSelection, scene::LodSelection>& levels,
               const perception::PoppingSettings& settings) {
  frame::LodPair pair(parent, pairSetting);
  pair.setLevels(levels.first, levels.second);
  pair.render();
  const frame::LodPair::View &actual = pair.actual(), &predicted = pair.predicted();
  input.actualDisplacement = actual.displacement->read();
  input.predictedDisplacement = predicted.displacement->read();
  if (settings.usesDisocclusion()) {
    std::vector<perception::DisocclusionView> views;
    for (const frame::LodPair::View* view : {&actual, &predicted})
      views.push_back({view->previousDepth->read(), view->displacement->read(), view->depthBefore->read()});
    input.disocclusion = perception::disocclusionWeight(views, settings.disocclusionSettings());
  }
  // Flicker is that of the level before the change.
  if (!shownBefore.data.empty()) {
    const Image before = lightOf(input, input.predicted, display);
    input.flicker = perception::flickerWeight(
        {lightOf(input, input.actual, display), before, before, lightOf(input, shownBefore, display),
         predicted.displacement->read(), predicted.previousDepth->read(), predicted.depthBefore->read()},
        settings.flickerSettings());
  }
  if (pairSetting.previousColour)
    input.flicker = perception::flickerWeight(
        {actual.colour->read(), predicted.colour->read(), predicted.shadedBefore->read(),
         pair.previousColour()->read(), predicted.displacement->read(), predicted.previousDepth->read(),
         predicted.depthBefore->read()},
        settings.flickerSettings());
}

/// 1 where the window shows the object before or after the change.
Image objectMask(frame::Frame& frame, size_t object,
                 const std::pair<scene::LodSelection, scene::LodSelection>& levels) {
  Image mask(frame.sizePx().x, frame.sizePx().y, 1);
  for (const scene::LodSelection* selection : {&levels.first, &levels.second}) {
    const scene::TriangleRange range =
        frame.scene().triangles(frame.scene().lodObjects[object], selection->levels[object]);
    frame.setLevels(*selection);
    frame.begin();
    const std::vector<uint32_t> ids = frame.get<frame::TriangleIds>().texture().readUint();
    frame.end();
    for (size_t i = 0; i < ids.size(); ++i)
      if (ids[i] >= range.first && ids[i] - range.first < range.count) mask.data[i] = 1.0F;
  }
  return mask;
}

/// The highest rating among regions that are, or are not, what the question is about.
std::optional<double> highestRating(const std::vector<PredictedPopping::Region>& regions, bool atCue) {
  std::optional<double> out;
  for (const PredictedPopping::Region& region : regions)
    if (region.atCue == atCue) out = std::max(out.value_or(region.rating), region.rating);
  return out;
}

double ratingWithoutRegion(const perception::PoppingSettings& settings) {
  return perception::poppingRating(settings.regions.thresholdJnd, settings) - 1.0;
}

/// `out` has the figures of a sequence without region and, in any order, its regions.
void rate(PredictedPopping& out, bool cued, const perception::PoppingSettings& settings) {
  std::stable_sort(out.regions.begin(), out.regions.end(),
                   [](const auto& a, const auto& b) { return a.rating > b.rating; });
  if (cued) {
    const std::optional<double> rest = highestRating(out.regions, false);
    out.restRating = rest.value_or(out.rating);
    out.restDetectionProbability = rest ? settings.detection.probability(*rest) : out.detectionProbability;
  }
  if (const std::optional<double> asked = highestRating(out.regions, true)) {
    out.rating = *asked;
    out.detectionProbability = settings.detection.probability(*asked);
  }
}

}  // namespace

Predictor::Predictor(gl::Context& context, glm::ivec2 windowPx, const perception::DisplayProfile& display,
                     const ParameterValues& popping, PredictionCache* cache)
    : context_(context),
      windowPx_(windowPx),
      display_(display),
      popping_(perception::PoppingSettings::table().parameters(), popping.all(), "settings of the predictor"),
      cache_(cache ? *cache : own_) {
  perception::poppingModel(windowPx.x, windowPx.y, display_,
                           perception::PoppingSettings::table().read(popping_));
}

std::string Predictor::key(const Stimulus& stimulus) const {
  Stimulus decisive = stimulus;
  decisive.showings = 1;
  decisive.gapS = 0.0;
  decisive.cue.durationS = 0.0;
  const nlohmann::json all = {{"prediction", PredictedPopping::kVersion},
                              {"stimulus", stimulusHash(decisive)},
                              {"window_px", {windowPx_.x, windowPx_.y}},
                              {"display", display_.hash()},
                              {"popping", popping_.toJson()}};
  return sha256(all.dump());
}

PredictedPopping Predictor::withoutChange() const {
  const perception::PoppingSettings settings = perception::PoppingSettings::table().read(popping_);
  PredictedPopping out;
  out.rating = ratingWithoutRegion(settings);
  out.detectionProbability = settings.detection.guessRate;
  return out;
}

PredictedPopping Predictor::predict(const Stimulus& stimulus) {
  const Timeline timeline = timelineOf(stimulus, display_.refreshHz);
  if (timeline.changed == timeline.frames) {
    PredictedPopping none = withoutChange();
    rate(none, stimulus.cue.kind != Cue::Kind::None, perception::PoppingSettings::table().read(popping_));
    return none;
  }
  const std::string known = key(stimulus);
  if (const auto found = cache_.find(known)) return *found;
  const PredictedPopping made = make(stimulus);
  cache_.add(known, made);
  return made;
}

PredictedPopping Predictor::make(const Stimulus& stimulus) {
  const perception::PoppingSettings settings = perception::PoppingSettings::table().read(popping_);
  StimulusRenderer renderer(context_, stimulus, windowPx_, display_, &scenes_);
  const double timeS = renderer.timeline().changeSceneTimeS;
  perception::PoppingInput input;
  input.isSwitch = true;
  input.actual = renderer.readBackState(timeS, true);
  input.predicted = renderer.readBackState(timeS, false);

  const scene::Scene& scene = renderer.scene().scene;
  const scene::LodSelection finest = scene::finestLevels(scene);
  const auto levels = stimulus.levels
                          ? std::pair{levelsOf(scene, *stimulus.levels, true, timeS, windowPx_.y),
                                      levelsOf(scene, *stimulus.levels, false, timeS, windowPx_.y)}
                          : std::pair{finest, finest};
  frame::Frame frame(context_, renderer.scene(), windowPx_, timeS);
  if (stimulus.presentation == Presentation::Dynamic) {
    frame::LodPairSetting pair;
    pair.dtS = 1.0 / display_.refreshHz;
    pair.shaded = shadingOf(stimulus);
    const bool usesFlicker = settings.usesFlicker() && stimulus.levels.has_value();
    // Highlights depend on the eye: shading as the previous frame saw it is known at single samples only.
    pair.previousColour = usesFlicker && pair.shaded.specular > 0.0;
    Image shownBefore;
    if (usesFlicker && !pair.previousColour) shownBefore = renderer.readBackState(timeS - pair.dtS, false);
    frame.begin();
    addMotion(input, shownBefore, display_, frame, pair, levels, settings);
    frame.end();
  }
  const perception::PoppingResult result = perception::predictPopping(input, display_, settings);

  PredictedPopping out = withoutChange();
  const bool cued = stimulus.cue.kind != Cue::Kind::None;
  frame.setLevels(levels.second);
  const std::optional<CuedPlace> place = cuedPlace(frame, stimulus, renderer.timeline(), display_);
  const std::set<uint32_t> asked = place ? regionsAt(result.regions, *place) : std::set<uint32_t>();
  for (const perception::PoppingRegion& region : result.regions.regions) {
    out.regions.push_back({region.sizePx, region.sigma, region.rating, region.largestJnd,
                           region.detectionProbability, region.least, region.most,
                           !cued || asked.count(region.label) > 0});
    out.poppingPx += region.sizePx;
  }
  rate(out, cued, settings);
  out.coverage = result.summary.coverage;
  out.coverageOfObject =
      stimulus.levels
          ? result.regions.coverageOf(objectMask(frame, static_cast<size_t>(stimulus.levels->object), levels))
          : out.coverage;
  out.largestJnd = result.summary.largestJnd;
  out.largestDe94 = perception::largestColourDifference(input, display_).value;
  return out;
}

}  // namespace limen::study
