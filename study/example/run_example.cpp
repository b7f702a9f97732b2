// SPDX-License-Identifier: BSD-3-Clause
#include "study/example/run_example.h"
#include "renderer/catalogue.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>

#include "experiments/base/build_facts.h"
#include "experiments/base/catalogue.h"
#include "experiments/base/error.h"
#include "experiments/base/hash.h"
#include "experiments/base/replace_file.h"
#include "experiments/base/text.h"
#include "perception/popping/settings.h"
#include "perception/vision/display.h"
#include "study/example/sibling.h"
#include "study/observers/popping_model.h"
#include "study/observers/simulate.h"
#include "study/stimulus/store_predictions.h"

namespace limen::study {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

std::string readText(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  std::ostringstream out;
  out << stream.rdbuf();
  return out.str();
}

class ExampleRun {
 public:
  ExampleRun(const Example& example, const ExampleRequest& request)
      : example_(example), request_(request), analyse_(siblingProgram("limen-analyse")) {}

  ExampleEnd run() {
    std::error_code failed;
    fs::create_directories(request_.folder, failed);
    if (failed) throw Error("cannot create the folder: " + failed.message(), request_.folder);
    // All protocols are read before anything is simulated.
    const auto catalogue = catalogueFromRegistries();
    std::vector<Protocol> protocols;
    for (const ExampleStudy& study : example_.studies) protocols.push_back(protocolOf(study, catalogue));
    for (size_t i = 0; i < protocols.size(); ++i)
      if (!simulate(example_.studies[i], protocols[i])) return stopped();
    for (size_t i = 0; i < protocols.size(); ++i)
      if (!predict(example_.studies[i])) return stopped();
    for (const ExampleStudy& study : example_.studies) analyse(study);
    compare();
    summarise(protocols);
    return std::move(end_);
  }

 private:
  std::string file(const std::string& name) const {
    // Programs that are given the name must not take it for an option.
    const std::string path = (fs::path(request_.folder) / name).string();
    return path.starts_with("-") ? "./" + path : path;
  }
  std::string storeOf(const ExampleStudy& study) const { return file(study.name + ".sqlite"); }
  /// Of one build: other builds may predict differently.
  std::string cacheOf(const ExampleStudy& study) const {
    return file(study.name + ".predictions-" + buildCommit() + ".json");
  }
  ExampleEnd stopped() {
    end_.stopped = true;
    return std::move(end_);
  }

  bool simulate(const ExampleStudy& study, const Protocol& protocol) {
    request_.say(fmt::format("{}: {} observers of kind '{}' answer {}", study.name, study.observers,
                             study.observer.name, protocol.name));
    SimulationRequest request;
    request.store = storeOf(study);
    request.observers = study.observers;
    request.seed = study.seed;
    request.observer = study.observer;
    request.display = perception::readDisplay(study.display.empty() ? protocol.display : study.display);
    request.progress = [this, &study](int64_t trials, int done) {
      return request_.progress(fmt::format("{} of {} observers, {} screens and trials in this call", done,
                                           study.observers, trials));
    };
    std::unique_ptr<StimulusModel> model;
    if (study.observer.behaviour.fromModel || Simulation(protocol).needsModel())
      model = makePoppingModel(protocol, request.display, study.observer.behaviour.popping, cacheOf(study));
    return !simulateSessions(protocol, request, model.get()).stopped;
  }

  bool predict(const ExampleStudy& study) {
    if (!study.predictions) return true;
    request_.say(study.name + ": predictions for the stimuli");
    StorePredictionRequest request;
    request.store = storeOf(study);
    // What observers saw with, if they saw with it.
    request.popping = ParameterValues(perception::PoppingSettings::table().parameters(),
                                      study.observer.behaviour.popping, "predictor");
    request.cacheFile = cacheOf(study);
    request.progress = [this](int done, int all) {
      request_.progress(fmt::format("{} of {} stimuli", done, all));
    };
    return !predictStore(request).stopped;
  }

  void analyse(const ExampleStudy& study) {
    for (const std::string& analysis : example_.analyses) {
      if (analysis == "validate" && !study.predictions) continue;
      const std::string name = study.name + "_" + analysis;
      request_.say(study.name + ": limen analyse " + analysis);
      if (analysis == "report") {
        const SiblingEnd end = runSibling({analyse_, analysis, storeOf(study), "-o", file(name)});
        if (end.status != 0) end_.notes.push_back(study.name + ": no page: " + end.message);
        continue;
      }
      call({analysis, storeOf(study), "--json", "--csv", file(name + ".csv")}, name + ".json");
    }
  }

  /// A call of limen-analyse that must not fail.
  void call(std::vector<std::string> words, const std::string& output) {
    const std::string command = words.front();
    words.insert(words.begin(), analyse_);
    const SiblingEnd end = runSibling(words, file(output));
    if (end.status != 0)
      throw Error(fmt::format("limen analyse {} ended with {}: {}", command, end.status, end.message),
                  words[2]);
  }

  void compare() {
    request_.say("limen analyse published");
    std::vector<std::string> words = {analyse_, "published"};
    for (const ExampleStudy& study : example_.studies) words.push_back(storeOf(study));
    const std::string tablesFile = file("comparison.json.tmp"), text = file("comparison.txt.tmp");
    const SiblingEnd end = runSibling(words, text);
    if (end.status != 0) {
      end_.notes.push_back("no comparison: " + end.message);
      return;
    }
    words.insert(words.end(), {"--json", "--csv", file("comparison.csv")});
    const SiblingEnd tables = runSibling(words, tablesFile);
    if (tables.status != 0) throw Error("limen analyse published: " + tables.message, request_.folder);
    comparison_ = json::parse(readText(tablesFile));
    comparisonText_ = "\n" + readText(text);
    fs::remove(tablesFile);
    fs::remove(text);
  }

  void summarise(const std::vector<Protocol>& protocols) {
    json summary = {{"example", example_.name},
                    {"title", example_.title},
                    {"question", example_.question},
                    {"source", example_.source},
                    {"features", example_.features},
                    {"descriptor_hash", sha256(example_.text)},
                    {"program_version", projectVersion() + " (commit " + buildCommit() + ")"},
                    {"studies", json::array()},
                    {"notes", end_.notes},
                    {"comparison", comparison_}};
    std::string out = example_.title + "\n" + example_.question + "\n\n";
    for (size_t i = 0; i < protocols.size(); ++i) {
      const ExampleStudy& study = example_.studies[i];
      const WindowSetting& window = protocols[i].window;
      summary["studies"].push_back({{"name", study.name},
                                    {"store", study.name + ".sqlite"},
                                    {"protocol", protocols[i].name},
                                    {"protocol_hash", protocols[i].hash},
                                    {"display", study.display.empty() ? protocols[i].display : study.display},
                                    {"window_px", {window.widthPx, window.heightPx}},
                                    {"own_window", study.windowPx.has_value()},
                                    {"observer", toJson(study.observer)},
                                    {"observers", study.observers},
                                    {"seed", study.seed},
                                    {"predictions", study.predictions}});
      out += fmt::format(
          "{}: {} simulated observers of kind '{}', seed {}, window {} x {} px{}\n", study.name,
          study.observers, study.observer.name, study.seed, window.widthPx, window.heightPx,
          study.windowPx ? ", not the protocol's: stimuli look different from those it specifies" : "");
    }
    for (const std::string& note : end_.notes) out += note + "\n";
    end_.summary = out + comparisonText_;
    replaceFile(file("summary.json"), summary.dump(2) + "\n");
    replaceFile(file("summary.txt"), end_.summary);
  }

  const Example& example_;
  const ExampleRequest& request_;
  std::string analyse_;
  json comparison_;  // null if nothing was published
  std::string comparisonText_;
  ExampleEnd end_;
};

}  // namespace

ExampleEnd runExample(const Example& example, const ExampleRequest& request) {
  return ExampleRun(example, request).run();
}

}  // namespace limen::study
