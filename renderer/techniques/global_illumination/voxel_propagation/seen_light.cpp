// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/global_illumination/voxel_propagation/seen_light.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cstddef>
#include <string>

#include "experiments/base/error.h"
#include "renderer/techniques/global_illumination/illumination_bindings.h"

namespace limen::techniques {
namespace {

const std::string kFolder = "renderer/techniques/global_illumination/voxel_propagation/";
constexpr const char *kVisibilityPass = "global_illumination/visibility",
                     *kSearchPass = "global_illumination/search";

constexpr int64_t kBytesPerPx = 8;  // of each of two lists

int64_t mostBytes() {
  GLint64 most = 0;
  glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &most);
  return most;
}

int64_t pixelsOf(const frame::Frame& frame) {
  const int64_t pixels = int64_t{frame.sizePx().x} * frame.sizePx().y;
  const int64_t most = std::min(int64_t{1} << (32 - kAskedCornerBits), mostBytes() / kBytesPerPx);
  if (pixels >= most)
    throw Error("a picture of " + std::to_string(pixels) +
                    " pixels has more than this device's lists of those with rays take",
                "image",
                "use an image of fewer than " + std::to_string(most) + " pixels, or weights: occupied");
  return pixels;
}

}  // namespace

SeenLight::SeenLight(frame::Frame& frame, const gl::ShaderDefines& defines,
                     const frame::SurfaceLightSettings& lighting, const char* pass, int widest,
                     int64_t raysPerPx)
    : pixels_(static_cast<double>(pixelsOf(frame))),
      mostRays_(static_cast<uint32_t>(
          std::min(raysPerPx * pixelsOf(frame), (mostBytes() - int64_t{sizeof(AskedHeader)}) / 4))),
      widest_(widest),
      indirect_(lighting.light != frame::LightPart::Direct),
      picture_(frame, kFolder + "reconstruct_sure.comp.glsl", defines, lighting, pass),
      groups_(frame.context().programs().compute(kFolder + "asked_groups.comp.glsl")),
      rays_(picture_.program(frame, kFolder + "reconstruct_rays.comp.glsl", defines)),
      seen_(picture_.program(frame, kFolder + "reconstruct_seen.comp.glsl", defines)),
      search_(picture_.program(frame, kFolder + "reconstruct_search.comp.glsl", defines)),
      askedRays_(int64_t{sizeof(AskedHeader)} + int64_t{4} * mostRays_, nullptr),
      askedPixels_(kBytesPerPx * pixelsOf(frame), nullptr),
      seenCorners_(kBytesPerPx * pixelsOf(frame), nullptr) {
  askedRays_.clearUint(0);
  frame.passes().setBytesHeld(kVisibilityPass,
                              askedRays_.bytes() + askedPixels_.bytes() + seenCorners_.bytes());
}

void SeenLight::render(frame::Frame& frame, const std::function<void(const gl::Program&)>& configure,
                       const ray_tracing::RayTree* tree) const {
  const auto gathers = [&](const gl::Program& program) {
    configure(program);
    askedRays_.bindStorage(kAskedRaysBuffer);
    askedPixels_.bindStorage(kAskedPixelsBuffer);
    seenCorners_.bindStorage(kSeenCornersBuffer);
  };
  picture_.render(
      frame,
      [&](const gl::Program& program) {
        gathers(program);
        program.set("mostRays", mostRays_);
      },
      tree,
      [&] {
        if (!indirect_) return;
        for (const gl::Program* program : {&rays_, &seen_, &search_}) {
          picture_.configure(*program, frame, tree);
          gathers(*program);
        }
        search_.set("widest", widest_);
        {
          const auto scope = frame.passes().open(kVisibilityPass);
          makeGroups(false);
          dispatch(rays_, offsetof(AskedHeader, rays));
          dispatch(seen_, offsetof(AskedHeader, pixels));
        }
        const auto scope = frame.passes().open(kSearchPass);
        makeGroups(true);
        dispatch(search_, offsetof(AskedHeader, searches));
      });
}

void SeenLight::makeGroups(bool searches) const {
  groups_.set("mostRays", mostRays_);
  groups_.set("searches", searches ? 1 : 0);
  groups_.dispatch({1, 1}, {1, 1});
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT);
}

void SeenLight::dispatch(const gl::Program& program, size_t list) const {
  program.use();
  glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, askedRays_.id());
  glDispatchComputeIndirect(static_cast<GLintptr>(list + offsetof(AskedList, groupsX)));
  glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, 0);
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
}

SeenLight::Costs SeenLight::costs() const {
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  const auto header = askedRays_.read<AskedHeader>(0, 1)[0];
  return {header.rays.listed / pixels_, header.searches.listed / pixels_};
}

}  // namespace limen::techniques
