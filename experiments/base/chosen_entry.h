// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "experiments/base/registry.h"
#include "experiments/base/settings_table.h"

namespace limen {

/// A member of a settings struct that names an entry of a registry together with that entry's own settings,
/// as a technique that wraps another one does: `inner: {kind: bitmask, budget: 64}`.
struct ChosenEntry {
  std::string name;        ///< as registered: "soft_shadows/bitmask"
  ParameterValues values;  ///< complete; empty in defaults: the entry's own
};

/// All values of an entry of Info's registry: what `chosen` leaves out takes its default. Throws Error.
template <class Info>
ParameterValues completeValues(const ChosenEntry& chosen, const std::string& where = {}) {
  const std::vector<Parameter>& declared = Registry<Info>::instance().get(chosen.name, where).parameters;
  return {declared, chosen.values.all(), where};
}

namespace settings {

/// Which entries may be chosen, with what they declare.
struct EntryOptions {
  std::vector<std::string> names;  ///< as registered
  std::function<const std::vector<Parameter>&(const std::string& name)> parametersOf;
  /// Throws Error if the values of an entry contradict each other, `where` being a path within them.
  std::function<void(const std::string& name, const ParameterValues& values)> check = {};
};

class EntryAccess : public MemberAccess {
 public:
  explicit EntryAccess(EntryOptions options) : options_(std::move(options)) {}
  virtual const ChosenEntry& entry(const void* settings) const = 0;
  virtual ChosenEntry& entry(void* settings) const = 0;

  void declare(const Parameter& stated, const void* defaults, std::vector<Parameter>& out) const override;
  void read(const Parameter& stated, void* settings, const ParameterValues& values,
            const std::string& prefix) const override;
  void write(const Parameter& stated, const void* settings, const std::string& prefix,
             std::map<std::string, ParameterValue>& out) const override;

 private:
  EntryOptions options_;
};

template <class S>
class EntryMember : public EntryAccess {
 public:
  EntryMember(ChosenEntry S::*member, EntryOptions options)
      : EntryAccess(std::move(options)), member_(member) {}
  const ChosenEntry& entry(const void* settings) const override {
    return static_cast<const S*>(settings)->*member_;
  }
  ChosenEntry& entry(void* settings) const override { return static_cast<S*>(settings)->*member_; }

 private:
  ChosenEntry S::*member_;
};

}  // namespace settings

/// Binds a ChosenEntry to some entries of Info's registry. Descriptors name an entry by the last part of its
/// name: "bitmask" for "soft_shadows/bitmask".
template <class Info, class S>
Binding<S> registeredChoice(ChosenEntry S::*member, std::string name, std::vector<std::string> entries,
                            std::string description, std::string source = {}) {
  settings::EntryOptions options{std::move(entries),
                                 [](const std::string& entry) -> const std::vector<Parameter>& {
                                   return Registry<Info>::instance().get(entry).parameters;
                                 },
                                 [](const std::string& entry, const ParameterValues& values) {
                                   if constexpr (requires(const Info& info) { info.check(values); }) {
                                     const Info& info = Registry<Info>::instance().get(entry);
                                     if (info.check) info.check(values);
                                   }
                                 }};
  return {settings::state(ParameterType::Choice, std::move(name), std::move(description), std::move(source)),
          std::make_shared<settings::EntryMember<S>>(member, std::move(options))};
}

}  // namespace limen
