// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/visibility_fields/visibility_fields.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <bit>
#include <glm/gtc/packing.hpp>
#include <span>
#include <string>

#include "experiments/base/error.h"
#include "renderer/ray_tracing/ray_scene.h"
#include "renderer/visibility_fields/field_bindings.h"
#include "renderer/visibility_fields/field_store.h"
#include "renderer/visibility_fields/field_words.h"
#include "renderer/visibility_fields/run_lengths.h"

namespace limen::visibility_fields {
namespace {

constexpr int kMostSlices = 2048;  // granted by OpenGL 4.5
constexpr int kFewSlices = 64, kLargestSlice = 4096;

glm::ivec2 tileOf(const FieldForm& form) { return {form.wordsPerRow(), form.directions}; }

int64_t mapsPerSlice(int side, glm::ivec2 tile) { return int64_t{side / tile.x} * (side / tile.y); }

int sliceSideFor(int64_t maps, glm::ivec2 tile) {
  int side = std::max(tile.x, tile.y);
  while (side < kLargestSlice && mapsPerSlice(side, tile) * kFewSlices < maps) side *= 2;
  return side;
}

/// In order of the texels: words are little-endian on every machine that has OpenGL 4.5.
std::span<const uint8_t> bytesOf(const std::vector<uint32_t>& words) {
  return {reinterpret_cast<const uint8_t*>(words.data()), words.size() * sizeof(uint32_t)};
}

/// Of each triangle's corners, as make_field.comp.glsl reads them.
std::vector<glm::vec4> cornersOf(const RigidObject& object) {
  std::vector<glm::vec4> corners;
  for (const glm::uvec3 t : object.triangles) {
    const glm::vec3 a = object.vertices[t.x];
    const glm::vec3 across = glm::cross(object.vertices[t.y] - a, object.vertices[t.z] - a);
    const glm::vec3 flat = glm::dot(across, across) > 0.0F ? glm::normalize(across) : glm::vec3(0.0F);
    for (int corner = 0; corner < 3; ++corner) {
      const glm::vec3 own = object.normals.empty() ? glm::vec3(0.0F) : object.normals[t[corner]];
      corners.emplace_back(glm::dot(own, own) > 0.0F ? own : flat, flat[corner]);
    }
  }
  return corners;
}

std::vector<glm::vec4> repeated(const std::vector<glm::vec3>& points, size_t times) {
  std::vector<glm::vec4> out;
  out.reserve(points.size() * times);
  for (size_t i = 0; i < times; ++i)
    for (const glm::vec3 p : points) out.emplace_back(p, 0.0F);
  return out;
}

}  // namespace

VisibilityFields::VisibilityFields(gl::Context& context, const std::vector<RigidObject>& objects,
                                   const FieldForm& form, int tolerance, const std::string& folder)
    : form_(form),
      positionMap_(form.positionMap, form.positions),
      objectCount_(static_cast<uint32_t>(objects.size())),
      sliceSide_(sliceSideFor(int64_t{mapsPerObject()} * objectCount_, tileOf(form))),
      maps_(repeated(positionMap_.points(), objects.size())),
      objects_(static_cast<int64_t>(objects.size() * sizeof(FieldObject)), nullptr) {
  for (const RigidObject& object : objects) {
    owners_.push_back(object.owner);
    albedos_.push_back(glm::packUnorm4x8(glm::vec4(object.albedo, 0.0F)));
  }
  const int64_t maps = int64_t{mapsPerObject()} * objectCount_, each = mapsPerSlice(sliceSide_, tileOf(form));
  const int64_t slices = std::max<int64_t>((maps + each - 1) / each, 1);
  if (slices > kMostSlices)
    throw Error(
        "fields of " + std::to_string(objectCount_) + " objects take " + std::to_string(bytes()) + " bytes",
        "directions", "store fewer positions, directions or bits");
  words_.emplace(gl::Format::R32UI, glm::ivec2(sliceSide_), 1, static_cast<int>(slices));
  fieldsRead_ = readOrMake(context, objects, folder);
  if (tolerance > 0 && form_.bits == 8) lengthen(tolerance);
  std::vector<Pose> poses;
  for (const RigidObject& object : objects) poses.push_back(poseOf(object));
  place(poses, glm::dvec3(0.0));
}

gl::ShaderDefines VisibilityFields::defines() const {
  gl::ShaderDefines defines = form_.defines();
  defines["FIELD_SLICE_SIDE"] = std::to_string(sliceSide_);
  return defines;
}

void VisibilityFields::make(gl::Context& context, const RigidObject& object, uint32_t index) const {
  const gl::ShaderDefines defines = this->defines();
  const gl::Program& program =
      context.programs().compute("renderer/visibility_fields/make_field.comp.glsl", defines);
  const ray_tracing::RayScene rays(context, object.vertices, object.triangles);
  const glm::ivec2 tile = tileOf(form_);
  const int wordsPerMap = tile.x * tile.y, firstMap = static_cast<int>(index) * mapsPerObject();
  const gl::Buffer cutShort(std::vector<uint32_t>{0});
  std::optional<gl::Buffer> sums, corners;
  if (form_.distanceBits > 0) corners.emplace(cornersOf(object));
  if (form_.bits == 1) sums.emplace(int64_t{8} * wordsPerMap * mapsPerObject(), nullptr);
  rays.bind(program);
  maps_.bindStorage(kFieldMapsBuffer);
  cutShort.bindStorage(kFieldCutShortBuffer);
  if (sums) sums->bindStorage(kFieldSumsBuffer);
  if (corners) corners->bindStorage(kFieldCornersBuffer);
  words_->bindImage(kFieldWordsImage, gl::Access::Write);
  program.set("firstMap", firstMap);
  program.dispatch({wordsPerMap, mapsPerObject()}, {kFieldMakeGroup, 1});
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_TEXTURE_UPDATE_BARRIER_BIT |
                  GL_SHADER_STORAGE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
  if (sums) {
    const gl::Program& mean =
        context.programs().compute("renderer/visibility_fields/mean_distances.comp.glsl");
    maps_.bindStorage(kFieldMapsBuffer);
    sums->bindStorage(kFieldSumsBuffer);
    mean.set("firstMap", firstMap);
    mean.set("mapCount", mapsPerObject());
    mean.set("wordsPerMap", wordsPerMap);
    mean.dispatch({mapsPerObject(), 1}, {kFieldMakeGroup, 1});
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
  }
  if (cutShort.read<uint32_t>()[0] > 0)
    throw Error("rays against '" + object.name + "' take more steps than this software renderer allows", {},
                "use fewer bits of a simpler object, or a GPU");
}

void VisibilityFields::place(const std::vector<Pose>& poses, glm::dvec3 anchor) {
  std::vector<FieldObject> objects;
  for (const Pose& pose : poses) {
    FieldObject object{};
    object.centre = pose.centre - anchor;
    object.radius = static_cast<float>(pose.radius);
    object.axisX = glm::vec4(pose.axes[0], 0.0), object.axisY = glm::vec4(pose.axes[1], 0.0);
    object.axisZ = glm::vec4(pose.axes[2], 0.0);
    object.owner = owners_[objects.size()], object.albedo = albedos_[objects.size()];
    object.firstMap = static_cast<uint32_t>(objects.size()) * static_cast<uint32_t>(mapsPerObject());
    objects.push_back(object);
  }
  if (!objects.empty())
    objects_.write(0, static_cast<int64_t>(objects.size() * sizeof(FieldObject)), objects.data());
}

void VisibilityFields::bind(const gl::Program& program) const {
  objects_.bindStorage(kFieldObjectsBuffer);
  maps_.bindStorage(kFieldMapsBuffer);
  words_->bindTexture(kFieldWordsUnit);
  program.set("fieldObjectCount", objectCount_);
}

int64_t VisibilityFields::rayCount() const {
  return int64_t{mapsPerObject()} * objectCount_ * form_.directions * form_.directions;
}

int64_t VisibilityFields::bytes() const {
  return int64_t{4} * mapsPerObject() * objectCount_ * form_.wordsPerRow() * form_.directions;
}

int64_t VisibilityFields::bytesHeld() const { return words_->bytes() + maps_.bytes() + objects_.bytes(); }

int64_t VisibilityFields::runLengthBytes() const {
  int64_t bytes = 0;
  for (uint32_t object = 0; object < objectCount_; ++object) {
    const std::vector<uint32_t> words = readWords(object);
    bytes += static_cast<int64_t>(encodeRuns(bytesOf(words)).size());
  }
  return bytes;
}

uint32_t VisibilityFields::readOrMake(gl::Context& context, const std::vector<RigidObject>& objects,
                                      const std::string& folder) const {
  if (folder.empty()) {
    for (uint32_t i = 0; i < objectCount_; ++i) make(context, objects[i], i);
    return 0;
  }
  const FieldStore store(folder, context.device().line());
  const glm::ivec2 tile = tileOf(form_);
  const auto words = static_cast<size_t>(mapsPerObject()) * static_cast<size_t>(tile.x * tile.y),
             means = static_cast<size_t>(form_.bits == 1 ? mapsPerObject() : 0);
  std::vector<std::vector<uint32_t>> found(objectCount_);
  uint32_t count = 0;
  for (uint32_t i = 0; i < objectCount_; ++i) {
    const std::string path = store.path(objects[i], form_);
    if (std::optional<StoredField> field = store.read(path, words, means)) {
      found[i] = std::move(field->words), ++count;
      std::vector<glm::vec4> maps = repeated(positionMap_.points(), 1);
      for (size_t map = 0; map < field->means.size(); ++map) maps[map].w = field->means[map];
      const auto bytes = static_cast<int64_t>(maps.size() * sizeof(glm::vec4));
      maps_.write(bytes * i, bytes, maps.data());
      continue;
    }
    make(context, objects[i], i);
    store.write(path, {readWords(i), readMeans(i)});
  }
  if (count > 0) writeWords(found);
  return count;
}

std::vector<float> VisibilityFields::readMeans(uint32_t object) const {
  std::vector<float> means;
  if (form_.bits == 1)
    for (const glm::vec4 map : maps_.read<glm::vec4>(
             static_cast<int64_t>(sizeof(glm::vec4)) * mapsPerObject() * object, mapsPerObject()))
      means.push_back(map.w);
  return means;
}

void VisibilityFields::writeWords(const std::vector<std::vector<uint32_t>>& ofObjects) const {
  const glm::ivec2 tile = tileOf(form_);
  const auto side = static_cast<size_t>(sliceSide_);
  const auto slices = static_cast<size_t>(words_->bytes()) / (sizeof(uint32_t) * side * side);
  std::vector<std::vector<uint32_t>> texels;
  for (size_t slice = 0; slice < slices; ++slice)
    texels.push_back(words_->readUintLayer(static_cast<int>(slice)));
  for (size_t object = 0; object < ofObjects.size(); ++object) {
    if (ofObjects[object].empty()) continue;
    size_t next = 0;
    for (int map = 0; map < mapsPerObject(); ++map)
      for (int y = 0; y < tile.y; ++y)
        for (int x = 0; x < tile.x; ++x) {
          const glm::ivec3 at =
              fieldWordPlace(static_cast<int>(object) * mapsPerObject() + map, {x, y}, tile, sliceSide_);
          texels[static_cast<size_t>(at.z)][static_cast<size_t>(at.y) * side + static_cast<size_t>(at.x)] =
              ofObjects[object][next++];
        }
  }
  for (size_t slice = 0; slice < slices; ++slice) words_->writeUint(texels[slice], static_cast<int>(slice));
}

void VisibilityFields::lengthen(int tolerance) const {
  std::vector<std::vector<uint32_t>> changed(objectCount_);
  for (uint32_t object = 0; object < objectCount_; ++object) {
    std::vector<uint32_t> words = readWords(object);
    lengthenRuns({reinterpret_cast<uint8_t*>(words.data()), words.size() * sizeof(uint32_t)}, tolerance,
                 static_cast<uint8_t>(fieldMissCode(8)));
    changed[object] = std::move(words);
  }
  writeWords(changed);
}

std::vector<uint32_t> VisibilityFields::readWords(uint32_t object) const {
  const glm::ivec2 tile = tileOf(form_);
  std::vector<uint32_t> out;
  std::vector<uint32_t> slice;
  int held = -1;
  for (int map = 0; map < mapsPerObject(); ++map)
    for (int y = 0; y < tile.y; ++y)
      for (int x = 0; x < tile.x; ++x) {
        const glm::ivec3 at =
            fieldWordPlace(static_cast<int>(object) * mapsPerObject() + map, {x, y}, tile, sliceSide_);
        if (at.z != held) slice = words_->readUintLayer(at.z), held = at.z;
        out.push_back(
            slice[static_cast<size_t>(at.y) * static_cast<size_t>(sliceSide_) + static_cast<size_t>(at.x)]);
      }
  return out;
}

std::vector<float> VisibilityFields::readShares(uint32_t object) const {
  const std::vector<uint32_t> words = readWords(object);
  const auto maps = maps_.read<glm::vec4>(static_cast<int64_t>(sizeof(glm::vec4)) * mapsPerObject() * object,
                                          mapsPerObject());
  const int perWord = 32 / form_.bits;
  std::vector<float> out;
  for (int map = 0; map < mapsPerObject(); ++map)
    for (int y = 0; y < form_.directions; ++y)
      for (int x = 0; x < form_.directions; ++x) {
        const uint32_t word =
            words[static_cast<size_t>((map * form_.directions + y) * form_.wordsPerRow() + x / perWord)];
        if (form_.distanceBits > 0) {
          const uint32_t code = word & fieldMissCode(form_.distanceBits);
          out.push_back(code == fieldMissCode(form_.distanceBits)
                            ? -1.0F
                            : float(code) * fieldCodeStep(form_.distanceBits));
          continue;
        }
        if (form_.bits == 32) {
          out.push_back(std::bit_cast<float>(word));
          continue;
        }
        const uint32_t code = word >> (form_.bits * (x % perWord)) & ((1U << form_.bits) - 1U);
        const float share =
            form_.bits == 1 ? maps[static_cast<size_t>(map)].w : float(code) * fieldCodeStep(form_.bits);
        out.push_back(code == fieldMissCode(form_.bits) ? -1.0F : share);
      }
  return out;
}

}  // namespace limen::visibility_fields
