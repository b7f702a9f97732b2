// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cassert>
#include <map>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/text.h"

namespace limen {

/// All scenes, techniques or metrics of the program, by path-like name ("soft_shadows/bitmask"). `Info` has
/// members `name` and a static `kKind` ("technique") that error messages use.
template <class Info>
class Registry {
 public:
  static Registry& instance() {
    static Registry registry;
    return registry;
  }

  void add(Info info) {
    const std::string name = info.name;
    [[maybe_unused]] const bool fresh = entries_.emplace(name, std::move(info)).second;
    assert(fresh && "a name is registered twice");
  }

  const Info* find(const std::string& name) const {
    const auto entry = entries_.find(name);
    return entry == entries_.end() ? nullptr : &entry->second;
  }

  /// Throws Error naming the nearest known name.
  const Info& get(const std::string& name, const std::string& where = {}) const {
    if (const Info* info = find(name)) return *info;
    throw Error(std::string("no ") + Info::kKind + " '" + name + "'", where, suggest(name, names()));
  }

  std::vector<std::string> names() const {
    std::vector<std::string> out;
    for (const auto& [name, info] : entries_) out.push_back(name);
    return out;
  }

  const std::map<std::string, Info>& all() const { return entries_; }

 private:
  std::map<std::string, Info> entries_;
};

/// Registers at program start: `const Registered<SceneInfo> kRegistered{SceneInfo{...}};` at the end of a
/// .cpp.
template <class Info>
struct Registered {
  explicit Registered(Info info) { Registry<Info>::instance().add(std::move(info)); }
};

}  // namespace limen
