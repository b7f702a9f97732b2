// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "renderer/gl/buffer.h"
#include "renderer/gl/context.h"
#include "renderer/gl/texture.h"
#include "renderer/visibility_fields/field_bindings.h"
#include "renderer/visibility_fields/field_form.h"
#include "renderer/visibility_fields/rigid_objects.h"

namespace limen::visibility_fields {

/// Where an object stands: rotated about its sphere's centre, which moves and grows with it.
struct Pose {
  glm::dmat3 axes{1.0};  ///< of the object, as columns: a rotation
  glm::dvec3 centre{0.0};
  double radius = 1.0;
};

/// Fields of several objects in GPU memory: for every position on an object's bounding sphere a map of the
/// distances to its surface. Source: Gaitatzes 2012, section 4.4.
class VisibilityFields {
 public:
  /// Makes the fields in compute. `tolerance`: codes of 8 bits may change by as much, so that runs of equal
  /// ones are longer; 0: none does. `folder`: where fields are kept (field_store.h), and read from if they
  /// are there; "": nowhere. Throws Error if the device cannot hold them, or the folder not be written.
  VisibilityFields(gl::Context& context, const std::vector<RigidObject>& objects, const FieldForm& form,
                   int tolerance = 0, const std::string& folder = {})
      : VisibilityFields(context, objects, std::vector<FieldForm>(objects.size(), form), tolerance, folder) {}
  /// A form for each object; they share their maps' forms and have no normals unless all forms are the same.
  VisibilityFields(gl::Context& context, const std::vector<RigidObject>& objects,
                   const std::vector<FieldForm>& forms, int tolerance = 0, const std::string& folder = {});
  /// Of the objects, those whose fields were read and not made.
  uint32_t fieldsRead() const { return fieldsRead_; }

  /// Where objects stand, relative to `anchor`; one pose an object. They stand where they were made until it
  /// is called, relative to the origin.
  void place(const std::vector<Pose>& poses, glm::dvec3 anchor);
  /// Roots of the objects' trees in a RayForest, for shaders that trace rays as well; from the next place()
  /// on.
  void setRoots(const std::vector<uint32_t>& roots) { roots_ = roots; }
  static Pose poseOf(const RigidObject& object) {
    return {glm::dmat3(1.0), object.sphere.centre, object.sphere.radius};
  }
  /// Where `motion`, a rotation, a shift and a uniform scale, takes what stands there.
  static Pose moved(const Pose& pose, const glm::dmat4& motion);

  /// Buffers, texture and uniforms of field_lookup.glsl, for the next dispatches of `program`.
  void bind(const gl::Program& program) const;
  const FieldForm& form(uint32_t object) const { return kept_[object].form; }
  /// FIELD_* for shaders that read or make these fields.
  gl::ShaderDefines defines() const;
  uint32_t objectCount() const { return objectCount_; }
  int64_t rayCount() const;  ///< traced to make the fields, unused texels included
  int64_t bytes() const;     ///< of the words themselves, unused parts of slices left out
  int64_t bytesHeld() const;
  /// Bytes of all words as run lengths (run_lengths.h); waits for the GPU.
  int64_t runLengthBytes() const;

  /// The words of an object's map; waits for the GPU. Row by row, FieldForm::wordsPerRow() each.
  std::vector<uint32_t> readWords(uint32_t object) const;
  /// Distances of an object as shares of the diameter, -1 for none: [position][row][column]. Waits for the
  /// GPU.
  std::vector<float> readShares(uint32_t object) const;

 private:
  void make(gl::Context& context, const RigidObject& object, uint32_t index) const;
  void lengthen(int tolerance) const;
  uint32_t readOrMake(gl::Context& context, const std::vector<RigidObject>& objects,
                      const std::string& folder) const;
  /// As readWords() gives them; none: left as they are.
  void writeWords(const std::vector<std::vector<uint32_t>>& ofObjects) const;
  std::vector<float> readMeans(uint32_t object) const;

  /// Where an object's field lies.
  struct Kept {
    FieldForm form;
    int segments = 0;
    int firstMap = 0, maps = 0;         ///< of maps_
    int firstTile = 0, firstSlice = 0;  ///< of words_
  };
  void plan(const std::vector<FieldForm>& forms);
  int64_t words(const Kept& kept) const;

  uint32_t objectCount_, fieldsRead_ = 0;
  bool varied_ = false;  ///< several forms: each object begins a slice of its own
  int slices_ = 1;
  FieldForm first_;  ///< of the first object
  std::vector<Kept> kept_;
  std::vector<uint32_t> owners_, albedos_, roots_;
  std::vector<FieldObject> placed_;  ///< kept, so that placing allocates nothing
  int sliceSide_ = 0;
  std::optional<gl::Texture> words_;
  std::optional<gl::Buffer> maps_;
  gl::Buffer objects_;
};

}  // namespace limen::visibility_fields
