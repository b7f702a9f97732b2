// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/base/entry_reader.h"
#include "experiments/base/error.h"
#include "experiments/base/input_files.h"
#include "experiments/base/text.h"
#include "renderer/techniques/scene_needs/candidate.h"

namespace limen::techniques {
namespace {

class CandidateReader {
 public:
  CandidateReader(const std::string& path, const CandidateFileRules& rules)
      : rules_(rules), problems_(path), files_(path), reader_(problems_, files_) {}

  std::vector<Candidate> read(const YamlNode& root) {
    std::vector<Candidate> out;
    if (reader_.isFilledList(root, "the list of candidates", rules_.example.c_str()))
      for (const YamlNode& node : root.items) readEntry(node, out);
    problems_.throwIfAny();
    return out;
  }

 private:
  void readEntry(const YamlNode& node, std::vector<Candidate>& out) {
    if (!reader_.isMap(node, "a candidate", rules_.example.c_str())) return;
    const YamlNode* nameNode = node.find("name");
    if (!nameNode) {
      problems_.add(node.mark, "'name' of a candidate is missing", rules_.example.c_str());
      return;
    }
    const TechniqueRegistry& registry = TechniqueRegistry::instance();
    const TechniqueInfo* info = registry.find(nameNode->text);
    if (!info) {
      problems_.add(nameNode->mark, "no technique '" + nameNode->text + "'",
                    suggest(nameNode->text, registry.names()));
      return;
    }
    if (info->product != rules_.product || info->name == rules_.chooser) {
      problems_.add(nameNode->mark, "'" + info->name + "' is no candidate",
                    "give a technique that makes a " + toText(rules_.product));
      return;
    }
    const std::vector<Parameter>& declared = info->parameters;
    const std::vector<Axis> axes =
        EntryReader(reader_).axes(node, declared, "technique '" + info->name + "'");
    for (AxisPoint& point : combine(axes)) {
      Candidate candidate{info->name, std::move(point)};
      if (rules_.complete) rules_.complete(candidate);
      check(std::move(candidate), node.mark, out);
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

  const CandidateFileRules& rules_;
  Problems problems_;
  FileFinder files_;
  NodeReader reader_;
};

}  // namespace

std::vector<Candidate> readCandidateFile(const std::string& path, const CandidateFileRules& rules) {
  protectInput(path);
  return CandidateReader(path, rules).read(parseYaml(readTextFile(path), path));
}

}  // namespace limen::techniques
