// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "experiments/base/image.h"

namespace limen::experiments {

/// Reference products on disk (32-bit EXR), named by a hash of all that decides them. Safe to share between
/// processes: files appear whole.
class ReferenceCache {
 public:
  explicit ReferenceCache(std::string folder) : folder_(std::move(folder)) {}

  /// The product named `key`, made by `make` if neither memory nor disk has it. Memory keeps the latest only.
  const Image& get(const std::string& key, const std::function<Image()>& make);

 private:
  std::string folder_, key_;
  Image image_;
};

}  // namespace limen::experiments
