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
#include "renderer/ray_tracing/ray_tracing_bindings.h"
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

std::vector<glm::vec4> mapsOf(const FieldForm& form) {
  std::vector<glm::vec4> out;
  const PositionMap map(form.positionMap, form.positions);
  for (const glm::vec3 p : map.points()) out.emplace_back(p, 0.0F);
  return out;
}

bool sameForm(const FieldForm& a, const FieldForm& b) {
  return a.positionMap == b.positionMap && a.positions == b.positions && a.directionMap == b.directionMap &&
         a.directions == b.directions && a.bits == b.bits && a.distanceBits == b.distanceBits;
}

}  // namespace

void VisibilityFields::plan(const std::vector<FieldForm>& forms) {
  first_ = forms.empty() ? FieldForm() : forms[0];
  for (const FieldForm& form : forms) varied_ = varied_ || !sameForm(form, first_);
  int64_t maps = 0;
  for (const FieldForm& form : forms) {
    const PositionMap positions(form.positionMap, form.positions);
    kept_.push_back({form, positions.segments(), static_cast<int>(maps),
                     static_cast<int>(positions.points().size()), varied_ ? 0 : static_cast<int>(maps), 0});
    maps += kept_.back().maps;
  }
  int64_t slices = 0;
  const auto slicesOf = [&](const FieldForm& form, int64_t count) {
    const int64_t each = mapsPerSlice(sliceSide_, tileOf(form));
    return (count + each - 1) / each;
  };
  if (!varied_) {
    sliceSide_ = sliceSideFor(maps, tileOf(first_));
    slices = slicesOf(first_, maps);
  } else {
    for (const Kept& kept : kept_)
      sliceSide_ = std::max(sliceSide_, std::max(tileOf(kept.form).x, tileOf(kept.form).y));
    const auto place = [&] {
      slices = 0;
      for (Kept& kept : kept_)
        kept.firstSlice = static_cast<int>(slices), slices += slicesOf(kept.form, kept.maps);
    };
    place();
    while (sliceSide_ < kLargestSlice && slices > kMostSlices) sliceSide_ *= 2, place();
  }
  if (slices > kMostSlices)
    throw Error(
        "fields of " + std::to_string(objectCount_) + " objects take " + std::to_string(bytes()) + " bytes",
        "directions", "store fewer positions, directions or bits");
  slices_ = static_cast<int>(std::max<int64_t>(slices, 1));
}

VisibilityFields::VisibilityFields(gl::Context& context, const std::vector<RigidObject>& objects,
                                   const std::vector<FieldForm>& forms, int tolerance,
                                   const std::string& folder)
    : objectCount_(static_cast<uint32_t>(objects.size())),
      objects_(static_cast<int64_t>(objects.size() * sizeof(FieldObject)), nullptr) {
  for (const RigidObject& object : objects) {
    owners_.push_back(object.owner);
    albedos_.push_back(glm::packUnorm4x8(glm::vec4(object.albedo, 0.0F)));
  }
  plan(forms);
  std::vector<glm::vec4> maps;
  for (const Kept& kept : kept_) {
    const std::vector<glm::vec4> own = mapsOf(kept.form);
    maps.insert(maps.end(), own.begin(), own.end());
  }
  maps_.emplace(maps);
  words_.emplace(gl::Format::R32UI, glm::ivec2(sliceSide_), 1, slices_);
  fieldsRead_ = readOrMake(context, objects, folder);
  if (tolerance > 0) lengthen(tolerance);
  std::vector<Pose> poses;
  for (const RigidObject& object : objects) poses.push_back(poseOf(object));
  place(poses, glm::dvec3(0.0));
}

gl::ShaderDefines VisibilityFields::defines() const {
  gl::ShaderDefines defines = first_.defines();
  defines["FIELD_SLICE_SIDE"] = std::to_string(sliceSide_);
  if (!varied_) return defines;
  defines["FIELD_VARIED"] = "1";
  defines["FIELD_SEGMENTS"] = "fieldSegments", defines["FIELD_SIDE"] = "fieldSide";
  defines["FIELD_BITS"] = defines["FIELD_DISTANCE_BITS"] = "fieldBits";
  defines["FIELD_POSITIONS"] = "fieldPositions";
  return defines;
}

void VisibilityFields::make(gl::Context& context, const RigidObject& object, uint32_t index) const {
  const Kept& kept = kept_[index];
  gl::ShaderDefines defines = kept.form.defines();
  defines["FIELD_SLICE_SIDE"] = std::to_string(sliceSide_);
  const gl::Program& program =
      context.programs().compute("renderer/visibility_fields/make_field.comp.glsl", defines);
  const ray_tracing::RayScene rays(context, object.vertices, object.triangles);
  const glm::ivec2 tile = tileOf(kept.form);
  const int wordsPerMap = tile.x * tile.y;
  const gl::Buffer cutShort(std::vector<uint32_t>{0});
  std::optional<gl::Buffer> sums, corners;
  if (kept.form.distanceBits > 0) corners.emplace(cornersOf(object));
  if (kept.form.bits == 1) sums.emplace(int64_t{8} * wordsPerMap * kept.maps, nullptr);
  rays.bind(program);
  maps_->bindStorage(kFieldMapsBuffer);
  cutShort.bindStorage(kFieldCutShortBuffer);
  if (sums) sums->bindStorage(kFieldSumsBuffer);
  if (corners) corners->bindStorage(kFieldCornersBuffer);
  words_->bindImage(kFieldWordsImage, gl::Access::Write);
  program.set("firstMap", kept.firstMap);
  program.set("firstTile", kept.firstTile);
  program.set("firstSlice", kept.firstSlice);
  program.dispatch({wordsPerMap, kept.maps}, {kFieldMakeGroup, 1});
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_TEXTURE_UPDATE_BARRIER_BIT |
                  GL_SHADER_STORAGE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
  if (sums) {
    const gl::Program& mean =
        context.programs().compute("renderer/visibility_fields/mean_distances.comp.glsl");
    maps_->bindStorage(kFieldMapsBuffer);
    sums->bindStorage(kFieldSumsBuffer);
    mean.set("firstMap", kept.firstMap);
    mean.set("mapCount", kept.maps);
    mean.set("wordsPerMap", wordsPerMap);
    mean.dispatch({kept.maps, 1}, {kFieldMakeGroup, 1});
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
  }
  if (cutShort.read<uint32_t>()[0] > 0)
    throw Error("rays against '" + object.name + "' take more steps than this software renderer allows", {},
                "use fewer bits of a simpler object, or a GPU");
}

Pose VisibilityFields::moved(const Pose& pose, const glm::dmat4& motion) {
  const glm::dmat3 turn(motion);
  const double scale = glm::length(turn[0]);
  return {turn / scale * pose.axes, glm::dvec3(motion * glm::dvec4(pose.centre, 1.0)), scale * pose.radius};
}

void VisibilityFields::place(const std::vector<Pose>& poses, glm::dvec3 anchor) {
  placed_.clear();
  for (const Pose& pose : poses) {
    const size_t number = placed_.size();
    FieldObject object{};
    object.centre = pose.centre - anchor;
    object.radius = static_cast<float>(pose.radius);
    const Kept& kept = kept_[number];
    // Whole numbers below 2^24, which floats hold.
    const auto form = static_cast<float>(kept.segments | kept.form.directions << 8 | kept.form.bits << 17);
    object.axisX = glm::vec4(pose.axes[0], form);
    object.axisY = glm::vec4(pose.axes[1], static_cast<float>(kept.firstSlice));
    object.axisZ = glm::vec4(pose.axes[2], static_cast<float>(kept.maps));
    object.owner = owners_[number], object.albedo = albedos_[number];
    object.firstMap = static_cast<uint32_t>(kept.firstMap);
    object.root = roots_.empty() ? ray_tracing::kRayNoRoot : roots_[number];
    placed_.push_back(object);
  }
  if (!placed_.empty())
    objects_.write(0, static_cast<int64_t>(placed_.size() * sizeof(FieldObject)), placed_.data());
}

void VisibilityFields::bind(const gl::Program& program) const {
  objects_.bindStorage(kFieldObjectsBuffer);
  maps_->bindStorage(kFieldMapsBuffer);
  words_->bindTexture(kFieldWordsUnit);
  program.set("fieldObjectCount", objectCount_);
}

int64_t VisibilityFields::rayCount() const {
  int64_t rays = 0;
  for (const Kept& kept : kept_) rays += int64_t{kept.maps} * kept.form.directions * kept.form.directions;
  return rays;
}

int64_t VisibilityFields::words(const Kept& kept) const {
  return int64_t{kept.maps} * kept.form.wordsPerRow() * kept.form.directions;
}

int64_t VisibilityFields::bytes() const {
  int64_t bytes = 0;
  for (const Kept& kept : kept_) bytes += int64_t{4} * words(kept);
  return bytes;
}

int64_t VisibilityFields::bytesHeld() const { return words_->bytes() + maps_->bytes() + objects_.bytes(); }

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
  std::vector<std::vector<uint32_t>> found(objectCount_);
  uint32_t count = 0;
  for (uint32_t i = 0; i < objectCount_; ++i) {
    const Kept& kept = kept_[i];
    const std::string path = store.path(objects[i], kept.form);
    const size_t means = static_cast<size_t>(kept.form.bits == 1 ? kept.maps : 0);
    if (std::optional<StoredField> field = store.read(path, static_cast<size_t>(words(kept)), means)) {
      found[i] = std::move(field->words), ++count;
      std::vector<glm::vec4> maps = mapsOf(kept.form);
      for (size_t map = 0; map < field->means.size(); ++map) maps[map].w = field->means[map];
      const auto bytes = static_cast<int64_t>(maps.size() * sizeof(glm::vec4));
      maps_->write(static_cast<int64_t>(sizeof(glm::vec4)) * kept.firstMap, bytes, maps.data());
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
  const Kept& kept = kept_[object];
  if (kept.form.bits == 1)
    for (const glm::vec4 map :
         maps_->read<glm::vec4>(static_cast<int64_t>(sizeof(glm::vec4)) * kept.firstMap, kept.maps))
      means.push_back(map.w);
  return means;
}

void VisibilityFields::writeWords(const std::vector<std::vector<uint32_t>>& ofObjects) const {
  const auto side = static_cast<size_t>(sliceSide_);
  const auto slices = static_cast<size_t>(words_->bytes()) / (sizeof(uint32_t) * side * side);
  std::vector<std::vector<uint32_t>> texels;
  for (size_t slice = 0; slice < slices; ++slice)
    texels.push_back(words_->readUintLayer(static_cast<int>(slice)));
  for (size_t object = 0; object < ofObjects.size(); ++object) {
    if (ofObjects[object].empty()) continue;
    const Kept& kept = kept_[object];
    const glm::ivec2 tile = tileOf(kept.form);
    size_t next = 0;
    for (int map = 0; map < kept.maps; ++map)
      for (int y = 0; y < tile.y; ++y)
        for (int x = 0; x < tile.x; ++x) {
          const glm::ivec3 at = fieldWordPlace(kept.firstTile + map, {x, y}, tile, sliceSide_) +
                                glm::ivec3(0, 0, kept.firstSlice);
          texels[static_cast<size_t>(at.z)][static_cast<size_t>(at.y) * side + static_cast<size_t>(at.x)] =
              ofObjects[object][next++];
        }
  }
  for (size_t slice = 0; slice < slices; ++slice) words_->writeUint(texels[slice], static_cast<int>(slice));
}

void VisibilityFields::lengthen(int tolerance) const {
  std::vector<std::vector<uint32_t>> changed(objectCount_);
  for (uint32_t object = 0; object < objectCount_; ++object) {
    if (kept_[object].form.bits != 8) continue;
    std::vector<uint32_t> words = readWords(object);
    lengthenRuns({reinterpret_cast<uint8_t*>(words.data()), words.size() * sizeof(uint32_t)}, tolerance,
                 static_cast<uint8_t>(fieldMissCode(8)));
    changed[object] = std::move(words);
  }
  writeWords(changed);
}

std::vector<uint32_t> VisibilityFields::readWords(uint32_t object) const {
  const Kept& kept = kept_[object];
  const glm::ivec2 tile = tileOf(kept.form);
  std::vector<uint32_t> out;
  std::vector<uint32_t> slice;
  int held = -1;
  for (int map = 0; map < kept.maps; ++map)
    for (int y = 0; y < tile.y; ++y)
      for (int x = 0; x < tile.x; ++x) {
        const glm::ivec3 at = fieldWordPlace(kept.firstTile + map, {x, y}, tile, sliceSide_) +
                              glm::ivec3(0, 0, kept.firstSlice);
        if (at.z != held) slice = words_->readUintLayer(at.z), held = at.z;
        out.push_back(
            slice[static_cast<size_t>(at.y) * static_cast<size_t>(sliceSide_) + static_cast<size_t>(at.x)]);
      }
  return out;
}

std::vector<float> VisibilityFields::readShares(uint32_t object) const {
  const std::vector<uint32_t> words = readWords(object);
  const Kept& kept = kept_[object];
  const FieldForm& form = kept.form;
  const auto maps =
      maps_->read<glm::vec4>(static_cast<int64_t>(sizeof(glm::vec4)) * kept.firstMap, kept.maps);
  const int perWord = 32 / form.bits;
  std::vector<float> out;
  for (int map = 0; map < kept.maps; ++map)
    for (int y = 0; y < form.directions; ++y)
      for (int x = 0; x < form.directions; ++x) {
        const uint32_t word =
            words[static_cast<size_t>((map * form.directions + y) * form.wordsPerRow() + x / perWord)];
        if (form.distanceBits > 0) {
          const uint32_t code = word & fieldMissCode(form.distanceBits);
          out.push_back(code == fieldMissCode(form.distanceBits)
                            ? -1.0F
                            : float(code) * fieldCodeStep(form.distanceBits));
          continue;
        }
        if (form.bits == 32) {
          out.push_back(std::bit_cast<float>(word));
          continue;
        }
        const uint32_t code = word >> (form.bits * (x % perWord)) & ((1U << form.bits) - 1U);
        const float share =
            form.bits == 1 ? maps[static_cast<size_t>(map)].w : float(code) * fieldCodeStep(form.bits);
        out.push_back(code == fieldMissCode(form.bits) ? -1.0F : share);
      }
  return out;
}

}  // namespace limen::visibility_fields
