// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/base/entry_reader.h"
#include "experiments/base/error.h"
#include "experiments/base/input_files.h"
#include "experiments/base/text.h"
#include "renderer/techniques/soft_shadows/scene_needs/candidate.h"

namespace limen::techniques {
namespace {

const char* const kExample = "- {name: soft_shadows/bitmask, budget: [64, 256]}";

class CandidateReader {
 public:
  CandidateReader(const std::string& path, const MapSettings& map)
      : map_(map), problems_(path), files_(path), reader_(problems_, files_) {}

  std::vector<Candidate> read(const YamlNode& root) {
    std::vector<Candidate> out;
    if (reader_.isFilledList(root, "the list of candidates", kExample))
      for (const YamlNode& node : root.items) readEntry(node, out);
    problems_.throwIfAny();
    return out;
  }

 private:
  void readEntry(const YamlNode& node, std::vector<Candidate>& out) {
    if (!reader_.isMap(node, "a candidate", kExample)) return;
    const YamlNode* nameNode = node.find("name");
    if (!nameNode) {
      problems_.add(node.mark, "'name' of a candidate is missing", kExample);
      return;
    }
    const TechniqueRegistry& registry = TechniqueRegistry::instance();
    const TechniqueInfo* info = registry.find(nameNode->text);
    if (!info) {
      problems_.add(nameNode->mark, "no technique '" + nameNode->text + "'",
                    suggest(nameNode->text, registry.names()));
      return;
    }
    if (info->product != ProductKind::Visibility || info->name == "soft_shadows/scene_needs") {
      problems_.add(nameNode->mark, "'" + info->name + "' is no candidate",
                    "give a technique that makes a visibility");
      return;
    }
    const std::vector<Parameter>& declared = info->parameters;
    const std::vector<Axis> axes =
        EntryReader(reader_).axes(node, declared, "technique '" + info->name + "'");
    for (AxisPoint& point : combine(axes)) {
      const auto takes = [&](const char* name) {
        return std::any_of(declared.begin(), declared.end(),
                           [&](const Parameter& one) { return one.name == name; });
      };
      if (takes("resolution")) point.emplace("resolution", int64_t{map_.resolution});
      if (takes("raster") && map_.raster != MapSettings{}.raster)
        point.emplace("raster", std::string(limen::toText(map_.raster)));
      check({info->name, std::move(point)}, node.mark, out);
    }
  }

  void check(Candidate candidate, Mark mark, std::vector<Candidate>& out) {
    try {
      const ParameterValues values = completeValues(candidate);
      const TechniqueInfo& info = TechniqueRegistry::instance().get(candidate.technique);
      if (info.check) info.check(values);
      out.push_back(std::move(candidate));
    } catch (const Error& error) {
      problems_.add(mark, error.message(), error.hint());
    }
  }

  MapSettings map_;
  Problems problems_;
  FileFinder files_;
  NodeReader reader_;
};

}  // namespace

std::vector<Candidate> readCandidates(const std::string& path, const MapSettings& map) {
  protectInput(path);
  return CandidateReader(path, map).read(parseYaml(readTextFile(path), path));
}

}  // namespace limen::techniques
