// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cassert>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "experiments/base/error.h"
#include "experiments/base/text.h"

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

  /// For a declaration that is made from other registries' entries: `make` is called when this registry is
  /// first queried, which must not be before main().
  void addLater(std::function<Info()> make) { later_.push_back(std::move(make)); }

  const Info* find(const std::string& name) const {
    addAwaited();
    const auto entry = entries_.find(name);
    return entry == entries_.end() ? nullptr : &entry->second;
  }

  /// Throws Error naming the nearest known name.
  const Info& get(const std::string& name, const std::string& where = {}) const {
    if (const Info* info = find(name)) return *info;
    throw Error(std::string("no ") + Info::kKind + " '" + name + "'", where, suggest(name, names()));
  }

  std::vector<std::string> names() const {
    addAwaited();
    std::vector<std::string> out;
    for (const auto& [name, info] : entries_) out.push_back(name);
    return out;
  }

  const std::map<std::string, Info>& all() const {
    addAwaited();
    return entries_;
  }

 private:
  void addAwaited() const {
    const std::scoped_lock lock(guard_);
    if (later_.empty()) return;
    for (const std::function<Info()>& make : std::exchange(later_, {})) {
      Info info = make();
      const std::string name = info.name;
      [[maybe_unused]] const bool fresh = entries_.emplace(name, std::move(info)).second;
      assert(fresh && "a name is registered twice");
    }
  }

  mutable std::map<std::string, Info> entries_;
  mutable std::vector<std::function<Info()>> later_;
  mutable std::mutex guard_;
};

/// Registers at program start: `const Registered<SceneInfo> kCombRegistered{SceneInfo{...}};` at the end of a
/// .cpp.
template <class Info>
struct Registered {
  explicit Registered(Info info) { Registry<Info>::instance().add(std::move(info)); }
};

/// The same where the declaration is made from other registries, whose entries may not be there yet while the
/// program starts: `const RegisteredLater<TechniqueInfo> kSwitchRegistered{[] { return TechniqueInfo{...};
/// }};`
template <class Info>
struct RegisteredLater {
  explicit RegisteredLater(std::function<Info()> make) {
    Registry<Info>::instance().addLater(std::move(make));
  }
};

}  // namespace limen
