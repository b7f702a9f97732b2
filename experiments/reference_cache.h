// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <list>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "experiments/base/image.h"

namespace limen::experiments {

/// A reference's product with what is to be known of how it was made (Technique::remarks()): which tracer,
/// for example, where the descriptor leaves that open.
struct Reference {
  std::shared_ptr<const Image> image;
  std::vector<std::string> remarks;
};

/// Reference products on disk (32-bit EXR, and their remarks beside them as JSON), named by a hash of
/// everything that determines them. Safe to share between processes and hosts: files appear atomically, and
/// of several that need the same one, one makes it while the others wait.
class ReferenceCache {
 public:
  explicit ReferenceCache(std::string folder, size_t bytesInMemory = size_t{256} << 20)
      : folder_(std::move(folder)), bytesInMemory_(bytesInMemory) {}

  /// The product named `key` of `width` x `height` pixels, made by `make` if neither memory nor disk has it
  /// with its remarks, or a file of another size. Memory holds those used last.
  Reference get(const std::string& key, int width, int height, const std::function<Reference()>& make);

 private:
  struct Held {
    std::string key;
    Reference reference;
  };
  std::string pictureOf(const std::string& key) const;
  std::string remarksOf(const std::string& key) const;
  /// None if the disk does not have it whole.
  std::optional<Reference> read(const std::string& key, int width, int height) const;
  void hold(const std::string& key, Reference reference);

  std::string folder_;
  size_t bytesInMemory_;
  std::list<Held> held_;  ///< most recently used first
};

}  // namespace limen::experiments
