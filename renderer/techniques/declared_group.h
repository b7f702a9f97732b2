// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "experiments/base/settings_table.h"

namespace limen::techniques {

/// Values of parameters that a list of declarations describes, in place of a settings struct.
template <class S>
class DeclaredMember : public MemberAccess {
 public:
  using Declare = std::function<std::vector<Parameter>()>;
  DeclaredMember(ParameterValues S::*member, Declare declare)
      : member_(member), declare_(std::move(declare)) {}

  void declare(const Parameter& stated, const void*, std::vector<Parameter>& out) const override {
    std::vector<Parameter> members = declare_();
    if (stated.name.empty()) {
      for (Parameter& parameter : members) out.push_back(std::move(parameter));
      return;
    }
    out.push_back(stated);
    out.back().alternatives = {{{}, {}, std::move(members)}};
  }
  void read(const Parameter& stated, void* settings, const ParameterValues& values,
            const std::string& prefix) const override {
    std::map<std::string, ParameterValue> given;
    for (const DeclaredAt& at : flatten(declare_()))
      if (const ParameterValue* value = values.find(pathOf(stated, prefix, at.path))) given[at.path] = *value;
    static_cast<S*>(settings)->*member_ = ParameterValues(declare_(), given);
  }
  void write(const Parameter& stated, const void* settings, const std::string& prefix,
             std::map<std::string, ParameterValue>& out) const override {
    const ParameterValues complete(declare_(), (static_cast<const S*>(settings)->*member_).all());
    for (const auto& [path, value] : complete.all()) out[pathOf(stated, prefix, path)] = value;
  }

 private:
  static std::string pathOf(const Parameter& stated, const std::string& prefix, const std::string& path) {
    return joinPath(stated.name.empty() ? prefix : joinPath(prefix, stated.name), path);
  }
  ParameterValues S::*member_;
  Declare declare_;
};

/// A group of such parameters; without a name they stand beside the others.
template <class S>
Binding<S> declared(ParameterValues S::*member, std::string name,
                    std::function<std::vector<Parameter>()> declare, std::string description = {}) {
  return {settings::state(ParameterType::Group, std::move(name), std::move(description), {}),
          std::make_shared<DeclaredMember<S>>(member, std::move(declare))};
}

}  // namespace limen::techniques
