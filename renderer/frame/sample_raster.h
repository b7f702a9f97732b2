// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "experiments/base/enum_names.h"
#include "renderer/frame/frame.h"
#include "renderer/gl/buffer.h"
#include "renderer/gl/texture.h"

namespace limen::frame {

/// Places of 2, 4 or 8 samples in a pixel, from its top left corner, 0..1: the standard patterns of Direct3D
/// 11, which most GPUs use.
std::vector<glm::vec2> standardSamplePlaces(int samples);

/// Pixels whose samples are looked at.
enum class SampleSearch {
  Triangles,   ///< those that a triangle other than the one behind the centre may be seen in: all that matter
  Neighbours,  ///< those beside a pixel whose centre sees another surface
  Centres      ///< the same, of which samples see what the centres around them see: CentreSamples
};
constexpr EnumNames<SampleSearch, 3> enumNames(SampleSearch) {
  return {{{{SampleSearch::Triangles, "triangles"},
            {SampleSearch::Neighbours, "neighbours"},
            {SampleSearch::Centres, "centres"}}}};
}

/// What is one surface: points near each other's plane that face much the same way.
struct SameSurface {
  double tolerance = 0.003;  ///< distance from a point's plane, as a share of that from the camera
  double angleDeg = 15.0;    ///< between normals
};

/// Which triangle each of a pixel's samples sees, in compute shaders, with the coverage and depth of
/// ComputeRaster at the samples' places.
///
/// Starts from TriangleIds, which the frame has anyway, and looks at the samples of only those pixels where
/// they may see anything other than the triangle behind the centre. Those pixels are listed. A pixel's
/// `reach` is the least near / distance of the centre's triangle at its samples, 0 if that triangle does not
/// cover all samples; a triangle matters to the pixel only if it covers a sample at `reach` or nearer. Hence
/// two passes over the triangles, depths and ids, that store nothing in most pixels; the centre's triangle
/// itself is added last. Of two triangles at the same depth the one with the smaller index is seen.
///
/// With SampleSearch::Neighbours, only pixels are listed of whose eight neighbours one sees another surface
/// behind its centre, and both passes go over those triangles alone that reach into their tiles. Whatever of
/// another surface a sample sees is found if it holds a circle of sqrt(2) pixels across that the sample is
/// on: that has the centre of a pixel in it, no farther from the sample than its diameter, which is less than
/// two columns or rows from the sample's own pixel. What is thinner may be missed or found in part.
class SampleRaster {
 public:
  /// `search`: not Centres. `surface`: for Neighbours.
  SampleRaster(Frame& frame, std::vector<glm::vec2> places, SampleSearch search = SampleSearch::Triangles,
               const SameSurface& surface = {});

  /// Makes the frame's TriangleIds and, in a pass of this name, the samples.
  void draw(Frame& frame, const std::string& pass) const;

  const std::vector<glm::vec2>& places() const { return places_; }
  /// SampleListHeader, then the listed pixels (row times width plus column), in any order; also the arguments
  /// of an indirect dispatch over them, see sample_list.glsl.
  const gl::Buffer& list() const { return list_; }
  /// Of pixel p's sample k at p times samples plus k: triangle or TriangleIds::kNone. Only of listed pixels.
  const gl::Buffer& ids() const { return ids_; }
  const gl::Texture& marks() const {
    return marks_;
  }  ///< R32UI, 1: listed; all others see what the centre sees
  int64_t bytes() const;

 private:
  void overTriangles(Frame& frame, const gl::Program& small, const gl::Program& large) const;
  void overList(const gl::Program& program) const;

  void listByTriangles(Frame& frame) const;
  void listByNeighbours(Frame& frame) const;

  struct Neighbours {
    SameSurface surface;
    const gl::Program &mark, &empty, &keep, &groups;
    gl::Texture tiles;  // R32UI: listed pixels of each
    gl::Buffer kept;    // SampleListHeader, then triangles
  };

  std::vector<glm::vec2> places_;
  std::optional<Neighbours> neighbours_;
  const gl::Program &clear_, &empty_, &reachOf_, &smallDepth_, &largeDepth_, &groups_, &smallIds_, &largeIds_,
      &finish_;
  gl::Texture reach_, marks_;
  gl::Buffer queue_, list_, depths_, ids_;
};

/// Uniforms of sample_marks.comp.glsl.
void setMarkUniforms(const gl::Program& program, const Frame& frame, const std::vector<glm::vec2>& places,
                     const SameSurface& surface);

/// Runs `program`, which includes sample_list.glsl, over the pixels in such a list; binds it.
void dispatchOverSampleList(const gl::Program& program, const gl::Buffer& list);

}  // namespace limen::frame
