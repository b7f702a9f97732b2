// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/descriptor.h"

#include <fmt/format.h>

#include <algorithm>

#include "experiments/base/error.h"
#include "experiments/base/hash.h"
#include "experiments/base/input_files.h"
#include "experiments/base/problems.h"
#include "experiments/base/text.h"
#include "experiments/expectation_reader.h"
#include "experiments/measured_quantities.h"
#include "experiments/measurement_name.h"
#include "experiments/published.h"

namespace limen::experiments {
namespace {

using Kind = YamlNode::Kind;

constexpr size_t kMaxImageSizes = 100'000;
/// Techniques that are now a choice of another.
const std::map<std::string, std::string> kFormerTechniques = {
    {"perception/band_thresholds", "{name: perception/threshold_map, thresholds: bands}"},
    {"perception/band_thresholds_reference",
     "{name: perception/threshold_map_reference, thresholds: bands}"}};
const char* const kImageExample = "{width: 1024, height: 768}";

class Reader {
 public:
  Reader(const std::string& path, const Catalogue& catalogue, const std::set<std::string>& features)
      : catalogue_(catalogue),
        features_(features),
        problems_(path),
        files_(path),
        reader_(problems_, files_) {}

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
    reader_.checkKeys(root, "descriptor",
                      {"title", "question", "source", "features", "scenes", "techniques", "reference",
                       "image", "timing", "metrics", "report", "expect", "artefacts", "published"});
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
    checkTessellation();
    readReport(root.find("report"));
    if (const YamlNode* node = root.find("expect"))
      out_.expectations = readExpectations(*node, out_, catalogue_, problems_);
    if (const YamlNode* node = root.find("published"))
      out_.published = readPublished(*node, out_, catalogue_, problems_);
    problems_.throwIfAny();
    out_.fileHashes = files_.hashes();
    out_.filesAsNamed = files_.asNamed();
    return std::move(out_);
  }

 private:
  void readWords(const YamlNode& root) {
    reader_.takeText(root, "title", true, out_.title);
    reader_.takeText(root, "question", true, out_.question);
    reader_.takeText(root, "source", false, out_.source);
  }

  void readFeatures(const YamlNode& node) {
    if (!reader_.isFilledList(node, "'features'", "[SS-12, SS-13]")) return;
    for (const YamlNode& item : node.items) {
      const auto id = reader_.values().text(item, "features");
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

  /// `kind` is what messages call it. Nothing is returned if the name is missing or unknown.
  std::optional<Entry> readEntry(const YamlNode& node, const std::string& kind, const CatalogueKind& known,
                                 bool axes) {
    if (!reader_.isMap(node, "a " + kind, "{name: " + (known.empty() ? "..." : known.begin()->first) + "}"))
      return {};
    const YamlNode* nameNode = node.find("name");
    if (!nameNode) {
      problems_.add(node.mark, "'name' of a " + kind + " is missing", suggest("", names(known)));
      return {};
    }
    const auto name = reader_.values().text(*nameNode, "name");
    if (!name) return {};
    const auto info = known.find(*name);
    if (info == known.end()) {
      const auto former = kFormerTechniques.find(*name);
      problems_.add(nameNode->mark, "no " + kind + " '" + *name + "'",
                    former == kFormerTechniques.end() ? suggest(*name, names(known))
                                                      : "it is now written " + former->second);
      return {};
    }
    const std::string listHint = axes ? "" : fmt::format("give one value: a {} is not a grid", kind);
    EntryReader entry(reader_, listHint);
    return Entry{*name, entry.axes(node, info->second.parameters, fmt::format("{} '{}'", kind, *name)),
                 node.mark};
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
    if (!reader_.isFilledList(*node, "'" + key + "'", example)) return out;
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
      out_.images.push_back({{{ImageSize{}.width, ImageSize{}.height}}, root.mark});
    } else if (node->kind == Kind::List) {
      if (!reader_.isFilledList(*node, "'image'", std::string("- ") + kImageExample)) return;
      for (const YamlNode& item : node->items) readImage(item);
    } else {
      readImage(*node);
    }
  }

  void readImage(const YamlNode& node) {
    if (!reader_.isMap(node, "an image size", kImageExample)) return;
    ImageAxes out{{}, node.mark};
    const std::vector<Parameter> declared = ImageSize::table().parameters();
    for (const Parameter& parameter : declared)
      if (!node.find(parameter.name))
        problems_.add(node.mark, "'" + parameter.name + "' of image is missing",
                      "give it: " + describeRange(parameter));
    std::vector<Axis> axes = EntryReader(reader_).axes(node, declared, "image", {});
    // Widths vary slowest, whatever order they are written in.
    std::sort(axes.begin(), axes.end(), [](const Axis& a, const Axis& b) { return a.name > b.name; });
    size_t count = 1;
    for (const Axis& axis : axes) count = std::min(count * axis.points.size(), kMaxImageSizes + 1);
    if (count > kMaxImageSizes) {
      problems_.add(node.mark, fmt::format("more than {} image sizes are given", kMaxImageSizes),
                    "shorten a list");
      return;
    }
    for (const AxisPoint& point : combine(axes)) {
      if (point.size() != declared.size()) continue;
      const ImageSize size = ImageSize::table().read(ParameterValues(declared, point));
      out.sizesPx.emplace_back(size.width, size.height);
    }
    out_.images.push_back(std::move(out));
  }

  void readTiming(const YamlNode& node) {
    if (!reader_.isMap(node, "'timing'", "{warmup: 8, frames: 64}")) return;
    out_.timing = reader_.settings<Timing>(node, "timing");
    if (out_.timing.rounds > out_.timing.frames)
      problems_.add(node.mark,
                    fmt::format("{} rounds share {} frames", out_.timing.rounds, out_.timing.frames),
                    "give at least one frame for each round");
  }

  void readArtefacts(const YamlNode& node) {
    if (!reader_.isMap(node, "'artefacts'", "{pictures: true, exr: false}")) return;
    out_.artefacts = reader_.settings<Artefacts>(node, "artefacts");
  }

  void readMetrics(const YamlNode& node) {
    if (!reader_.isFilledList(
            node, "'metrics'",
            "[" + (catalogue_.metrics.empty() ? "" : catalogue_.metrics.begin()->first) + "]"))
      return;
    std::vector<Mark> marks;
    for (const YamlNode& item : node.items) {
      YamlNode map = item;
      if (item.kind == Kind::Scalar) {
        map.kind = Kind::Map;
        YamlNode key;
        key.kind = Kind::Scalar;
        key.mark = item.mark;
        key.text = "name";
        map.members.push_back({key, item});
      }
      const size_t before = problems_.size();
      const auto entry = readEntry(map, "metric", catalogue_.metrics, false);
      if (!entry) continue;
      const CatalogueEntry& info = catalogue_.metrics.at(entry->name);
      if (info.needsReference && !referenceNeededAt_)
        referenceNeededAt_ = item.mark, referenceNeededBy_ = entry->name;
      if (info.needsTessellation && !tessellationNeededAt_)
        tessellationNeededAt_ = item.mark, tessellationNeededBy_ = entry->name;
      const std::vector<AxisPoint> points = combine(entry->axes);
      if (problems_.size() != before || points.empty()) continue;
      out_.metrics.push_back({entry->name, info.version, ParameterValues(info.parameters, points.at(0))});
      marks.push_back(item.mark);
    }
    for (size_t i = 0; i < out_.metrics.size(); ++i) {
      const Configuration& metric = out_.metrics[i];
      const CatalogueEntry& info = catalogue_.metrics.at(metric.name);
      const std::vector<std::string> names =
          measurementNames(metric, out_.metrics, info.parameters, info.figures);
      if (std::find(out_.metricNames.begin(), out_.metricNames.end(), names[0]) != out_.metricNames.end())
        problems_.add(
            marks[i],
            "metric '" + measurementName(metric, out_.metrics, info.parameters) + "' is listed twice",
            "keep one, or give them different values");
      out_.metricNames.insert(out_.metricNames.end(), names.begin(), names.end());
    }
  }

  void checkTessellation() {
    if (!tessellationNeededAt_) return;
    for (const Entry& entry : out_.techniques) {
      if (catalogue_.techniques.at(entry.name).tessellates) continue;
      std::vector<std::string> suitable;
      for (const auto& [name, info] : catalogue_.techniques)
        if (info.tessellates) suitable.push_back(name);
      problems_.add(*tessellationNeededAt_,
                    "metric '" + tessellationNeededBy_ + "' needs the triangles of curved surfaces, which '" +
                        entry.name + "' does not make",
                    "measure it with " + join(suitable));
    }
  }

  void checkReference(const YamlNode& root) {
    if (!referenceNeededAt_) return;
    if (!root.find("reference")) {
      std::vector<std::string> references;
      for (const auto& [name, entry] : catalogue_.techniques)
        if (entry.reference) references.push_back(name);
      problems_.add(*referenceNeededAt_, "metric '" + referenceNeededBy_ + "' needs a reference",
                    "add 'reference: {name: ...}'" +
                        (references.empty() ? "" : "; suitable references: " + join(references)));
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
      for (const DeclaredAt& at : flatten(catalogue_.techniques.at(entry.name).parameters))
        out.insert(at.path);
    for (const Entry& entry : out_.scenes)
      for (const DeclaredAt& at : flatten(catalogue_.scenes.at(entry.name).parameters)) out.insert(at.path);
    return {out.begin(), out.end()};
  }

  void readReport(const YamlNode* node) {
    out_.report = {{"x", "gpu_ms"},
                   {"y", out_.metricNames.empty() ? "gpu_ms" : out_.metricNames[0]},
                   {"series", "technique"},
                   {"panels", "scene"}};
    if (!node || !reader_.isMap(*node, "'report'", "{x: gpu_ms, y: rmse, series: technique, panels: scene}"))
      return;
    reader_.checkKeys(*node, "report", {"x", "y", "series", "panels", "fit"});
    const std::vector<std::string> parameters = variables();
    std::vector<std::string> groups = parameters, quantities = groups;
    groups.insert(groups.end(), {"technique", "scene", "image"});
    for (const store::QuantityRow& row : commonQuantities()) quantities.push_back(row.name);
    quantities.insert(quantities.end(), out_.metricNames.begin(), out_.metricNames.end());
    std::vector<std::string> techniques;
    for (const Entry& entry : out_.techniques) techniques.push_back(entry.name);
    const std::vector<std::string> counters = counterNames(catalogue_, techniques);
    quantities.insert(quantities.end(), counters.begin(), counters.end());
    for (const auto& [key, value] : node->members) {
      if (key.text == "fit") readFit(value, parameters);
      if (!out_.report.contains(key.text) || key.text == "fit") continue;
      const auto word = reader_.values().text(value, key.text);
      if (!word) continue;
      const bool axis = key.text == "x" || key.text == "y";
      const std::vector<std::string>& known = axis ? quantities : groups;
      if (std::find(known.begin(), known.end(), *word) == known.end())
        problems_.add(value.mark, fmt::format("'{}' of the report is '{}'", key.text, *word),
                      suggest(*word, known));
      out_.report[key.text] = *word;
    }
  }

  /// Parameters over whose values the report fits a power law: a name, or a list of those that vary together.
  void readFit(const YamlNode& node, const std::vector<std::string>& parameters) {
    if (node.kind == YamlNode::Kind::List && !reader_.isFilledList(node, "'fit'", "[columns, rows]")) return;
    const std::vector<YamlNode> one = {node};
    std::vector<std::string> names;
    for (const YamlNode& item : node.kind == YamlNode::Kind::List ? node.items : one) {
      const auto name = reader_.values().text(item, "fit");
      if (!name) continue;
      if (std::find(parameters.begin(), parameters.end(), *name) == parameters.end())
        problems_.add(item.mark, fmt::format("'fit' of the report is '{}', which no entry has", *name),
                      suggest(*name, parameters));
      names.push_back(*name);
    }
    out_.report["fit"] = join(names);
  }

  const Catalogue& catalogue_;
  const std::set<std::string>& features_;
  Problems problems_;
  FileFinder files_;
  NodeReader reader_;
  Descriptor out_;
  std::optional<Mark> referenceNeededAt_, tessellationNeededAt_;
  std::string referenceNeededBy_, tessellationNeededBy_;
};

}  // namespace

Descriptor parseDescriptor(const std::string& text, const std::string& path, const Catalogue& catalogue,
                           const std::set<std::string>& features) {
  return Reader(path, catalogue, features).read(text, path);
}

Descriptor readDescriptor(const std::string& path, const Catalogue& catalogue,
                          const std::set<std::string>& features) {
  protectInput(path);
  return parseDescriptor(readTextFile(path), path, catalogue, features);
}

}  // namespace limen::experiments
