// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <initializer_list>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "experiments/base/parameter.h"

namespace limen {

/// The declarations of a registered scene, technique or metric. They are made on first use, since
/// they may name entries of registries that are still being filled while the program starts. Copies share one
/// list.
class ParameterList {
 public:
  ParameterList() : ParameterList(std::vector<Parameter>{}) {}
  ParameterList(std::vector<Parameter> parameters)
      : ParameterList([parameters = std::move(parameters)] { return parameters; }) {}
  ParameterList(std::initializer_list<Parameter> parameters)
      : ParameterList(std::vector<Parameter>(parameters)) {}
  ParameterList(std::function<std::vector<Parameter>()> make) : state_(std::make_shared<State>()) {
    state_->make = std::move(make);
  }

  const std::vector<Parameter>& get() const {
    std::call_once(state_->once, [this] { state_->parameters = state_->make(); });
    return state_->parameters;
  }
  operator const std::vector<Parameter>&() const { return get(); }
  auto begin() const { return get().begin(); }
  auto end() const { return get().end(); }
  size_t size() const { return get().size(); }
  bool empty() const { return get().empty(); }

 private:
  struct State {
    std::function<std::vector<Parameter>()> make;
    std::once_flag once;
    std::vector<Parameter> parameters;
  };
  std::shared_ptr<State> state_;
};

}  // namespace limen
