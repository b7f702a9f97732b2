// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "renderer/frame/frame.h"
#include "renderer/gl/buffer.h"
#include "renderer/gl/program.h"
#include "renderer/gl/texture.h"

namespace limen::frame {

/// Whether surfaces that let light through send the refracted ray.
struct RefractionSetting {
  bool refraction = false;
  std::string key() const { return refraction ? "refraction" : ""; }
};

/// The rays that leave the mirrors which pixels see, one a pixel (Roger 2008, section 3.2.2: a G-buffer of
/// secondary rays). A direction is the view's, mirrored at the shading normal; where that would lead below
/// the surface, at the triangle's own normal.
///
/// What a ray that leaves a surface may meet (ray_origin.glsl; for all tracers of the family): not the
/// triangle that it leaves, and none whose plane contains its origin up to rounding (rayOriginTolerance()).
/// Skipping the one triangle would not do: an origin that rounding puts behind it meets a neighbour from
/// behind, near their common edge. A fixed near distance would lose contacts. The plane's rule loses what is
/// nearer to the origin than a rounding, and what a ray meets at an angle of less than the tolerance over its
/// distance.
///
/// With `refraction` a surface that lets light through sends the refracted ray in place of the mirrored one
/// by Snell's law at the shading normal, or mirrored where nothing passes.
class MirrorRays : public FrameInput {
 public:
  static constexpr const char* kName = "mirror_rays";
  static constexpr bool kOfShownMirrors = true;
  explicit MirrorRays(Frame& frame, RefractionSetting setting = {});
  void make(Frame& frame) override;
  /// RGBA32F: point of the mirror, relative to the scene's anchor; w = 1: a ray starts here, 0: none.
  const gl::Texture& origins() const { return origins_; }
  /// RGBA32F: unit vector; w = cosine between the view and the shading normal, 0 to 1, or
  /// kTotalReflectionCosine where a surface that lets light through reflects all of it. 0 without a ray.
  const gl::Texture& directions() const { return directions_; }

 private:
  const gl::Program& program_;
  gl::Texture origins_, directions_;
  std::optional<gl::Buffer> shown_;  ///< a bit for each triangle; none: all mirrors are shown
};

/// The rays that a technique follows first.
const MirrorRays& firstRays(Frame& frame, bool refraction);

/// Distance from the true surface within which rays that leave it start, world units. With R the largest
/// coordinate relative to the anchor: corners are rounded to float (2^-24 R a coordinate), each of three
/// products of a weighted mean and two sums are rounded again, and the weights sum to 1 up to two roundings:
/// 8 * 2^-24 R a coordinate, and sqrt(3) times as much in space, which is below 16 * 2^-24 R.
double rayOriginTolerance(const GpuScene& scene);
/// Uniforms of ray_origin.glsl.
void configureRayOrigins(const gl::Program& program, const GpuScene& scene);

}  // namespace limen::frame
