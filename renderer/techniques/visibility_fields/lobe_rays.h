// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "renderer/frame/frame.h"
#include "renderer/frame/mirror_rays.h"
#include "renderer/frame/shaded.h"
#include "renderer/gl/program.h"
#include "renderer/ray_tracing/ray_tree.h"
#include "renderer/techniques/reflections/reflection_picture.h"

namespace limen::techniques {

/// Rays of a pixel's mirror, over the cone of its gloss.
struct LobeRays {
  int64_t rays = 4;
  bool turned = false;
  int64_t seed = 1;
  static const SettingsTable<LobeRays>& table();
  /// Throws Error unless `rays` is a square number.
  void check() const;
  int side() const;
};

/// What a pixel's first rays start from: textures as MirrorRays has them.
struct LobeStart {
  const gl::Texture *origins, *mirrored;
  const gl::Texture* normals = nullptr;  ///< of starts found in fields; null: all are exact
};

/// Reflections by several rays a pixel, the same for fields and for tracers: makes the rays, and shades what
/// they meet. Passes "<pass>/rays" and "<pass>/shade".
class LobeReflections {
 public:
  LobeReflections(const LobeRays& rays, const frame::ShadedSetting& shading, std::string pass)
      : rays_(rays), shading_(shading), pass_(std::move(pass)), picture_(shading) {}

  /// `fieldHits`: objects are found in fields; `foundStarts`: there will be LobeStart::normals; `treeBytes`:
  /// of the tree that shade() traces.
  void prepare(frame::Frame& frame, bool fieldHits, bool foundStarts, int64_t treeBytes);
  void makeRays(frame::Frame& frame, const LobeStart& start);
  /// `hits`: of fields, or null; `tree`: of the triangles that have none, null: the whole scene's.
  void shade(frame::Frame& frame, const LobeStart& start, const gl::Texture* hits,
             const ray_tracing::RayTree* tree);

  const LobeRays& rays() const { return rays_; }
  /// RGBA32F array, a layer a ray.
  const gl::Texture& directions() const { return *directions_; }
  const gl::Texture& picture() const { return picture_.texture(); }

 private:
  LobeRays rays_;
  frame::ShadedSetting shading_;
  std::string pass_;
  ReflectionPicture picture_;
  const gl::Program *makeRays_ = nullptr, *shade_ = nullptr;
  std::optional<gl::Texture> directions_, reflected_;
};

}  // namespace limen::techniques
