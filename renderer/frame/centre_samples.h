// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "renderer/frame/sample_raster.h"

namespace limen::frame {

/// Which triangle each sample sees of the pixels that SampleRaster lists with SampleSearch::Neighbours,
/// without a pass over triangles: of those behind the nine centres around a pixel, the nearest that covers
/// the sample. Where none does, it sees nothing if one of the centres does, otherwise what its pixel's own
/// centre sees.
///
/// A sample is given the triangle that SampleRaster finds for it wherever that is behind one of the nine
/// centres; else a triangle farther off, or none. Triangles of less than a pixel behind no centre are missed.
class CentreSamples {
 public:
  CentreSamples(Frame& frame, std::vector<glm::vec2> places, const SameSurface& surface = {});

  /// Makes the frame's TriangleIds and, in a pass of this name, the samples.
  void draw(Frame& frame, const std::string& pass) const;

  /// As SampleRaster has them.
  const std::vector<glm::vec2>& places() const { return places_; }
  const gl::Buffer& list() const { return list_; }
  const gl::Buffer& ids() const { return ids_; }
  const gl::Texture& marks() const { return marks_; }
  int64_t bytes() const { return list_.bytes() + ids_.bytes() + marks_.bytes(); }

 private:
  std::vector<glm::vec2> places_;
  SameSurface surface_;
  const gl::Program &empty_, &mark_, &groups_;
  gl::Buffer list_, ids_;
  gl::Texture marks_;
};

}  // namespace limen::frame
