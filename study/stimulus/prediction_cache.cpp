// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "experiments/base/error.h"
#include "experiments/base/replace_file.h"
#include "study/stimulus/prediction.h"

namespace limen::study {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

constexpr int kForm = 2;

json pair(glm::ivec2 value) { return {value.x, value.y}; }
glm::ivec2 pairFromJson(const json& object) { return {object.at(0).get<int>(), object.at(1).get<int>()}; }

std::map<std::string, PredictedPopping> readCache(const std::string& file) {
  std::map<std::string, PredictedPopping> out;
  if (file.empty() || !fs::exists(file)) return out;
  try {
    std::ifstream stream(file);
    const json all = json::parse(stream);
    if (all.at("limen_predictions").get<int>() != kForm)
      throw Error("predictions in another format", file, "name another file");
    for (const auto& [key, value] : all.at("predictions").items()) out[key] = predictedPoppingFromJson(value);
  } catch (const json::exception& error) {
    throw Error(std::string("not a file of predictions: ") + error.what(), file,
                "name another file, or delete this one");
  }
  return out;
}

void writeCache(const std::string& file, const std::map<std::string, PredictedPopping>& known) {
  json predictions = json::object();
  for (const auto& [key, value] : known) predictions[key] = toJson(value);
  replaceFile(file, json{{"limen_predictions", kForm}, {"predictions", predictions}}.dump(1) + "\n");
}

}  // namespace

json toJson(const PredictedPopping& prediction) {
  json regions = json::array();
  for (const PredictedPopping::Region& region : prediction.regions)
    regions.push_back({{"size_px", region.sizePx},
                       {"sigma_jnd", region.sigmaJnd},
                       {"rating", region.rating},
                       {"largest_jnd", region.largestJnd},
                       {"detection_probability", region.detectionProbability},
                       {"least_px", pair(region.leastPx)},
                       {"most_px", pair(region.mostPx)},
                       {"at_cue", region.atCue}});
  json out = {{"rating", prediction.rating},
              {"detection_probability", prediction.detectionProbability},
              {"regions", regions},
              {"popping_px", prediction.poppingPx},
              {"coverage", prediction.coverage},
              {"coverage_of_object", prediction.coverageOfObject},
              {"largest_jnd", prediction.largestJnd},
              {"max_de94", prediction.largestDe94}};
  if (prediction.restRating) out["rest_rating"] = *prediction.restRating;
  if (prediction.restDetectionProbability)
    out["rest_detection_probability"] = *prediction.restDetectionProbability;
  return out;
}

PredictedPopping predictedPoppingFromJson(const json& object) {
  PredictedPopping out;
  out.rating = object.at("rating").get<double>();
  out.detectionProbability = object.at("detection_probability").get<double>();
  for (const json& region : object.at("regions"))
    out.regions.push_back({region.at("size_px").get<int64_t>(), region.at("sigma_jnd").get<double>(),
                           region.at("rating").get<double>(), region.at("largest_jnd").get<double>(),
                           region.at("detection_probability").get<double>(),
                           pairFromJson(region.at("least_px")), pairFromJson(region.at("most_px")),
                           region.at("at_cue").get<bool>()});
  out.poppingPx = object.at("popping_px").get<int64_t>();
  out.coverage = object.at("coverage").get<double>();
  out.coverageOfObject = object.at("coverage_of_object").get<double>();
  out.largestJnd = object.at("largest_jnd").get<double>();
  out.largestDe94 = object.at("max_de94").get<double>();
  const auto optional = [&](const char* name) {
    const auto found = object.find(name);
    return found == object.end() ? std::nullopt : std::optional<double>(found->get<double>());
  };
  out.restRating = optional("rest_rating");
  out.restDetectionProbability = optional("rest_detection_probability");
  return out;
}

bool PredictedPopping::popsAtCue() const {
  return std::any_of(regions.begin(), regions.end(), [](const Region& region) { return region.atCue; });
}

bool PredictedPopping::operator==(const PredictedPopping& other) const {
  return toJson(*this) == toJson(other);
}

PredictionCache::PredictionCache(std::string file) : file_(std::move(file)), known_(readCache(file_)) {}

std::optional<PredictedPopping> PredictionCache::find(const std::string& key) const {
  const auto found = known_.find(key);
  if (found == known_.end()) return std::nullopt;
  return found->second;
}

void PredictionCache::add(const std::string& key, const PredictedPopping& prediction) {
  known_[key] = prediction;
  if (file_.empty()) return;
  known_.merge(readCache(file_));
  writeCache(file_, known_);
}

}  // namespace limen::study
