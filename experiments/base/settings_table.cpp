// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/base/settings_table.h"

#include "experiments/base/error.h"

namespace limen {
namespace {

/// Runs `read`, prefixing `prefix` to the location in any error.
template <class Read>
void readBelow(const std::string& prefix, const Read& read) {
  try {
    read();
  } catch (const Error& error) {
    throw Error(error.message(), error.where().empty() ? prefix : joinPath(prefix, error.where()),
                error.hint());
  }
}

}  // namespace

namespace settings {

Parameter state(ParameterType type, std::string name, std::string description, std::string source) {
  Parameter out;
  out.name = std::move(name);
  out.type = type;
  out.description = std::move(description);
  out.source = std::move(source);
  return out;
}

void ValueAccess::declare(const Parameter& stated, const void* defaults, std::vector<Parameter>& out) const {
  out.push_back(stated);
  out.back().defaultValue = get(defaults);
}

void ValueAccess::read(const Parameter& stated, void* settings, const ParameterValues& values,
                       const std::string& prefix) const {
  set(settings, values.all().at(joinPath(prefix, stated.name)));
}

void ValueAccess::write(const Parameter& stated, const void* settings, const std::string& prefix,
                        std::map<std::string, ParameterValue>& out) const {
  out[joinPath(prefix, stated.name)] = get(settings);
}

void StructAccess::declare(const Parameter& stated, const void* defaults, std::vector<Parameter>& out) const {
  std::vector<Parameter> members = layout().parametersOf(member(defaults));
  if (named_) {
    out.push_back(stated);
    out.back().alternatives = {{{}, {}, std::move(members)}};
  } else {
    for (Parameter& parameter : members) out.push_back(std::move(parameter));
  }
}

void StructAccess::read(const Parameter& stated, void* settings, const ParameterValues& values,
                        const std::string& prefix) const {
  void* part = member(settings);
  if (!named_) return layout().readInto(part, values, prefix);
  readBelow(stated.name, [&] { layout().readInto(part, values, joinPath(prefix, stated.name)); });
}

void StructAccess::write(const Parameter& stated, const void* settings, const std::string& prefix,
                         std::map<std::string, ParameterValue>& out) const {
  layout().writeFrom(member(settings), named_ ? joinPath(prefix, stated.name) : prefix, out);
}

void VariantAccess::declare(const Parameter& stated, const void* defaults,
                            std::vector<Parameter>& out) const {
  Parameter parameter = stated;
  const std::vector<AlternativeType> all = types();
  for (size_t i = 0; i < all.size(); ++i) {
    const bool isDefault = i == index(defaults);
    if (isDefault) parameter.defaultValue = std::string(all[i].kind);
    const std::shared_ptr<void> fresh = make(i);
    std::vector<Parameter> members;
    if (all[i].layout) members = all[i].layout->parametersOf(isDefault ? held(defaults) : fresh.get());
    parameter.alternatives.push_back({all[i].kind, all[i].summary, std::move(members)});
  }
  out.push_back(std::move(parameter));
}

void VariantAccess::read(const Parameter& stated, void* settings, const ParameterValues& values,
                         const std::string& prefix) const {
  const std::string path = joinPath(prefix, stated.name);
  const auto& kind = std::get<std::string>(values.all().at(path));
  const std::vector<AlternativeType> all = types();
  size_t i = 0;
  while (i + 1 < all.size() && all[i].kind != kind) ++i;
  void* alternative = emplace(settings, i);
  if (all[i].layout) readBelow(stated.name, [&] { all[i].layout->readInto(alternative, values, path); });
}

void VariantAccess::write(const Parameter& stated, const void* settings, const std::string& prefix,
                          std::map<std::string, ParameterValue>& out) const {
  const std::string path = joinPath(prefix, stated.name);
  const AlternativeType type = types().at(index(settings));
  out[path] = std::string(type.kind);
  if (type.layout) type.layout->writeFrom(held(settings), path, out);
}

}  // namespace settings

std::vector<Parameter> SettingsLayout::parametersOf(const void* defaults) const {
  std::vector<Parameter> out;
  for (const Member& member : members_) member.access->declare(member.stated, defaults, out);
  return out;
}

void SettingsLayout::readInto(void* settings, const ParameterValues& values,
                              const std::string& prefix) const {
  for (const Member& member : members_) member.access->read(member.stated, settings, values, prefix);
  if (check_) check_(settings);
}

void SettingsLayout::writeFrom(const void* settings, const std::string& prefix,
                               std::map<std::string, ParameterValue>& out) const {
  for (const Member& member : members_) member.access->write(member.stated, settings, prefix, out);
}

}  // namespace limen
