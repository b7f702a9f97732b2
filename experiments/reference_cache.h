// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <list>
#include <memory>
#include <string>

#include "experiments/base/image.h"

namespace limen::experiments {

/// Reference products on disk (32-bit EXR), named by a hash of everything that determines them. Safe to share
/// between processes: files appear atomically.
class ReferenceCache {
 public:
  explicit ReferenceCache(std::string folder, size_t bytesInMemory = size_t{256} << 20)
      : folder_(std::move(folder)), bytesInMemory_(bytesInMemory) {}

  /// The product named `key` of `width` x `height` pixels, made by `make` if neither memory nor disk has it,
  /// or a file of another size. Memory holds those used last.
  std::shared_ptr<const Image> get(const std::string& key, int width, int height,
                                   const std::function<Image()>& make);

 private:
  struct Held {
    std::string key;
    std::shared_ptr<const Image> image;
  };
  void hold(const std::string& key, std::shared_ptr<const Image> image);

  std::string folder_;
  size_t bytesInMemory_;
  std::list<Held> held_;  ///< most recently used first
};

}  // namespace limen::experiments
