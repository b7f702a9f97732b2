// SPDX-License-Identifier: BSD-3-Clause
// Ambient occlusion from visibility fields: the distance that a ray runs to an object is that to its bounding
// sphere and what the field says from there, so that cost does not depend on triangles. Source: Gaitatzes
// 2012, sections 4.4 to 4.7; several objects by the nearest hit of each ray (the bench's own), by products,
// or by passes that subtract (section 4.5.1).
#include <epoxy/gl.h>

#include <cmath>
#include <numeric>
#include <optional>

#include "experiments/base/error.h"
#include "renderer/frame/g_buffer.h"
#include "renderer/techniques/technique.h"
#include "renderer/techniques/visibility_fields/field_scene.h"
#include "renderer/techniques/visibility_fields/occlusion_pass_bindings.h"
#include "renderer/techniques/visibility_fields/occlusion_settings.h"
#include "renderer/visibility_fields/field_bindings.h"

namespace limen::techniques {
namespace {

enum class CombineObjects { Nearest, Product, Subtract };
constexpr EnumNames<CombineObjects, 3> enumNames(CombineObjects) {
  return {{{{CombineObjects::Nearest, "nearest"},
            {CombineObjects::Product, "product"},
            {CombineObjects::Subtract, "subtract"}}}};
}
static_assert(static_cast<int>(CombineObjects::Nearest) == kCombineNearest &&
              static_cast<int>(CombineObjects::Product) == kCombineProduct &&
              static_cast<int>(CombineObjects::Subtract) == kCombineSubtract);

struct FieldOcclusionSettings {
  OcclusionRays rays;
  visibility_fields::FieldForm field;
  CombineObjects combine = CombineObjects::Nearest;
  double slack = 1.0;
  static const SettingsTable<FieldOcclusionSettings>& table() {
    using S = FieldOcclusionSettings;
    static const SettingsTable<S> kTable = {
        included(&S::rays),
        included(&S::field),
        {&S::combine, "combine",
         "Several objects: the nearest hit of each ray, the product of their visibilities, or passes that "
         "subtract their occlusions",
         "Gaitatzes 2012, section 4.5.1 (subtract)"},
        {&S::slack,
         "slack",
         {0.0, 20.0},
         "spacings",
         "From inside an object's sphere: by how much more a blocker must lie before the origin than "
         "surfaces "
         "that the field cannot tell from it, in mean spacings of its positions",
         "Gaitatzes 2012, section 4.4.2 (without a value)"}};
    return kTable;
  }
};

class FieldOcclusion : public Technique {
 public:
  using Settings = FieldOcclusionSettings;
  explicit FieldOcclusion(const FieldOcclusionSettings& settings) : settings_(settings) {}

  void prepare(frame::Frame& frame) override {
    const visibility_fields::RigidObjects objects = objectsOf(frame, settings_.rays.objects);
    checkSteps(frame, objects.objects.size());
    fields_.emplace(fieldsOf(frame, objects, settings_.field));
    objectOf_.emplace(objectOfBuffer(objects));
    gl::ShaderDefines defines = settings_.field.defines();
    defines["COMBINE"] = std::to_string(static_cast<int>(settings_.combine));
    occlude_ = &frame.context().programs().compute(kShader, defines);
    defines["COUNT"] = "1";
    counting_ = &frame.context().programs().compute(kShader, defines);
    picture_.emplace(gl::Format::RGBA32F, frame.sizePx());
    frame.passes().setBytesHeld(kPass, picture_->bytes() + fields_->bytesHeld() + objectOf_->bytes());
  }

  void render(frame::Frame& frame) override { occlude(frame, *occlude_); }

  const gl::Texture& product() const override { return *picture_; }

  std::vector<Counter> count(frame::Frame& frame) override {
    const gl::Buffer counts(int64_t{4} * kFieldCountSlots, nullptr);
    counts.clearUint(0);
    counts.bindStorage(kFieldCountsBuffer);
    occlude(frame, *counting_);
    const std::vector<uint32_t> each = counts.read<uint32_t>();
    const double pixels = double(frame.sizePx().x) * frame.sizePx().y;
    return {{"field_lookups_per_px", std::accumulate(each.begin(), each.end(), 0.0) / pixels},
            {"field_mib", double(fields_->bytes()) / (1 << 20)},
            {"field_rays", double(fields_->rayCount())},
            {"field_objects", double(fields_->objectCount())}};
  }

 private:
  static constexpr const char* kShader =
      "renderer/techniques/visibility_fields/ambient_occlusion/ambient_occlusion.comp.glsl";
  static constexpr const char* kPass = "visibility_fields/occlude";
  static constexpr int64_t kMostSoftwareSteps = 60000;

  /// A software renderer leaves loops silently after 65,535 steps of an invocation.
  void checkSteps(frame::Frame& frame, size_t objects) const {
    const int64_t steps = settings_.rays.rays * static_cast<int64_t>(objects + 2);
    if (frame.context().device().software && steps > kMostSoftwareSteps)
      throw Error(std::to_string(settings_.rays.rays) + " rays against " + std::to_string(objects) +
                      " objects take more steps than a software renderer allows",
                  "rays", "use fewer rays, or a GPU");
  }

  /// In diameters: neighbouring positions are sqrt(4 pi / positions) radii apart on average.
  double slack() const {
    return 0.5 * settings_.slack * std::sqrt(4.0 * M_PI / double(fields_->positionMap().points().size()));
  }

  void occlude(frame::Frame& frame, const gl::Program& program) {
    using frame::Channel;
    const auto& positions = frame.get<frame::GBufferChannel>(frame::ChannelSetting{Channel::Position});
    const auto& normals = frame.get<frame::GBufferChannel>(frame::ChannelSetting{Channel::Normal});
    const gl::Texture& ids = frame.get<frame::TriangleIds>().texture();
    const auto scope = frame.passes().open(kPass);
    fields_->bind(program);
    objectOf_->bindStorage(visibility_fields::kFieldObjectOfBuffer);
    settings_.rays.configure(program, frame);
    program.set("slack", static_cast<float>(slack()));
    positions.texture().bindTexture(kFieldPositionUnit);
    normals.texture().bindTexture(kFieldNormalUnit);
    ids.bindTexture(kFieldIdsUnit);
    picture_->bindImage(kFieldOutImage, gl::Access::Write);
    program.dispatch(frame.sizePx());
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT |
                    GL_BUFFER_UPDATE_BARRIER_BIT);
  }

  FieldOcclusionSettings settings_;
  std::optional<visibility_fields::VisibilityFields> fields_;
  std::optional<gl::Buffer> objectOf_;
  std::optional<gl::Texture> picture_;
  const gl::Program *occlude_ = nullptr, *counting_ = nullptr;
};

const RegisteredTechnique<FieldOcclusion> kFieldOcclusion{
    {.name = "visibility_fields/ambient_occlusion",
     .version = 1,
     .summary = "Ambient occlusion by rays whose distances are looked up in fields around objects",
     .source = "Gaitatzes 2012, sections 4.4 to 4.7 (VF-01 to VF-18)",
     .product = ProductKind::Colour,
     .needs = {"casters"},
     .counters = {{"field_lookups_per_px", "Look-ups in fields, per pixel", "1/px", Direction::LowerIsBetter,
                   "Gaitatzes 2012, section 4.7.1"},
                  {"field_mib", "Size of the fields", "MiB", Direction::LowerIsBetter,
                   "Gaitatzes 2012, Fig. 42"},
                  {"field_rays", "Rays traced to make the fields", "rays", Direction::LowerIsBetter,
                   "Gaitatzes 2012, section 4.4.1"},
                  {"field_objects", "Objects with a field", "", Direction::Neither,
                   "Gaitatzes 2012, section 4.5.1"}},
     .effort = "rays"}};

}  // namespace
}  // namespace limen::techniques
