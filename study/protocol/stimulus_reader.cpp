// SPDX-License-Identifier: BSD-3-Clause
#include "study/protocol/stimulus_reader.h"

#include <fmt/format.h>

#include <algorithm>

#include "experiments/base/entry_reader.h"
#include "experiments/base/error.h"
#include "experiments/base/text.h"
#include "study/protocol/expression.h"

namespace limen::study {
namespace {

using Kind = YamlNode::Kind;

const char* const kEntryExample = "{name: ..., parameter: value}";

/// "'= 2 * speed' with speed = 3"
std::string origin(const Expression& expression, const Variables& variables) {
  std::vector<std::string> used;
  for (const std::string& name : namesIn(expression.text))
    if (const auto found = variables.find(name); found != variables.end())
      used.push_back(name + " = " + found->second.dump());
  return "'=" + expression.text + "'" + (used.empty() ? "" : " with " + join(used));
}

template <class Entries>
std::vector<std::string> namesOf(const Entries& entries) {
  std::vector<std::string> out;
  for (const auto& [name, entry] : entries) out.push_back(name);
  return out;
}

}  // namespace

std::optional<YamlNode> StimulusReader::resolved(const YamlNode& node) {
  if (isExpression(node)) {
    try {
      YamlNode out = toYaml(evaluate(expressionOf(node), *variables_, reader_.problems().file()), node.mark);
      out.origin = origin(expressionOf(node), *variables_);
      // A calculated value is a number, integer or not; a variable's text may also represent a number.
      out.quoted = false;
      return out;
    } catch (const Error& error) {
      reader_.problems().add(node.mark, error.message(), error.hint());
      return {};
    }
  }
  YamlNode out = node;
  for (YamlMember& member : out.members) {
    std::optional<YamlNode> value = resolved(member.value);
    if (!value) return {};
    member.value = *std::move(value);
  }
  for (YamlNode& item : out.items) {
    std::optional<YamlNode> value = resolved(item);
    if (!value) return {};
    item = *std::move(value);
  }
  return out;
}

template <class... Arguments>
void StimulusReader::take(const YamlNode& map, const std::string& key, Arguments&&... arguments) {
  const YamlNode* node = map.find(key);
  const std::optional<YamlNode> plain = node ? resolved(*node) : std::nullopt;
  if (!plain) return;
  YamlNode name, alone;
  name.kind = Kind::Scalar;
  name.text = key;
  alone.kind = Kind::Map;
  alone.members = {{name, *plain}};
  reader_.take(alone, key, std::forward<Arguments>(arguments)...);
}

ParameterValues StimulusReader::readValues(const YamlNode& map, const std::string& what,
                                           const std::vector<Parameter>& declared, bool named,
                                           std::map<std::string, std::string>* fileHashes) {
  const std::string listHint =
      "a stimulus has a single value; several values are levels of a factor: 'size: = size' and 'factors: "
      "{size: [...]}'";
  const size_t before = reader_.problems().size();
  EntryReader entry(reader_, listHint);
  const std::vector<Axis> axes =
      entry.axes(map, declared, what, named ? std::vector<std::string>{"name"} : std::vector<std::string>{});
  // A repeated problem is not added again: then it is an axis without a position to report.
  const std::vector<AxisPoint> given = combine(axes);
  if (reader_.problems().size() != before || given.empty()) return {};
  ParameterValues values(declared, given[0]);
  for (const DeclaredAt& at : chosen(declared, values))
    if (at.parameter->type == ParameterType::File && fileHashes) {
      const auto hash = reader_.files().hashes().find(std::get<std::string>(*values.find(at.path)));
      if (hash != reader_.files().hashes().end()) (*fileHashes)[at.path] = hash->second;
    }
  return values;
}

std::optional<NamedEntry> StimulusReader::readEntry(const YamlNode& node, const char* kind,
                                                    const CatalogueKind& known) {
  Problems& problems = reader_.problems();
  const std::optional<YamlNode> map = resolved(node);
  if (!map || !reader_.isMap(*map, std::string("a ") + kind, kEntryExample)) return {};
  const YamlNode* nameNode = map->find("name");
  if (!nameNode) {
    problems.add(map->mark, fmt::format("a {} without a name", kind),
                 "write " + std::string(kEntryExample) + "; known: " + join(namesOf(known)));
    return {};
  }
  const std::optional<YamlNode> plain = resolved(*nameNode);
  const auto name = plain ? reader_.values().text(*plain, "name") : std::nullopt;
  if (!name) return {};
  const auto declaration = known.find(*name);
  if (declaration == known.end()) {
    problems.add(nameNode->mark, fmt::format("no {} '{}'", kind, *name), suggest(*name, namesOf(known)));
    return {};
  }
  NamedEntry out{*name, declaration->second.version, {}, {}};
  out.values = readValues(*map, fmt::format("{} '{}'", kind, *name), declaration->second.parameters, true,
                          &out.fileHashes);
  return out;
}

void StimulusReader::readLevels(const YamlNode& node, Stimulus& out) {
  const std::optional<YamlNode> map = resolved(node);
  if (!map || !reader_.isMap(*map, "'levels'", "{before: 1, after: 0}")) return;
  reader_.checkKeys(*map, "levels", {"object", "before", "after", "others"});
  LevelChange change;
  for (const char* key : {"before", "after"})
    if (!map->find(key))
      reader_.problems().add(map->mark, fmt::format("'{}' of levels is missing", key),
                             "give it: number of a level, 0 the finest");
  take(*map, "object", Range{0, 1000000}, "", change.object);
  take(*map, "before", Range{0, 63}, "", change.before);
  take(*map, "after", Range{0, 63}, "", change.after);
  if (const YamlNode* others = map->find("others"))
    if (const auto choice = reader_.choice(*others, "others", {"finest", "distance", "omitted"}))
      change.others = *choice;
  if (change.before == change.after && map->find("before") && map->find("after"))
    reader_.problems().add(map->mark,
                           fmt::format("level {} changes to level {}", change.before, change.after),
                           "give two different levels; a trial without a change is a catch trial");
  out.levels = change;
}

void StimulusReader::readChange(const YamlNode& map, Stimulus& out) {
  Problems& problems = reader_.problems();
  const YamlNode *levels = map.find("levels"), *before = map.find("before"), *after = map.find("after"),
                 *shading = map.find("shading");
  if (levels && (before || after))
    problems.add(levels->mark, "a stimulus has 'levels' and a technique",
                 "give levels {before, after} for a change of level of detail, or 'before' (and 'after') for "
                 "a change of technique");
  if (!levels && !before)
    problems.add(after ? after->mark : map.mark, "the stimulus does not say what it shows",
                 "give 'levels: {before: 1, after: 0}', or a technique 'before: {name: ...}'");
  if (shading && !levels)
    problems.add(shading->mark, "'shading' is without 'levels'", "a technique does its own shading");
  if (levels) readLevels(*levels, out);
  if (before) out.before = readEntry(*before, "technique", catalogue_.techniques);
  if (after) out.after = readEntry(*after, "technique", catalogue_.techniques);
  YamlNode none;
  none.kind = Kind::Map;
  none.mark = map.mark;
  const std::optional<YamlNode> plain = shading ? resolved(*shading) : none;
  if (levels && plain && (!shading || reader_.isMap(*plain, "'shading'", "{ambient: 0.2}")))
    out.shading = readValues(*plain, "shading", catalogue_.shading, false, nullptr);
}

void StimulusReader::readCue(const YamlNode& node, Stimulus& out) {
  Problems& problems = reader_.problems();
  const std::optional<YamlNode> map = resolved(node);
  if (!map || !reader_.isMap(*map, "'cue'", "{kind: circle, x_px: 512, y_px: 384, duration_s: 2}")) return;
  reader_.checkKeys(*map, "cue", {"kind", "x_px", "y_px", "radius_px", "duration_s"});
  take(*map, "kind", out.cue.kind);
  take(*map, "x_px", Range{-16384, 16384}, "px", out.cue.xPx);
  take(*map, "y_px", Range{-16384, 16384}, "px", out.cue.yPx);
  take(*map, "radius_px", Range{1, 16384}, "px", out.cue.radiusPx);
  take(*map, "duration_s", Range{0, 60}, "s", out.cue.durationS);
  if (out.cue.kind == Cue::Kind::None) return;
  for (const char* key : {"x_px", "y_px", "duration_s"})
    if (!map->find(key))
      problems.add(map->mark, fmt::format("'{}' of cue is missing", key), "say where and how long it shows");
}

void StimulusReader::readCatchShows(const YamlNode& node, Stimulus& out) {
  const std::optional<YamlNode> plain = resolved(node);
  if (!plain) return;
  const auto shows = reader_.choice(*plain, "catch_shows", {"balanced", "before", "after", "coarse", "fine"});
  if (!shows) return;
  balancesUnchanged_ = *shows == "balanced";
  const bool byLevel = *shows == "coarse" || *shows == "fine";
  if (byLevel && !out.levels)
    reader_.problems().add(node.mark, "'catch_shows: " + *shows + "' of a stimulus without levels",
                           "techniques have no order: write before, after or balanced");
  if (byLevel && out.levels)
    out.catchShowsAfter = (out.levels->after > out.levels->before) == (*shows == "coarse");
  else
    out.catchShowsAfter = *shows == "after";
}

std::optional<Stimulus> StimulusReader::read(const StimulusTemplate& source, const Variables& variables) {
  Problems& problems = reader_.problems();
  const size_t before = problems.size();
  variables_ = &variables;
  const YamlNode& map = source.node;
  Stimulus out;
  if (!reader_.isMap(map, "'stimulus'", "{scene: {name: ...}, levels: {before: 1, after: 0}}")) return {};
  reader_.checkKeys(map, "stimulus",
                    {"scene", "levels", "before", "after", "shading", "presentation", "duration_s",
                     "change_at_s", "start_s", "showings", "gap_s", "samples", "catch_shows", "cue"});
  if (const YamlNode* scene = map.find("scene")) {
    if (const auto entry = readEntry(*scene, "scene", catalogue_.scenes)) out.scene = *entry;
  } else {
    problems.add(map.mark, "'scene' of a stimulus is missing", std::string("give it: ") + kEntryExample);
  }
  readChange(map, out);
  take(map, "presentation", out.presentation);
  balancesUnchanged_ = true;
  if (const YamlNode* catchShows = map.find("catch_shows")) readCatchShows(*catchShows, out);
  take(map, "duration_s", Range{0.02, 600}, "s", out.durationS);
  out.changeAtS = 0.5 * out.durationS;
  take(map, "change_at_s", Range{0, 600}, "s", out.changeAtS);
  take(map, "start_s", Range{-600, 3600}, "s", out.sceneStartS);
  take(map, "showings", Range{1, 20}, "", out.showings);
  take(map, "gap_s", Range{0, 60}, "s", out.gapS);
  take(map, "samples", Range{1, 16}, "", out.samples);
  if (const YamlNode* cue = map.find("cue")) readCue(*cue, out);
  out.changes = out.levels || out.after;
  if (out.changes && !(out.changeAtS > 0.0 && out.changeAtS < out.durationS)) {
    const YamlNode* at = map.find("change_at_s");
    problems.add(at ? at->mark : map.mark,
                 fmt::format("the change comes at {} s of {} s", shortestNumber(out.changeAtS),
                             shortestNumber(out.durationS)),
                 "put it within the sequence");
  }
  if (problems.size() != before) return {};
  return out;
}

}  // namespace limen::study
