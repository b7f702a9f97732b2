// SPDX-License-Identifier: BSD-3-Clause
// Mirrors, perfect and glossy, that find objects in visibility fields which store normals: 4 bytes a ray.
// What has no field, like a ground, is traced. Rays from the eye are exact, or looked up as well, which shows
// the pattern of positions and directions. Objects have one colour, that of their part without a pattern.
// Source: Gaitatzes 2012, section 4.7.2.
#include <epoxy/gl.h>

#include <optional>

#include "experiments/base/enum_names.h"
#include "renderer/frame/g_buffer.h"
#include "renderer/techniques/technique.h"
#include "renderer/techniques/visibility_fields/field_pass_bindings.h"
#include "renderer/techniques/visibility_fields/field_reader.h"
#include "renderer/techniques/visibility_fields/lobe_rays.h"
#include "renderer/techniques/visibility_fields/object_tracer.h"
#include "renderer/techniques/visibility_fields/traced_triangles.h"

namespace limen::techniques {
namespace {

constexpr const char* kFieldReflections = "visibility_fields/reflections";

enum class PrimaryRays { Exact, Field };
constexpr EnumNames<PrimaryRays, 2> enumNames(PrimaryRays) {
  return {{{{PrimaryRays::Exact, "exact"}, {PrimaryRays::Field, "field"}}}};
}

struct NormalField {
  visibility_fields::PositionForm positionMap = visibility_fields::PositionForm::Lattice;
  int positions = 4226;
  visibility_fields::DirectionForm directionMap = visibility_fields::DirectionForm::Concentric;
  int directions = 32;
  int distanceBits = 8;
  FieldUse use;
  HitFetch fetch = HitFetch::Aimed;
  std::string folder;
  static const SettingsTable<NormalField>& table() {
    using S = NormalField;
    static const SettingsTable<S> kTable = {
        visibility_fields::positionMapBinding(&S::positionMap),
        visibility_fields::positionsBinding(&S::positions),
        visibility_fields::directionMapBinding(&S::directionMap),
        visibility_fields::directionsBinding(&S::directions),
        {&S::distanceBits, "distance_bits", oneOf({8, 16}), "bit",
         "Of the 32 bits of a ray those of its distance; the rest are the normal's",
         "Gaitatzes 2012, section 4.5.1 (4 bytes; 8 and 3 x 8 is a reading)"},
        included(&S::use),
        hitFetchBinding(&S::fetch),
        folderBinding(&S::folder)};
    return kTable;
  }
  FieldReading reading() const {
    return {{positionMap, positions, directionMap, directions, 32, distanceBits},
            use,
            fetch == HitFetch::Aimed ? FieldFetch::Aimed : FieldFetch::Nearest,
            {folder, 0, GivenDetail{}}};
  }
};

struct FieldReflectionSettings {
  LobeRays rays;
  NormalField field;
  bool selfReflection = true;
  visibility_fields::ObjectSetting objects;
  PrimaryRays primary = PrimaryRays::Exact;
  frame::ShadedSetting shading;
  static const SettingsTable<FieldReflectionSettings>& table() {
    using S = FieldReflectionSettings;
    static const SettingsTable<S> kTable = {
        included(&S::rays),
        included(&S::field),
        {&S::selfReflection, "self_reflection", "Objects reflect themselves, and not only others",
         "Gaitatzes 2012, section 4.4.2"},
        objectsBinding(&S::objects),
        {&S::primary, "primary",
         "How rays from the eye find a mirror: exactly, or in its field, whose pattern then shows",
         "Gaitatzes 2012, section 4.7.2 (exact)"},
        shadingBinding(&S::shading)};
    return kTable;
  }
};

class FieldReflections : public Technique {
 public:
  using Settings = FieldReflectionSettings;
  explicit FieldReflections(const Settings& settings)
      : settings_(settings),
        reader_(settings.field.reading()),
        lobes_(settings.rays, settings.shading, kFieldReflections) {}

  void prepare(frame::Frame& frame) override {
    ReceiverRays rays;
    rays.rays = settings_.rays.rays;
    rays.objects = settings_.objects;
    reader_.prepare(frame, rays, settings_.shading.smoothNormals);
    others_.emplace(treeWithoutObjects(frame, rays));
    gl::ProgramCache& programs = frame.context().programs();
    const std::string folder = "renderer/techniques/visibility_fields/reflections/";
    gl::ShaderDefines defines = reader_.defines();
    hitsProgram_ = &programs.compute(folder + "field_hits.comp.glsl", defines);
    hits_.emplace(gl::Format::RGBA32UI, frame.sizePx(), 1, static_cast<int>(settings_.rays.rays));
    int64_t bytes = hits_->bytes() + reader_.bytesHeld();
    if (settings_.primary == PrimaryRays::Field) {
      primaryProgram_ = &programs.compute(folder + "field_primary.comp.glsl", defines);
      for (auto* texture : {&origins_, &mirrored_, &normals_})
        texture->emplace(gl::Format::RGBA32F, frame.sizePx()), bytes += (*texture)->bytes();
    }
    defines["COUNT"] = "1";
    countingProgram_ = &programs.compute(folder + "field_hits.comp.glsl", defines);
    lobes_.prepare(frame, true, primaryProgram_ != nullptr, others_->bytes());
    frame.passes().setBytesHeld(std::string(kFieldReflections) + "/look_up", bytes);
  }

  void render(frame::Frame& frame) override {
    const frame::MirrorRays& exact = frame.get<frame::MirrorRays>();
    frame.get<frame::TriangleIds>();
    reader_.place(frame);
    others_->update(frame);
    LobeStart start{&exact.origins(), &exact.directions()};
    if (primaryProgram_) start = primary(frame, start);
    lobes_.makeRays(frame, start);
    {
      const auto scope = frame.passes().open(std::string(kFieldReflections) + "/look_up");
      lookUp(frame, *hitsProgram_, start);
    }
    lobes_.shade(frame, start, &*hits_, &others_->tree());
  }

  const gl::Texture& product() const override { return lobes_.picture(); }
  std::vector<std::string> remarks() const override { return reader_.remarks(); }

  std::vector<Counter> count(frame::Frame& frame) override {
    const frame::MirrorRays& exact = frame.get<frame::MirrorRays>();
    LobeStart start{&exact.origins(), &exact.directions()};
    if (primaryProgram_) start = {&*origins_, &*mirrored_, &*normals_};
    return reader_.count(frame, [&](const gl::Buffer& counts) {
      counts.bindStorage(kFieldCountsBuffer);
      lookUp(frame, *countingProgram_, start);
    });
  }

 private:
  LobeStart primary(frame::Frame& frame, const LobeStart& exact) {
    const auto scope = frame.passes().open(std::string(kFieldReflections) + "/primary");
    reader_.bind(*primaryProgram_);
    exact.origins->bindTexture(kLobeOriginsUnit);
    exact.mirrored->bindTexture(kLobeMirroredUnit);
    frame.get<frame::TriangleIds>().texture().bindTexture(kLobeIdsUnit);
    origins_->bindImage(kLobeOriginsImage, gl::Access::Write);
    mirrored_->bindImage(kLobeMirroredImage, gl::Access::Write);
    normals_->bindImage(kLobeNormalsImage, gl::Access::Write);
    primaryProgram_->set("eyePosition", glm::vec3(frame.camera().eye - frame.gpuScene().anchor()));
    primaryProgram_->set("sizePx", frame.sizePx());
    primaryProgram_->dispatch(frame.sizePx());
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
    return {&*origins_, &*mirrored_, &*normals_};
  }

  void lookUp(frame::Frame& frame, const gl::Program& program, const LobeStart& start) {
    reader_.bind(program);
    start.origins->bindTexture(kLobeOriginsUnit);
    frame.get<frame::TriangleIds>().texture().bindTexture(kLobeIdsUnit);
    lobes_.directions().bindTexture(kLobeDirectionsUnit);
    hits_->bindImage(kLobeHitsImage, gl::Access::Write);
    program.set("sizePx", frame.sizePx());
    program.set("rayCount", static_cast<int>(settings_.rays.rays));
    program.set("selfOcclusion", settings_.selfReflection ? 1 : 0);
    program.dispatch(frame.sizePx());
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
  }

  Settings settings_;
  FieldReader reader_;
  LobeReflections lobes_;
  std::optional<TracedTriangles> others_;
  std::optional<gl::Texture> hits_, origins_, mirrored_, normals_;
  const gl::Program *hitsProgram_ = nullptr, *countingProgram_ = nullptr, *primaryProgram_ = nullptr;
};

const RegisteredTechnique<FieldReflections> kFieldReflectionsRegistered{
    {.name = kFieldReflections,
     .version = 3,
     .summary = "Perfect and glossy mirrors by rays whose hits are looked up in fields with normals",
     .source = "Gaitatzes 2012, section 4.7.2 (VF-20, VF-21)",
     .product = ProductKind::Colour,
     .needs = {"mirrors", "casters"},
     .followsMotion = true,
     .counters = FieldReader::quantities(),
     .effort = "rays"}};

}  // namespace
}  // namespace limen::techniques
