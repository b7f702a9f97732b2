// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "renderer/frame/centre_samples.h"
#include "renderer/frame/sample_raster.h"
#include "renderer/techniques/soft_shadows/multisample/multisample_ids.h"
#include "renderer/techniques/soft_shadows/multisample/multisample_settings.h"

namespace limen::techniques {

/// Which triangles a pixel's samples see, by either rasteriser, and the pixels that see anything other than
/// the triangle behind their centres.
class PixelSamples {
 public:
  /// `surfaces`: list(), marks() and ids() are needed, for these. The compute rasteriser always has them.
  PixelSamples(frame::Frame& frame, int samples, frame::Raster raster, const SurfaceSamples* surfaces);

  void draw(frame::Frame& frame, const std::string& pass) const;

  /// Places in the pixel, from its top left corner, 0..1: the driver's, or the standard ones.
  const std::vector<glm::vec2>& places() const {
    return driver_ ? driver_->places() : centres_ ? centres_->places() : compute_->places();
  }
  /// For sample_ids.glsl.
  gl::ShaderDefines defines() const;
  void bindForSampleIds(frame::Frame& frame) const;

  /// As SampleRaster has them.
  const gl::Buffer& list() const {
    return driver_ ? listed_->list : centres_ ? centres_->list() : compute_->list();
  }
  const gl::Buffer& ids() const {
    return driver_ ? listed_->ids : centres_ ? centres_->ids() : compute_->ids();
  }
  const gl::Texture& marks() const {
    return driver_ ? listed_->marks : centres_ ? centres_->marks() : compute_->marks();
  }
  int64_t bytes() const;

 private:
  struct Listed {
    const gl::Program &empty, &gather, &groups;
    gl::Buffer list, ids, unusedQueue;
    gl::Texture marks;
  };
  void listDriverSamples(frame::Frame& frame) const;

  std::optional<MultisampleIds> driver_;
  std::optional<Listed> listed_;  // of the driver's samples
  std::optional<frame::SampleRaster> compute_;
  std::optional<frame::CentreSamples> centres_;
};

}  // namespace limen::techniques
