// SPDX-License-Identifier: BSD-3-Clause
#include "study/observers/popping_model.h"

#include <map>
#include <nlohmann/json.hpp>

#include "perception/popping/settings.h"
#include "renderer/gl/context.h"
#include "study/stimulus/prediction.h"

namespace limen::study {
namespace {

class PoppingModel : public StimulusModel {
 public:
  PoppingModel(const Protocol& protocol, const perception::DisplayProfile& display,
               const std::map<std::string, ParameterValue>& popping, const std::string& cacheFile)
      : protocol_(protocol),
        display_(display),
        popping_(perception::PoppingSettings::table().parameters(), popping, "settings of the predictor"),
        cache_(cacheFile) {}

  StimulusPrediction predict(const Trial& trial, const Variables& axes, size_t which) override {
    // Looking up a stimulus by its own hash would cost more than the rest of a simulated trial.
    std::string key = std::to_string(trial.plan.part) + (trial.plan.change ? " change " : " catch ") +
                      std::to_string(trial.plan.target) + " " + std::to_string(which) + " ";
    key += nlohmann::json(trial.plan.condition).dump() + nlohmann::json(trial.plan.variables).dump() +
           nlohmann::json(axes).dump();
    const auto found = known_.find(key);
    if (found != known_.end()) return found->second;
    const std::vector<Stimulus> stimuli =
        trial.stimuli.empty() ? stimuliOf(protocol_, trial.plan, axes) : trial.stimuli;
    if (!predictor_) {
      context_ = gl::createHeadlessContext();
      predictor_ = std::make_unique<Predictor>(
          *context_, glm::ivec2(protocol_.window.widthPx, protocol_.window.heightPx), display_, popping_,
          &cache_);
    }
    const PredictedPopping popping = predictor_->predict(stimuli.at(which));
    const StimulusPrediction out{popping.rating, popping.popsAtCue()};
    known_.emplace(key, out);
    return out;
  }

 private:
  const Protocol& protocol_;
  perception::DisplayProfile display_;
  ParameterValues popping_;
  PredictionCache cache_;
  std::unique_ptr<gl::Context> context_;  // outlives what was made in it
  std::unique_ptr<Predictor> predictor_;
  std::map<std::string, StimulusPrediction> known_;
};

}  // namespace

std::unique_ptr<StimulusModel> makePoppingModel(const Protocol& protocol,
                                                const perception::DisplayProfile& display,
                                                const std::map<std::string, ParameterValue>& popping,
                                                const std::string& cacheFile) {
  return std::make_unique<PoppingModel>(protocol, display, popping, cacheFile);
}

}  // namespace limen::study
