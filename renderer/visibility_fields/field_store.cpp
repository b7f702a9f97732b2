// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/visibility_fields/field_store.h"

#include <cstring>
#include <filesystem>
#include <fstream>

#include "experiments/base/hash.h"
#include "experiments/base/part_file.h"

namespace limen::visibility_fields {
namespace {

/// Raised when fields of the same object and form change.
constexpr int kStoreVersion = 1;
constexpr size_t kHashLetters = 64;

template <class T>
void add(Sha256& hash, const std::vector<T>& values) {
  const uint64_t count = values.size();
  hash.update(&count, sizeof(count));
  if (count > 0) hash.update(values.data(), count * sizeof(T));
}

template <class T>
std::string_view bytesIn(const std::vector<T>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

std::string contentHash(const StoredField& field) {
  return Sha256().update(bytesIn(field.words)).update(bytesIn(field.means)).hex();
}

}  // namespace

std::string FieldStore::path(const RigidObject& object, const FieldForm& form) const {
  Sha256 hash;
  hash.update(device_ + '\n');
  for (const int number :
       {kStoreVersion, static_cast<int>(form.positionMap), form.positions,
        static_cast<int>(form.directionMap), form.directions, form.bits, form.distanceBits})
    hash.update(std::to_string(number) + '\n');
  add(hash, object.vertices);
  add(hash, object.triangles);
  add(hash, form.distanceBits > 0 ? object.normals : std::vector<glm::vec3>());
  return folder_ + "/" + hash.hex() + ".field";
}

std::optional<StoredField> FieldStore::read(const std::string& path, size_t words, size_t means) const {
  std::error_code code;
  const size_t expected = kHashLetters + words * sizeof(uint32_t) + means * sizeof(float);
  if (std::filesystem::file_size(path, code) != expected || code) return std::nullopt;
  std::ifstream in(path, std::ios::binary);
  std::string hash(kHashLetters, '\0');
  StoredField field{std::vector<uint32_t>(words), std::vector<float>(means)};
  in.read(hash.data(), kHashLetters);
  in.read(reinterpret_cast<char*>(field.words.data()),
          static_cast<std::streamsize>(words * sizeof(uint32_t)));
  in.read(reinterpret_cast<char*>(field.means.data()), static_cast<std::streamsize>(means * sizeof(float)));
  if (!in || contentHash(field) != hash) return std::nullopt;
  return field;
}

void FieldStore::write(const std::string& path, const StoredField& field) const {
  std::filesystem::create_directories(folder_);
  PartFile file(path);
  file.write(contentHash(field));
  file.write(bytesIn(field.words));
  file.write(bytesIn(field.means));
  file.putInPlace();
}

}  // namespace limen::visibility_fields
