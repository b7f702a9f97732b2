// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "renderer/frame/frame.h"
#include "renderer/gl/buffer.h"
#include "renderer/gl/texture.h"

namespace limen::frame {

/// Places of 2, 4 or 8 samples in a pixel, from its top left corner, 0..1: the standard patterns of Direct3D
/// 11, which most GPUs use.
std::vector<glm::vec2> standardSamplePlaces(int samples);

/// Which triangle each of a pixel's samples sees, in compute shaders, with the coverage and depth of
/// ComputeRaster at the samples' places.
///
/// Starts from TriangleIds, which the frame has anyway, and looks at the samples of only those pixels where
/// they may see anything other than the triangle behind the centre. Those pixels are listed. A pixel's
/// `reach` is the least near / distance of the centre's triangle at its samples, 0 if that triangle does not
/// cover all samples; a triangle matters to the pixel only if it covers a sample at `reach` or nearer. Hence
/// two passes over the triangles, depths and ids, that store nothing in most pixels; the centre's triangle
/// itself is added last. Of two triangles at the same depth the one with the smaller index is seen.
class SampleRaster {
 public:
  SampleRaster(Frame& frame, std::vector<glm::vec2> places);

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

  std::vector<glm::vec2> places_;
  const gl::Program &clear_, &empty_, &reachOf_, &smallDepth_, &largeDepth_, &groups_, &smallIds_, &largeIds_,
      &finish_;
  gl::Texture reach_, marks_;
  gl::Buffer queue_, list_, depths_, ids_;
};

/// Runs `program`, which includes sample_list.glsl, over the pixels in such a list; binds it.
void dispatchOverSampleList(const gl::Program& program, const gl::Buffer& list);

}  // namespace limen::frame
