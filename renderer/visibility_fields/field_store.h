// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "renderer/visibility_fields/field_form.h"
#include "renderer/visibility_fields/rigid_objects.h"

namespace limen::visibility_fields {

/// An object's field as it is stored.
struct StoredField {
  std::vector<uint32_t> words;  ///< of all maps
  std::vector<float> means;     ///< of each map: what a field of one bit has in place of distances
};

/// Fields in a folder, named by a hash of everything that determines them: the object in units of its sphere,
/// the form, the device that made them and the version of the code. Safe to share between processes: files
/// appear atomically.
class FieldStore {
 public:
  /// `folder` is made when the first field is kept.
  FieldStore(std::string folder, std::string device)
      : folder_(std::move(folder)), device_(std::move(device)) {}

  std::string path(const RigidObject& object, const FieldForm& form) const;
  /// None if there is no such file, or one that is damaged or of other sizes.
  std::optional<StoredField> read(const std::string& path, size_t words, size_t means) const;
  /// Throws Error if the file cannot be written.
  void write(const std::string& path, const StoredField& field) const;

 private:
  std::string folder_, device_;
};

}  // namespace limen::visibility_fields
