// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "experiments/base/data_folder.h"
#include "experiments/base/error.h"
#include "experiments/base/hash.h"
#include "experiments/base/input_files.h"
#include "experiments/base/node_reader.h"
#include "experiments/base/shipped_files.h"
#include "experiments/base/text.h"
#include "perception/vision/display.h"
#include "study/protocol/expression.h"
#include "study/protocol/part_reader.h"

namespace limen::study {
namespace {

namespace fs = std::filesystem;
using Kind = YamlNode::Kind;

std::string protocolFolder() { return dataFolder() + "/study/protocols"; }

const std::vector<std::string>& protocolKeys() {
  static const std::vector<std::string> kKeys = {
      "title",   "question", "source", "features",   "display",    "window", "parts", "part_order", "timing",
      "session", "texts",    "form",   "exclusions", "simulation", "words",  "font",  "markers"};
  return kKeys;
}

const std::vector<std::string>& exclusionRules() {
  static const std::vector<std::string> kRules = {"catch_rate_above", "lapse_above", "reaction_time_below_s",
                                                  "reaction_time_above_s"};
  return kRules;
}

class ProtocolReader {
 public:
  ProtocolReader(const std::string& path, std::shared_ptr<const Catalogue> catalogue)
      : problems_(path), files_(path), reader_(problems_, files_) {
    out_.path = path;
    out_.name = fs::path(path).stem().string();
    out_.catalogue = std::move(catalogue);
  }

  Protocol read(const std::string& text) {
    out_.text = text;
    out_.hash = sha256(text);
    const YamlNode root = parseYaml(text, out_.path);
    if (root.kind == Kind::Null)
      problems_.add(root.mark, "the file is empty", "see study/protocols for examples");
    if (root.kind == Kind::List || root.kind == Kind::Scalar)
      problems_.add(root.mark, "the file holds " + root.describe(),
                    "a protocol is a map: 'title: ...', 'parts: ...'");
    problems_.throwIfAny();
    readHead(root);
    readLanguage(root);
    readWindow(root);
    readParts(root);
    if (const YamlNode* node = root.find("part_order"))
      out_.partOrder = readOrder(reader_, *node, "part_order", {});
    else
      out_.partOrder.kind = OrderKind::Fixed;
    if (const YamlNode* node = root.find("timing")) readTiming(*node);
    if (const YamlNode* node = root.find("session")) readSession(*node);
    if (const YamlNode* node = root.find("markers")) readMarkers(*node);
    readTexts(root);
    if (const YamlNode* node = root.find("form")) readForm(*node);
    if (const YamlNode* node = root.find("exclusions")) readExclusions(*node);
    if (const YamlNode* node = root.find("simulation")) {
      reader_.isMap(*node, "'simulation'", "{...}");
      out_.simulation = toJson(*node);
    }
    problems_.throwIfAny();
    out_.fileHashes = files_.hashes();
    out_.files = std::make_shared<const FileFinder>(files_);
    return std::move(out_);
  }

 private:
  /// Words of the interface and a font for them.
  void readLanguage(const YamlNode& root) {
    const std::string folder = fs::path(out_.path).parent_path().string();
    if (const YamlNode* node = root.find("words")) {
      const auto name = reader_.values().text(*node, "words");
      try {
        if (name) out_.words = study::readWords(*name, folder);
      } catch (const Error& error) {
        problems_.add(node->mark, (error.where().empty() ? "" : error.where() + ": ") + error.message(),
                      error.hint());
      }
    }
    const YamlNode* node = root.find("font");
    const auto name = node ? reader_.values().text(*node, "font") : std::nullopt;
    if (!name) return;
    std::error_code code;
    const fs::path beside = fs::path(folder) / *name;
    out_.font = fs::is_regular_file(beside, code) ? beside.string() : *name;
    if (!fs::is_regular_file(out_.font, code))
      problems_.add(node->mark, "no font file '" + *name + "'", "name a TrueType or OpenType file");
  }

  void readHead(const YamlNode& root) {
    reader_.takeText(root, "title", true, out_.title);
    reader_.takeText(root, "question", true, out_.question);
    reader_.takeText(root, "source", false, out_.source);
    if (const YamlNode* node = root.find("features"))
      out_.features = reader_.texts(*node, "'features'", "[SP-58, SP-59]");
    reader_.takeText(root, "display", true, out_.display);
    const YamlNode* node = root.find("display");
    if (!node || out_.display.empty()) return;
    try {
      // A profile may lie beside the protocol.
      const fs::path beside = fs::path(out_.path).parent_path() / out_.display;
      const std::vector<std::string> presets = perception::displayPresets();
      const bool preset = std::find(presets.begin(), presets.end(), out_.display) != presets.end();
      std::error_code code;
      if (!preset && fs::is_regular_file(beside, code)) out_.display = beside.string();
      const perception::DisplayProfile display = perception::readDisplay(out_.display);
      refreshHz_ = display.refreshHz;
      resolutionPx_ = display.resolutionPx;
    } catch (const Error& error) {
      problems_.add(node->mark, (error.where().empty() ? "" : error.where() + ": ") + error.message(),
                    error.hint());
    }
  }

  void readWindow(const YamlNode& root) {
    const YamlNode* node = root.find("window");
    WindowSetting& window = out_.window;
    if (node && reader_.isMap(*node, "'window'", "{width_px: 1024, height_px: 768}")) {
      reader_.checkKeys(*node, "window", {"width_px", "height_px", "background"});
      reader_.take(*node, "width_px", {16, 16384}, "px", window.widthPx);
      reader_.take(*node, "height_px", {16, 16384}, "px", window.heightPx);
      reader_.take(*node, "background", {0, 1}, "", window.background);
    }
    if (resolutionPx_.x > 0 && (window.widthPx > resolutionPx_.x || window.heightPx > resolutionPx_.y))
      problems_.add(node ? node->mark : root.mark,
                    fmt::format("a window of {} x {} px on display '{}', which has {} x {}", window.widthPx,
                                window.heightPx, out_.display, resolutionPx_.x, resolutionPx_.y),
                    "window pixels are display pixels: give a smaller one");
  }

  void readParts(const YamlNode& root) {
    PartReader parts(reader_, *out_.catalogue, refreshHz_, out_.words);
    const YamlNode* list = root.find("parts");
    if (!list) {
      out_.parts.push_back(parts.read(root, "main", protocolKeys()));
      return;
    }
    reader_.checkKeys(root, "protocol with 'parts'", protocolKeys());
    if (!reader_.isFilledList(*list, "'parts'", "- {name: ..., task: ..., stimulus: ...}")) return;
    for (const YamlNode& node : list->items) {
      if (!reader_.isMap(node, "a part", "{name: ..., task: ..., stimulus: ...}")) continue;
      out_.parts.push_back(parts.read(node, "", {"name"}));
      for (size_t i = 0; i + 1 < out_.parts.size(); ++i)
        if (out_.parts[i].name == out_.parts.back().name)
          problems_.add(node.mark, "two parts are called '" + out_.parts[i].name + "'", "rename one");
    }
  }

  void readTiming(const YamlNode& node) {
    if (!reader_.isMap(node, "'timing'", "{fixation_s: 0.5}")) return;
    Timing& timing = out_.timing;
    const std::pair<const char*, double*> keys[] = {{"fixation_s", &timing.fixationS},
                                                    {"after_fixation_s", &timing.afterFixationS},
                                                    {"interval_gap_s", &timing.intervalGapS},
                                                    {"between_trials_s", &timing.betweenTrialsS},
                                                    {"answer_timeout_s", &timing.answerTimeoutS},
                                                    {"break_at_least_s", &timing.breakAtLeastS}};
    std::vector<std::string> known;
    for (const auto& [name, target] : keys) {
      known.emplace_back(name);
      reader_.take(node, name, {0, 3600}, "s", *target);
    }
    reader_.checkKeys(node, "timing", known);
  }

  void readSession(const YamlNode& node) {
    if (!reader_.isMap(node, "'session'", "{resume: resume, maximum_age_h: 24}")) return;
    reader_.checkKeys(node, "session", {"resume", "maximum_age_h", "repeat_invalid_at_most"});
    SessionSetting& session = out_.session;
    reader_.take(node, "resume", session.resume);
    reader_.take(node, "maximum_age_h", {0, 87600}, "h", session.maximumAgeH);
    reader_.take(node, "repeat_invalid_at_most", {0, 1000}, "", session.repeatInvalidAtMost);
  }

  void readMarkers(const YamlNode& node) {
    if (!reader_.isMap(node, "'markers'", "{stimulus: 1, change: 2}")) return;
    const std::vector<std::string> names = namesOf<MarkerKind>();
    reader_.checkKeys(node, "markers", names);
    for (size_t i = 0; i < names.size(); ++i) {
      reader_.take(node, names[i], {0, 255}, "", out_.markers[i]);
      for (size_t other = 0; other < i; ++other)
        if (out_.markers[i] != 0 && out_.markers[i] == out_.markers[other])
          problems_.add(
              node.mark,
              fmt::format("'{}' and '{}' have the code {}", names[other], names[i], out_.markers[i]),
              "a recorder could not tell them apart; 0 sends none");
    }
  }

  void readTexts(const YamlNode& root) {
    const YamlNode* node = root.find("texts");
    const std::string example = "{consent: ..., instructions: ...}";
    if (!node) {
      problems_.add(root.mark, "'texts' is missing", "give at least " + example);
      return;
    }
    if (!reader_.isMap(*node, "'texts'", example)) return;
    reader_.checkKeys(*node, "texts", {"consent", "instructions", "practice", "pause", "debrief"});
    Texts& texts = out_.texts;
    reader_.takeText(*node, "consent", true, texts.consent);
    reader_.takeText(*node, "instructions", true, texts.instructions);
    reader_.takeText(*node, "practice", false, texts.practice);
    reader_.takeText(*node, "pause", false, texts.pause);
    reader_.takeText(*node, "debrief", false, texts.debrief);
  }

  void readForm(const YamlNode& node) {
    const std::string example = "- {name: age, label: Your age, choices: [under 30, 30 or more]}";
    if (!reader_.isFilledList(node, "'form'", example)) return;
    for (const YamlNode& item : node.items) {
      if (!reader_.isMap(item, "a field of the form", example)) continue;
      reader_.checkKeys(item, "a field of the form", {"name", "label", "choices"});
      FormField field;
      reader_.takeText(item, "name", true, field.name);
      reader_.takeText(item, "label", true, field.label);
      const YamlNode* choices = item.find("choices");
      if (choices) field.choices = reader_.texts(*choices, "'choices'", "[under 30, 30 or more]");
      if (!choices || field.choices.size() == 1)
        problems_.add(choices ? choices->mark : item.mark, "field '" + field.name + "' leaves no choice",
                      "give two or more: free text might identify a person");
      if (!field.name.empty() && !isVariableName(field.name))
        problems_.add(item.find("name")->mark, "'" + field.name + "' is not a name for a field",
                      "a letter, then letters, digits and _");
      for (const FormField& other : out_.form)
        if (other.name == field.name)
          problems_.add(item.mark, "two fields '" + field.name + "'", "rename one");
      out_.form.push_back(std::move(field));
    }
  }

  void readExclusions(const YamlNode& node) {
    if (!reader_.isMap(node, "'exclusions'", "{catch_rate_above: 0.25}")) return;
    reader_.checkKeys(node, "exclusions", exclusionRules());
    for (const auto& [key, value] : node.members) {
      const std::string& rule = key.text;
      const bool rate = rule.rfind("reaction_time", 0) != 0;
      if (const auto limit = reader_.number(value, rule, {0.0, rate ? 1.0 : 3600.0}, rate ? "" : "s", false))
        out_.exclusions.push_back({rule, std::get<double>(*limit)});
    }
  }

  Protocol out_;
  Problems problems_;
  FileFinder files_;
  NodeReader reader_;
  double refreshHz_ = 60.0;
  glm::ivec2 resolutionPx_{0};
};

}  // namespace

Protocol parseProtocol(const std::string& text, const std::string& path,
                       std::shared_ptr<const Catalogue> catalogue) {
  return ProtocolReader(path, std::move(catalogue)).read(text);
}

std::vector<std::pair<std::string, std::string>> shippedProtocols() { return shippedFiles(protocolFolder()); }

Protocol readProtocol(const std::string& nameOrPath, std::shared_ptr<const Catalogue> catalogue) {
  const std::string path = findShipped(nameOrPath, protocolFolder(), "protocol");
  protectInput(path);
  return parseProtocol(readTextFile(path), path, std::move(catalogue));
}

}  // namespace limen::study
