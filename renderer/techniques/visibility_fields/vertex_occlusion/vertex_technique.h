// SPDX-License-Identifier: BSD-3-Clause
// Ambient occlusion of each vertex on the CPU (Gaitatzes 2012, section 4.6): the same rays looked up in
// fields, or traced by Embree. Its product is a picture in which triangles interpolate their vertices.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "renderer/techniques/technique.h"
#include "renderer/techniques/visibility_fields/field_reader.h"
#include "renderer/techniques/visibility_fields/occlusion_settings.h"

namespace limen::techniques {

/// The rays of a vertex, over the half space of its normal, by the cosine.
struct VertexRays {
  int64_t rays = 256;
  Falloff falloff = Falloff::Binary;
  double radius = 0.1;
  visibility_fields::ObjectSetting objects;
  static const SettingsTable<VertexRays>& table();
  /// Throws Error unless `rays` is a square number.
  void check() const;
};

/// A vertex of a part that only receives; what has a field does not receive here, as in the thesis's tests.
struct OccludedVertex {
  uint32_t number;
  glm::dvec3 position, normal;  ///< normal: unit, mean of the triangles' by their areas
};

class VertexTechnique : public Technique {
 public:
  VertexTechnique(const VertexRays& rays, std::string pass) : rays_(rays), pass_(std::move(pass)) {}

  void prepare(frame::Frame& frame) final;
  void render(frame::Frame& frame) final;
  const gl::Texture& product() const final { return *picture_; }
  std::vector<Counter> count(frame::Frame& frame) final;
  static std::vector<Quantity> quantities();

 protected:
  /// Returns bytes held.
  virtual int64_t prepareObjects(const std::vector<visibility_fields::RigidObject>& objects) = 0;
  /// Distances along unit directions to the nearest object, up to `far`; negative: none. On any thread.
  virtual void distances(glm::dvec3 origin, std::span<const glm::dvec3> directions, double far,
                         std::span<double> out) const = 0;
  /// Where parts move: puts the objects where they are at a time. Before distances(), in each frame.
  virtual void place(const scene::Scene& scene, double timeS) = 0;
  virtual void addCounters(std::vector<Counter>&) const {}

 private:
  double openShare(const OccludedVertex& vertex) const;
  void moveVertices(const scene::Scene& scene, double timeS);

  VertexRays rays_;
  std::string pass_;
  double radius_ = 0.0, far_ = 0.0, makeS_ = 0.0, occlusionS_ = 0.0;
  std::vector<OccludedVertex> rest_, vertices_;  ///< where they rest; where they are
  std::vector<uint32_t> motions_;                ///< of all vertices of the scene (motionsOfVertices())
  std::vector<glm::dvec3> directions_;           ///< about z
  std::vector<float> values_;
  std::optional<gl::Buffer> onGpu_;
  std::optional<gl::Texture> picture_;
  const gl::Program* program_ = nullptr;
};

}  // namespace limen::techniques
