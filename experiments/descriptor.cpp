// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/descriptor.h"

#include <fmt/format.h>

#include <algorithm>

#include "experiments/base/error.h"
#include "experiments/base/hash.h"
#include "experiments/base/problems.h"
#include "experiments/base/text.h"
#include "experiments/base/value_reader.h"
#include "experiments/expectation_reader.h"
#include "experiments/measurement_name.h"
#include "experiments/published.h"

namespace limen::experiments {
namespace {

using Kind = YamlNode::Kind;

const std::vector<Parameter>& imageParameters() {
  // 16,384 texels is what OpenGL 4.5 promises for a texture's side.
  static const std::vector<Parameter> kParameters = {
      integerParameter("width", 1024, 1, 16384, "px", "Image width"),
      integerParameter("height", 768, 1, 16384, "px", "Image height")};
  return kParameters;
}

const std::vector<Parameter>& timingParameters() {
  static const std::vector<Parameter> kParameters = {
      integerParameter("warmup", Timing{}.warmup, 0, 10000, "frames", "Frames thrown away before each round"),
      integerParameter("frames", Timing{}.frames, 1, 100000, "frames", "Timed frames in all"),
      integerParameter("rounds", Timing{}.rounds, 1, 1000, "", "Interleaved rounds"),
      integerParameter("batch", Timing{}.batch, 1, 256, "runs", "Runs whose rounds are interleaved")};
  return kParameters;
}

const Parameter* findParameter(const std::vector<Parameter>& parameters, const std::string& name) {
  const auto match = std::find_if(parameters.begin(), parameters.end(),
                                  [&](const Parameter& parameter) { return parameter.name == name; });
  return match == parameters.end() ? nullptr : &*match;
}

std::vector<std::string> parameterNames(const std::vector<Parameter>& parameters) {
  std::vector<std::string> out;
  for (const Parameter& parameter : parameters) out.push_back(parameter.name);
  return out;
}

class Reader {
 public:
  Reader(const std::string& path, const Catalogue& catalogue, const std::set<std::string>& features)
      : catalogue_(catalogue),
        features_(features),
        problems_(path),
        files_(path),
        values_(problems_, files_) {}

  Descriptor read(const std::string& text, const std::string& path) {
    out_.path = path;
    out_.text = text;
    out_.hash = sha256(text);
    const YamlNode root = parseYaml(text, path);
    if (root.kind == Kind::Null)
      problems_.add(root.mark, "the file is empty", "see experiments/descriptors for examples");
    if (root.kind == Kind::List || root.kind == Kind::Scalar)
      problems_.add(root.mark, "the file holds " + root.describe(),
                    "a descriptor is a map: 'title: ...', 'scenes: ...'");
    problems_.throwIfAny();
    checkKeys(root, "descriptor",
              {"title", "question", "source", "features", "scenes", "techniques", "reference", "image",
               "timing", "metrics", "report", "expect", "artefacts", "published"});
    readWords(root);
    if (const YamlNode* node = root.find("features")) readFeatures(*node);
    out_.scenes = readEntries(root, "scenes", "scene", catalogue_.scenes);
    out_.techniques = readEntries(root, "techniques", "technique", catalogue_.techniques);
    if (const YamlNode* node = root.find("reference")) readReference(*node);
    readImages(root);
    if (const YamlNode* node = root.find("timing")) readTiming(*node);
    if (const YamlNode* node = root.find("artefacts")) readArtefacts(*node);
    if (const YamlNode* node = root.find("metrics")) readMetrics(*node);
    checkReference(root);
    readReport(root.find("report"));
    if (const YamlNode* node = root.find("expect"))
      out_.expectations = readExpectations(*node, out_, catalogue_, imageParameters(), problems_);
    if (const YamlNode* node = root.find("published"))
      out_.published = readPublished(*node, out_, catalogue_, imageParameters(), problems_);
    problems_.throwIfAny();
    out_.fileHashes = files_.hashes();
    out_.filesAsNamed = files_.asNamed();
    return std::move(out_);
  }

 private:
  bool isMap(const YamlNode& node, const std::string& what, const std::string& example) {
    if (node.kind == Kind::Map) return true;
    problems_.add(node.mark, what + " is " + node.describe(), "write it as a map: " + example);
    return false;
  }

  bool isFilledList(const YamlNode& node, const std::string& key, const std::string& example) {
    if (node.kind != Kind::List)
      problems_.add(node.mark, "'" + key + "' is " + node.describe(), "write it as a list: " + example);
    else if (node.items.empty())
      problems_.add(node.mark, "the list of '" + key + "' is empty", "give at least one: " + example);
    return node.kind == Kind::List && !node.items.empty();
  }

  void checkKeys(const YamlNode& map, const std::string& what, const std::vector<std::string>& known) {
    for (const auto& [key, value] : map.members)
      if (std::find(known.begin(), known.end(), key.text) == known.end())
        problems_.add(key.mark, fmt::format("unknown key '{}' of {}", YamlNode(key).text, what),
                      suggest(key.text, known));
  }

  void readWords(const YamlNode& root) {
    const auto take = [&](const char* key, bool required, std::string& out) {
      const YamlNode* node = root.find(key);
      if (!node && required) problems_.add(root.mark, fmt::format("'{}' is missing", key), "give it: text");
      if (node) out = values_.text(*node, key).value_or("");
    };
    take("title", true, out_.title);
    take("question", true, out_.question);
    take("source", false, out_.source);
  }

  void readFeatures(const YamlNode& node) {
    if (!isFilledList(node, "features", "[SS-12, SS-13]")) return;
    for (const YamlNode& item : node.items) {
      const auto id = values_.text(item, "features");
      if (!id) continue;
      if (!features_.empty() && !features_.count(*id))
        problems_.add(item.mark, "unknown feature '" + *id + "'",
                      suggest(*id, {features_.begin(), features_.end()}) + "; see --features");
      else if (std::find(out_.features.begin(), out_.features.end(), *id) != out_.features.end())
        problems_.add(item.mark, "feature '" + *id + "' is listed twice", "keep one");
      else
        out_.features.push_back(*id);
    }
  }

  /// `kind` is the word for messages. Nothing is returned if the name is missing or unknown.
  std::optional<Entry> readEntry(const YamlNode& node, const std::string& kind, const CatalogueKind& known,
                                 bool axes) {
    if (!isMap(node, "a " + kind, "{name: " + (known.empty() ? "..." : known.begin()->first) + "}"))
      return {};
    const YamlNode* nameNode = node.find("name");
    if (!nameNode) {
      problems_.add(node.mark, "'name' of a " + kind + " is missing", suggest("", names(known)));
      return {};
    }
    const auto name = values_.text(*nameNode, "name");
    if (!name) return {};
    const auto info = known.find(*name);
    if (info == known.end()) {
      problems_.add(nameNode->mark, "no " + kind + " '" + *name + "'", suggest(*name, names(known)));
      return {};
    }
    Entry entry{*name, {}, node.mark};
    const std::vector<Parameter>& declared = info->second.parameters;
    for (const auto& [key, value] : node.members) {
      if (key.text == "name") continue;
      const Parameter* parameter = findParameter(declared, key.text);
      if (!parameter) {
        problems_.add(key.mark, fmt::format("{} '{}' has no parameter '{}'", kind, *name, key.text),
                      declared.empty() ? "it has none" : suggest(key.text, parameterNames(declared)));
      } else if (!axes && value.kind == Kind::List) {
        problems_.add(value.mark, fmt::format("'{}' of the {} is a list", key.text, kind),
                      "one value only: " + describeRange(*parameter));
      } else {
        entry.axes.push_back({key.text, values_.values(value, *parameter)});
      }
    }
    for (const Parameter& parameter : declared)
      if (parameter.required && !node.find(parameter.name))
        problems_.add(node.mark, fmt::format("'{}' of {} '{}' is missing", parameter.name, kind, *name),
                      "give it: " + describeRange(parameter));
    return entry;
  }

  std::vector<Entry> readEntries(const YamlNode& root, const std::string& key, const std::string& kind,
                                 const CatalogueKind& known) {
    std::vector<Entry> out;
    const std::string example = "- {name: " + (known.empty() ? "..." : known.begin()->first) + "}";
    const YamlNode* node = root.find(key);
    if (!node) {
      problems_.add(root.mark, "'" + key + "' is missing", "give a list: " + example);
      return out;
    }
    if (!isFilledList(*node, key, example)) return out;
    for (const YamlNode& item : node->items)
      if (auto entry = readEntry(item, kind, known, true)) out.push_back(*std::move(entry));
    return out;
  }

  void readReference(const YamlNode& node) {
    if (node.kind == Kind::List) {
      problems_.add(node.mark, "'reference' is a list", "a sweep has one reference: {name: ...}");
      return;
    }
    out_.reference = readEntry(node, "reference", catalogue_.techniques, false);
  }

  void readImages(const YamlNode& root) {
    const YamlNode* node = root.find("image");
    if (!node) {
      out_.images.push_back({{std::get<int64_t>(imageParameters()[0].defaultValue)},
                             {std::get<int64_t>(imageParameters()[1].defaultValue)},
                             root.mark});
      return;
    }
    const std::string example = "{width: 1024, height: 768}";
    if (node->kind == Kind::List) {
      if (!isFilledList(*node, "image", "- " + example)) return;
      for (const YamlNode& item : node->items) readImage(item, example);
    } else {
      readImage(*node, example);
    }
  }

  void readImage(const YamlNode& node, const std::string& example) {
    if (!isMap(node, "an image size", example)) return;
    checkKeys(node, "image", {"width", "height"});
    ImageAxes axes{{}, {}, node.mark};
    for (size_t i = 0; i < 2; ++i) {
      const Parameter& parameter = imageParameters()[i];
      const YamlNode* value = node.find(parameter.name);
      if (!value) {
        problems_.add(node.mark, "'" + parameter.name + "' of image is missing",
                      "give it: " + describeRange(parameter));
        continue;
      }
      for (const ParameterValue& size : values_.values(*value, parameter))
        (i == 0 ? axes.widthsPx : axes.heightsPx).push_back(std::get<int64_t>(size));
    }
    out_.images.push_back(std::move(axes));
  }

  void readTiming(const YamlNode& node) {
    if (!isMap(node, "'timing'", "{warmup: 8, frames: 64}")) return;
    checkKeys(node, "timing", parameterNames(timingParameters()));
    int* const targets[] = {&out_.timing.warmup, &out_.timing.frames, &out_.timing.rounds,
                            &out_.timing.batch};
    for (size_t i = 0; i < timingParameters().size(); ++i)
      if (const YamlNode* value = node.find(timingParameters()[i].name))
        if (const auto number = values_.value(*value, timingParameters()[i]))
          *targets[i] = static_cast<int>(std::get<int64_t>(*number));
    if (out_.timing.rounds > out_.timing.frames)
      problems_.add(node.mark,
                    fmt::format("{} rounds share {} frames", out_.timing.rounds, out_.timing.frames),
                    "give at least one frame for each round");
  }

  void readArtefacts(const YamlNode& node) {
    if (!isMap(node, "'artefacts'", "{pictures: true, exr: false}")) return;
    checkKeys(node, "artefacts", {"pictures", "exr"});
    const auto take = [&](const char* key, bool& out) {
      if (const YamlNode* value = node.find(key))
        if (const auto flag = values_.value(*value, booleanParameter(key, out, "")))
          out = std::get<bool>(*flag);
    };
    take("pictures", out_.artefacts.pictures);
    take("exr", out_.artefacts.exr);
  }

  void readMetrics(const YamlNode& node) {
    if (!isFilledList(node, "metrics",
                      "[" + (catalogue_.metrics.empty() ? "" : catalogue_.metrics.begin()->first) + "]"))
      return;
    std::vector<Mark> marks;
    for (const YamlNode& item : node.items) {
      YamlNode map = item;
      if (item.kind == Kind::Scalar) {
        map.kind = Kind::Map;
        map.members.push_back({YamlNode{Kind::Scalar, item.mark, "name", false, {}, {}}, item});
      }
      const auto entry = readEntry(map, "metric", catalogue_.metrics, false);
      if (!entry) continue;
      const CatalogueEntry& info = catalogue_.metrics.at(entry->name);
      if (info.needsReference && !referenceNeededAt_)
        referenceNeededAt_ = item.mark, referenceNeededBy_ = entry->name;
      std::map<std::string, ParameterValue> given;
      for (const Axis& axis : entry->axes)
        if (!axis.values.empty()) given[axis.name] = axis.values[0];
      const bool complete = std::all_of(
          info.parameters.begin(), info.parameters.end(),
          [&](const Parameter& parameter) { return !parameter.required || given.count(parameter.name); });
      if (!complete) continue;
      out_.metrics.push_back({entry->name, info.version, ParameterValues(info.parameters, given)});
      marks.push_back(item.mark);
    }
    for (size_t i = 0; i < out_.metrics.size(); ++i) {
      const Choice& metric = out_.metrics[i];
      const std::string name =
          measurementName(metric, out_.metrics, catalogue_.metrics.at(metric.name).parameters);
      if (std::find(out_.metricNames.begin(), out_.metricNames.end(), name) != out_.metricNames.end())
        problems_.add(marks[i], "metric '" + name + "' is listed twice",
                      "keep one, or give them other values");
      out_.metricNames.push_back(name);
    }
  }

  void checkReference(const YamlNode& root) {
    if (!referenceNeededAt_) return;
    if (!root.find("reference")) {
      std::vector<std::string> references;
      for (const auto& [name, entry] : catalogue_.techniques)
        if (entry.reference) references.push_back(name);
      problems_.add(
          *referenceNeededAt_, "metric '" + referenceNeededBy_ + "' needs a reference",
          "add 'reference: {name: ...}'" + (references.empty() ? "" : "; made for it: " + join(references)));
    }
    if (!out_.reference) return;
    const std::string& product = catalogue_.techniques.at(out_.reference->name).product;
    for (const Entry& entry : out_.techniques) {
      const std::string& own = catalogue_.techniques.at(entry.name).product;
      if (own != product)
        problems_.add(entry.mark,
                      fmt::format("technique '{}' makes {}, but the reference '{}' makes {}", entry.name, own,
                                  out_.reference->name, product),
                      "compare products of one kind: use another reference, or a descriptor for each kind");
    }
  }

  std::vector<std::string> variables() const {
    std::set<std::string> out = {"width", "height"};
    for (const Entry& entry : out_.techniques)
      for (const Parameter& parameter : catalogue_.techniques.at(entry.name).parameters)
        out.insert(parameter.name);
    for (const Entry& entry : out_.scenes)
      for (const Parameter& parameter : catalogue_.scenes.at(entry.name).parameters)
        out.insert(parameter.name);
    return {out.begin(), out.end()};
  }

  void readReport(const YamlNode* node) {
    out_.report = {{"x", "gpu_ms"},
                   {"y", out_.metricNames.empty() ? "gpu_ms" : out_.metricNames[0]},
                   {"series", "technique"},
                   {"panels", "scene"}};
    if (!node || !isMap(*node, "'report'", "{x: gpu_ms, y: rmse, series: technique, panels: scene}")) return;
    checkKeys(*node, "report", {"x", "y", "series", "panels"});
    std::vector<std::string> groups = variables(), quantities = groups;
    groups.insert(groups.end(), {"technique", "scene", "image"});
    for (const std::string& name : measurementNames(catalogue_)) quantities.push_back(name);
    quantities.insert(quantities.end(), out_.metricNames.begin(), out_.metricNames.end());
    std::vector<std::string> techniques;
    for (const Entry& entry : out_.techniques) techniques.push_back(entry.name);
    const std::vector<std::string> counters = counterNames(catalogue_, techniques);
    quantities.insert(quantities.end(), counters.begin(), counters.end());
    for (const auto& [key, value] : node->members) {
      if (!out_.report.contains(key.text)) continue;
      const auto word = values_.text(value, key.text);
      if (!word) continue;
      const bool axis = key.text == "x" || key.text == "y";
      const std::vector<std::string>& known = axis ? quantities : groups;
      if (std::find(known.begin(), known.end(), *word) == known.end())
        problems_.add(value.mark, fmt::format("'{}' of the report is '{}'", key.text, *word),
                      suggest(*word, known));
      out_.report[key.text] = *word;
    }
  }

  const Catalogue& catalogue_;
  const std::set<std::string>& features_;
  Problems problems_;
  FileFinder files_;
  ValueReader values_;
  Descriptor out_;
  std::optional<Mark> referenceNeededAt_;
  std::string referenceNeededBy_;
};

}  // namespace

Descriptor parseDescriptor(const std::string& text, const std::string& path, const Catalogue& catalogue,
                           const std::set<std::string>& features) {
  return Reader(path, catalogue, features).read(text, path);
}

Descriptor readDescriptor(const std::string& path, const Catalogue& catalogue,
                          const std::set<std::string>& features) {
  return parseDescriptor(readTextFile(path), path, catalogue, features);
}

}  // namespace limen::experiments
