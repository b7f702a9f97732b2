// SPDX-License-Identifier: BSD-3-Clause
// The rays of visibility_fields/ambient_occlusion, traced against the triangles of the same objects instead:
// what fields are compared with, exact for those rays, and the tracer that they must beat. Source: Gaitatzes
// 2012, section 4.7 (MT-01, BL-02).
#include <epoxy/gl.h>

#include <optional>

#include "renderer/frame/g_buffer.h"
#include "renderer/techniques/technique.h"
#include "renderer/techniques/visibility_fields/field_scene.h"
#include "renderer/techniques/visibility_fields/occlusion_pass_bindings.h"
#include "renderer/techniques/visibility_fields/occlusion_settings.h"
#include "renderer/visibility_fields/field_bindings.h"

namespace limen::techniques {
namespace {

class TracedObjects : public Technique {
 public:
  using Settings = OcclusionRays;
  explicit TracedObjects(const OcclusionRays& settings) : settings_(settings) {}

  void prepare(frame::Frame& frame) override {
    const visibility_fields::RigidObjects objects = objectsOf(frame, settings_.objects);
    rays_.emplace(objectRays(frame, objects));
    objectOf_.emplace(objectOfBuffer(objects));
    program_ = &frame.context().programs().compute(
        "renderer/techniques/visibility_fields/traced_occlusion/traced_occlusion.comp.glsl");
    picture_.emplace(gl::Format::RGBA32F, frame.sizePx());
    frame.passes().setBytesHeld(kPass, picture_->bytes() + rays_->bytes() + objectOf_->bytes());
  }

  void render(frame::Frame& frame) override {
    using frame::Channel;
    const auto& positions = frame.get<frame::GBufferChannel>(frame::ChannelSetting{Channel::Position});
    const auto& normals = frame.get<frame::GBufferChannel>(frame::ChannelSetting{Channel::Normal});
    const gl::Texture& ids = frame.get<frame::TriangleIds>().texture();
    const auto scope = frame.passes().open(kPass);
    rays_->bind(*program_);
    objectOf_->bindStorage(visibility_fields::kFieldObjectOfBuffer);
    settings_.configure(*program_, frame);
    positions.texture().bindTexture(kFieldPositionUnit);
    normals.texture().bindTexture(kFieldNormalUnit);
    ids.bindTexture(kFieldIdsUnit);
    picture_->bindImage(kFieldOutImage, gl::Access::ReadWrite);
    // A software renderer limits the steps of an invocation.
    const int rows = frame.context().device().software ? 1 : settings_.side();
    for (int row = 0; row < settings_.side(); row += rows) {
      program_->set("firstRow", row);
      program_->set("lastRow", row + rows - 1);
      program_->dispatch(frame.sizePx());
      glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
    }
  }

  const gl::Texture& product() const override { return *picture_; }

 private:
  static constexpr const char* kPass = "visibility_fields/trace";
  OcclusionRays settings_;
  std::optional<ray_tracing::RayScene> rays_;
  std::optional<gl::Buffer> objectOf_;
  std::optional<gl::Texture> picture_;
  const gl::Program* program_ = nullptr;
};

const RegisteredTechnique<TracedObjects> kTracedObjects{
    {.name = "visibility_fields/traced_occlusion",
     .version = 1,
     .summary = "Ambient occlusion by the same rays as from visibility fields, traced on the GPU",
     .source = "Gaitatzes 2012, section 4.7 (MT-01, BL-02)",
     .product = ProductKind::Colour,
     .needs = {"casters"},
     .reference = true,
     .effort = "rays"}};

}  // namespace
}  // namespace limen::techniques
