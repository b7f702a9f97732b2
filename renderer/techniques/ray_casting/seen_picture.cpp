// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/ray_casting/seen_picture.h"

#include <epoxy/gl.h>

#include "renderer/frame/g_buffer.h"
#include "renderer/techniques/ray_casting/ray_casting_bindings.h"
#include "renderer/techniques/tessellation/tessellation_bindings.h"

namespace limen::techniques {

SeenPicture::SeenPicture(frame::Frame& frame, const frame::ShadedSetting& shading, const std::string& pass)
    : picture_(frame, shading, pass),
      ids_(gl::Format::R32UI, frame.sizePx()),
      normals_(gl::Format::RGBA32F, frame.sizePx()),
      program_(frame.context().programs().get({"renderer/techniques/ray_casting/exact/seen.vert.glsl",
                                               "renderer/techniques/ray_casting/exact/seen.frag.glsl"})) {
  glCreateVertexArrays(1, &vertexArray_);
}

SeenPicture::~SeenPicture() { glDeleteVertexArrays(1, &vertexArray_); }

void SeenPicture::write(const scene::Scene& scene, const ExactView& seen) {
  std::vector<uint32_t> ids(seen.pixels.size(), 0);
  Image normals(seen.sizePx.x, seen.sizePx.y, 4);
  for (size_t i = 0; i < seen.pixels.size(); ++i) {
    const ExactPixel& pixel = seen.pixels[i];
    if (!pixel.hit) continue;
    ids[i] = kSurfaceOfPatch | scene.parts[scene.surfaces.patches[pixel.at.patch].part].material;
    for (int c = 0; c < 3; ++c)
      normals.data[4 * i + static_cast<size_t>(c)] = static_cast<float>(pixel.normal[c]);
    normals.data[4 * i + 3] = static_cast<float>(pixel.distance);
  }
  ids_.writeUint(ids);
  normals_.write(normals);
}

void SeenPicture::render(frame::Frame& frame) {
  picture_.render(frame, [&] {
    program_.use();
    program_.set("nearest", static_cast<float>(frame::nearPlane(frame)));
    ids_.bindTexture(kSeenIdsUnit);
    normals_.bindTexture(kSeenNormalsUnit);
    glBindVertexArray(vertexArray_);
    glDrawArrays(GL_TRIANGLES, 0, 3);
  });
}

}  // namespace limen::techniques
