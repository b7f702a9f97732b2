// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <filesystem>
#include <map>

#include "experiments/base/data_folder.h"
#include "experiments/base/entry_reader.h"
#include "experiments/base/error.h"
#include "experiments/base/input_files.h"
#include "experiments/base/node_reader.h"
#include "experiments/base/shipped_files.h"
#include "experiments/base/text.h"
#include "experiments/base/value_reader.h"
#include "perception/vision/display.h"
#include "study/example/example.h"

namespace limen::study {
namespace {

namespace fs = std::filesystem;
using Kind = YamlNode::Kind;

std::string exampleFolder() { return dataFolder() + "/study/examples"; }

class ExampleReader {
 public:
  explicit ExampleReader(const std::string& path)
      : problems_(path), files_(path), reader_(problems_, files_) {
    out_.path = path;
    out_.name = fs::path(path).stem().string();
  }

  Example read(const std::string& text) {
    out_.text = text;
    const YamlNode root = parseYaml(text, out_.path);
    if (root.kind != Kind::Map)
      problems_.add(root.mark, "the file holds " + root.describe(),
                    "an example is a map: 'title: ...', 'studies: ...'");
    problems_.throwIfAny();
    reader_.checkKeys(root, "example", {"title", "question", "source", "features", "studies", "analyses"});
    reader_.takeText(root, "title", true, out_.title);
    reader_.takeText(root, "question", true, out_.question);
    reader_.takeText(root, "source", false, out_.source);
    if (const YamlNode* node = root.find("features"))
      out_.features = reader_.texts(*node, "'features'", "[SP-67, SP-68]");
    readStudies(root);
    readAnalyses(root);
    problems_.throwIfAny();
    return std::move(out_);
  }

 private:
  void readStudies(const YamlNode& root) {
    const std::string example = "- {protocol: experiment_1, observer: {kind: lapsing}, observers: 8}";
    const YamlNode* list = root.find("studies");
    if (!list) {
      problems_.add(root.mark, "'studies' is missing", "give at least one: " + example);
      return;
    }
    if (!reader_.isFilledList(*list, "'studies'", example)) return;
    for (const YamlNode& node : list->items) {
      if (!reader_.isMap(node, "a study", example)) continue;
      ExampleStudy study = readStudy(node);
      for (const ExampleStudy& other : out_.studies)
        if (other.name == study.name)
          problems_.add(node.mark, "two studies are called '" + study.name + "'",
                        "give one a 'name' of its own");
      out_.studies.push_back(std::move(study));
    }
  }

  ExampleStudy readStudy(const YamlNode& node) {
    ExampleStudy out;
    reader_.checkKeys(
        node, "a study",
        {"name", "protocol", "display", "observer", "observers", "seed", "window", "predictions"});
    reader_.takeText(node, "protocol", true, out.protocol);
    findProtocol(node, out.protocol);
    out.name = fs::path(out.protocol).stem().string();
    reader_.takeText(node, "name", false, out.name);
    // Part of file names.
    const auto plain = [](char c) {
      return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
             c == '-';
    };
    if (const YamlNode* name = node.find("name");
        name && !(out.name.size() <= 64 && std::all_of(out.name.begin(), out.name.end(), plain)))
      problems_.add(name->mark, "'" + out.name + "' is not a name for a study",
                    "use letters, digits, _ and -, at most 64");
    reader_.takeText(node, "display", false, out.display);
    if (const YamlNode* display = node.find("display"); display && !out.display.empty())
      checkDisplay(*display, out.display);
    readObserver(node, out);
    reader_.take(node, "observers", {1, 100000}, "", out.observers);
    int seed = 1;
    reader_.take(node, "seed", {0, 2147483647}, "", seed);
    out.seed = static_cast<uint64_t>(seed);
    reader_.take(node, "predictions", out.predictions);
    readWindow(node, out);
    return out;
  }

  void findProtocol(const YamlNode& node, std::string& protocol) {
    if (protocol.empty()) return;
    std::vector<std::string> names;
    for (const auto& [name, title] : shippedProtocols()) names.push_back(name);
    if (std::find(names.begin(), names.end(), protocol) != names.end()) return;
    std::error_code code;
    const fs::path beside = fs::path(out_.path).parent_path() / protocol;
    if (fs::is_regular_file(beside, code))
      protocol = beside.string();
    else
      problems_.add(node.find("protocol")->mark, "no file and no shipped protocol '" + protocol + "'",
                    suggest(protocol, names));
  }

  void checkDisplay(const YamlNode& node, std::string& display) {
    try {
      std::error_code code;
      const std::vector<std::string> presets = perception::displayPresets();
      const fs::path beside = fs::path(out_.path).parent_path() / display;
      if (std::find(presets.begin(), presets.end(), display) == presets.end() &&
          fs::is_regular_file(beside, code))
        display = beside.string();
      perception::readDisplay(display);
    } catch (const Error& error) {
      problems_.add(node.mark, (error.where().empty() ? "" : error.where() + ": ") + error.message(),
                    error.hint());
    }
  }

  void readObserver(const YamlNode& study, ExampleStudy& out) {
    const std::string example = "{kind: drifting, lapse_per_100: 0.01}";
    const YamlNode* node = study.find("observer");
    if (!node) {
      problems_.add(study.mark, "'observer' is missing", "say who answers: " + example);
      return;
    }
    if (!reader_.isMap(*node, "'observer'", example)) return;
    std::string name;
    reader_.takeText(*node, "kind", true, name);
    if (name.empty()) return;
    std::vector<std::string> kinds;
    const ObserverKind* kind = nullptr;
    for (const ObserverKind* one : observerKinds()) {
      kinds.push_back(one->name);
      if (one->name == name) kind = one;
    }
    if (!kind) {
      problems_.add(node->find("kind")->mark, "no kind of observer '" + name + "'", suggest(name, kinds));
      return;
    }
    AxisPoint given;
    EntryReader entry(reader_, "give one value");
    for (const Axis& axis : entry.axes(*node, kind->parameters, "observer '" + name + "'", {"kind"}))
      if (!axis.points.empty()) given.insert(axis.points.front().begin(), axis.points.front().end());
    try {
      out.observer = chooseObserver(*kind, given);
    } catch (const Error& error) {
      problems_.add(node->mark, error.message(), error.hint());
    }
  }

  void readWindow(const YamlNode& study, ExampleStudy& out) {
    const YamlNode* node = study.find("window");
    if (!node || !reader_.isMap(*node, "'window'", "{width_px: 320, height_px: 240}")) return;
    reader_.checkKeys(*node, "window", {"width_px", "height_px"});
    std::pair<int, int> window(0, 0);
    reader_.take(*node, "width_px", {16, 16384}, "px", window.first);
    reader_.take(*node, "height_px", {16, 16384}, "px", window.second);
    for (const char* key : {"width_px", "height_px"})
      if (!node->find(key))
        problems_.add(node->mark, std::string("'") + key + "' of window is missing",
                      "give both, or no window for that of the protocol");
    out.windowPx = window;
  }

  void readAnalyses(const YamlNode& root) {
    const YamlNode* node = root.find("analyses");
    if (!node) {
      out_.analyses = exampleAnalyses();
      return;
    }
    const std::vector<std::string>& known = exampleAnalyses();
    const std::vector<std::string> given = reader_.texts(*node, "'analyses'", "[" + join(known) + "]");
    for (const std::string& one : given)
      if (std::find(known.begin(), known.end(), one) == known.end())
        problems_.add(node->mark, "no analysis '" + one + "'", suggest(one, known));
    for (const std::string& one : known)
      if (std::find(given.begin(), given.end(), one) != given.end()) out_.analyses.push_back(one);
  }

  Example out_;
  Problems problems_;
  FileFinder files_;
  NodeReader reader_;
};

}  // namespace

const std::vector<std::string>& exampleAnalyses() {
  static const std::vector<std::string> kNames = {"rates", "anova", "sdt", "validate", "report"};
  return kNames;
}

Example parseExample(const std::string& text, const std::string& path) {
  return ExampleReader(path).read(text);
}

std::vector<std::pair<std::string, std::string>> shippedExamples() { return shippedFiles(exampleFolder()); }

Example readExample(const std::string& nameOrPath) {
  const std::string path = findShipped(nameOrPath, exampleFolder(), "example");
  protectInput(path);
  return parseExample(readTextFile(path), path);
}

}  // namespace limen::study
