// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/viewer/setup.h"

#include <algorithm>
#include <array>

#include "experiments/base/error.h"
#include "renderer/scene/scene.h"
#include "renderer/techniques/technique.h"

namespace limen::viewer {
namespace {

using techniques::TechniqueInfo;
using techniques::TechniqueRegistry;

using Values = std::map<std::string, ParameterValue>;

const TechniqueInfo& techniqueNamed(const std::string& name) {
  return TechniqueRegistry::instance().get(name, "technique");
}

const Parameter* findBelow(const std::vector<Parameter>& declared, const Entry& entry,
                           const std::string& path, const std::string& prefix) {
  for (const Parameter& parameter : declared) {
    const std::string own = joinPath(prefix, parameter.name);
    const bool isGroup = parameter.type == ParameterType::Group;
    if (own == path) return isGroup ? nullptr : &parameter;
    if (path.rfind(own + ".", 0) != 0) continue;
    if (isGroup) return findBelow(parameter.alternatives.at(0).parameters, entry, path, own);
    if (parameter.type != ParameterType::Choice) return nullptr;
    const Alternative* chosen =
        findAlternative(parameter, std::get<std::string>(valueAt(entry, own, parameter)));
    return chosen ? findBelow(chosen->parameters, entry, path, own) : nullptr;
  }
  return nullptr;
}

/// Removes the values below `path` and returns them.
Values takeBelow(Values& values, const std::string& path) {
  Values out;
  for (auto value = values.begin(); value != values.end();) {
    const auto next = std::next(value);
    if (value->first.rfind(path + ".", 0) == 0) out.insert(values.extract(value));
    value = next;
  }
  return out;
}

}  // namespace

experiments::Configuration completeScene(const Entry& entry) {
  const scene::SceneInfo& info = scene::SceneRegistry::instance().get(entry.name, "scene");
  return {entry.name, info.version, {info.allParameters(), entry.given, "scene '" + entry.name + "'"}};
}

experiments::Configuration completeTechnique(const Entry& entry) {
  const TechniqueInfo& info = techniqueNamed(entry.name);
  experiments::Configuration out{
      entry.name, info.version,
      ParameterValues(info.parameters, entry.given, "technique '" + entry.name + "'")};
  if (info.check) info.check(out.values);
  return out;
}

std::vector<Parameter> sceneParameters(const std::string& name) {
  return scene::SceneRegistry::instance().get(name, "scene").allParameters();
}

const std::vector<Parameter>& techniqueParameters(const std::string& name) {
  return techniqueNamed(name).parameters;
}

std::vector<Parameter> techniqueParameters(const Entry& entry) {
  const std::vector<Parameter>& declared = techniqueParameters(entry.name);
  return withPresets(declared, entry.given).value_or(declared);
}

const ParameterValue& valueAt(const Entry& entry, const std::string& path, const Parameter& parameter) {
  const auto given = entry.given.find(path);
  return given == entry.given.end() ? parameter.defaultValue : given->second;
}

const Parameter* findDeclaration(const std::vector<Parameter>& declared, const Entry& entry,
                                 const std::string& path) {
  return findBelow(declared, entry, path, {});
}

void dropAbsent(Entry& entry, const std::vector<Parameter>& declared) {
  // Removing one may make others absent: those below it.
  while (std::erase_if(
      entry.given, [&](const auto& one) { return findDeclaration(declared, entry, one.first) == nullptr; })) {
  }
}

void setParameter(Entry& entry, const std::vector<Parameter>& declared, const std::string& path,
                  const ParameterValue& value) {
  const Parameter* found = findDeclaration(declared, entry, path);
  if (!found) {
    // Says which parameters there are, or under which alternative this one exists.
    Values given = entry.given;
    given[path] = value;
    ParameterValues(declared, given, entry.name);
    throw Error("'" + path + "' has no value of its own", entry.name);
  }
  Parameter parameter = *found;
  parameter.name = path;  // as messages are to call it
  ParameterValue valid = validate(parameter, value, entry.name);
  if (!parameter.alternatives.empty() && valid != valueAt(entry, path, parameter))
    takeBelow(entry.given, path);
  if (!parameter.required && valid == parameter.defaultValue)
    entry.given.erase(path);
  else
    entry.given[path] = std::move(valid);
}

void ParameterMemory::set(Entry& entry, const std::vector<Parameter>& declared, const std::string& path,
                          const ParameterValue& value) {
  const Parameter* parameter = findDeclaration(declared, entry, path);
  if (!parameter || parameter->alternatives.empty() || parameter->type != ParameterType::Choice)
    return setParameter(entry, declared, path, value);
  const auto memoryOf = [&](const ParameterValue& kind) {
    return entry.name + "|" + path + "=" + toText(kind);
  };
  const ParameterValue before = valueAt(entry, path, *parameter);
  Entry next = entry;
  Values left = takeBelow(next.given, path);
  setParameter(entry, declared, path, value);
  const ParameterValue now = valueAt(entry, path, *parameter);
  if (now == before) return;
  earlier_[memoryOf(before)] = std::move(left);
  if (const auto back = earlier_.find(memoryOf(now)); back != earlier_.end())
    entry.given.insert(back->second.begin(), back->second.end());
}

std::vector<std::string> comparable(const std::string& technique) {
  const techniques::ProductKind kind = techniqueNamed(technique).product;
  std::vector<std::string> references, others;
  for (const auto& [name, info] : TechniqueRegistry::instance().all())
    if (info.product == kind) (info.reference ? references : others).push_back(name);
  references.insert(references.end(), others.begin(), others.end());
  return references;
}

std::optional<Entry> usualReference(const std::string& technique) {
  const TechniqueInfo& shown = techniqueNamed(technique);
  const techniques::ProductKind kind = shown.product;
  // What one family shows another may not: occlusion alone, or mirrors. Of curved surfaces the mesh is an
  // approximation of its own. Rays against the exact triangles share no approximation with any technique; a
  // reference that can start coarse shows something soon.
  const auto family = [](const std::string& name) { return name.substr(0, name.find('/')); };
  const auto isCurved = [](const TechniqueInfo& info) {
    return std::find(info.needs.begin(), info.needs.end(), "curved_surfaces") != info.needs.end();
  };
  const auto worth = [&](const TechniqueInfo& info) {
    const bool own = !isCurved(shown) && family(info.name) == family(technique);
    return (own ? 8 : 0) + (isCurved(info) && isCurved(shown) ? 4 : 0) + (info.effort.empty() ? 0 : 2) +
           (info.onCpu ? 1 : 0);
  };
  const TechniqueInfo* best = nullptr;
  for (const auto& [name, info] : TechniqueRegistry::instance().all())
    if (info.reference && info.product == kind && name != technique && (!best || worth(info) > worth(*best)))
      best = &info;
  return best ? std::optional(Entry{best->name, {}}) : std::nullopt;
}

std::vector<Entry> fromCoarseToFine(const Entry& reference) {
  const TechniqueInfo& info = techniqueNamed(reference.name);
  const Parameter* effort = findDeclaration(info.parameters, reference, info.effort);
  std::vector<Entry> steps;
  if (effort && effort->type == ParameterType::Integer) {
    const int64_t most = std::get<int64_t>(valueAt(reference, info.effort, *effort));
    // In powers of four, since some count samples along each axis.
    for (const int64_t divisor : {256, 64, 16, 4}) {
      if (most % divisor != 0) continue;
      Entry step = reference;
      try {
        setParameter(step, info.parameters, info.effort, most / divisor);
        completeTechnique(step);
      } catch (const Error&) {
        continue;  // too few for this technique
      }
      steps.push_back(std::move(step));
    }
  }
  steps.push_back(reference);
  return steps;
}

}  // namespace limen::viewer
