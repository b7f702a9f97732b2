// SPDX-License-Identifier: BSD-3-Clause
// The thesis's own form: volumes in one or four textures, used in turn, cleaned up voxel by voxel for one
// depth image after another; points of the images drawn into a volume of their own, those of the light added
// up and those of the camera in their place, which then replaces what is in the volume (IV-01, IV-04, IV-05,
// IV-09). Source: Gaitatzes 2012, sections 7.4 to 7.6. Departures: the clean-up is a compute pass over voxels
// instead of a fragment pass; the sign of the depth; a sample of the light counts by the area that it stands
// for.
#include <epoxy/gl.h>

#include <array>
#include <map>
#include <optional>
#include <string>

#include "renderer/incremental_voxels/clean_up.h"
#include "renderer/techniques/incremental_voxelization/incremental_technique.h"
#include "renderer/techniques/incremental_voxelization/point_raster_bindings.h"
#include "renderer/techniques/incremental_voxelization/voxel_textures.h"

namespace limen::techniques {
namespace {

enum class RasterFormat { Half, Full };
constexpr EnumNames<RasterFormat, 2> enumNames(RasterFormat) {
  return {{{{RasterFormat::Half, "16f"}, {RasterFormat::Full, "32f"}}}};
}

struct PointRasterSettings {
  IncrementalSettings common;
  incremental_voxels::CleanUpSettings cleanUp{.bias = incremental_voxels::RadiusBias{},
                                              .proof = incremental_voxels::Proof::Centre};
  incremental_voxels::PointSettings points{.shift = false};
  VoxelLayout layout = VoxelLayout::Atlas;
  int targets = 4;
  RasterFormat format = RasterFormat::Full;
  static const SettingsTable<PointRasterSettings>& table() {
    using S = PointRasterSettings;
    static const SettingsTable<S> kTable = {
        included(&S::common),
        {&S::cleanUp, "clean_up", "When a depth image disproves a voxel"},
        {&S::points, "points", "Points at which depth images are sampled"},
        {&S::layout, "layout", "Where voxels are in textures", "Gaitatzes 2012, section 7.6"},
        {&S::targets, "targets", oneOf({1, 4}), "textures",
         "Of a volume: normal and occupancy; or harmonics of three colours of light as well",
         "Gaitatzes 2012, Fig. 74"},
        {&S::format, "format", "Floats of the textures"}};
    return kTable;
  }
};

class PointRaster : public IncrementalTechnique {
 public:
  using Settings = PointRasterSettings;
  explicit PointRaster(const Settings& settings)
      : IncrementalTechnique(settings.common, {.volume = false, .lit = settings.targets == 4}),
        settings_(settings) {}
  ~PointRaster() override {
    if (vertexArray_) glDeleteVertexArrays(1, &vertexArray_);
  }

  /// The atlas; layers of arrays are no pictures.
  std::map<std::string, const gl::Texture*> debugViews() const override {
    std::map<std::string, const gl::Texture*> out;
    if (settings_.layout != VoxelLayout::Atlas || !volumes_[latest_]) return out;
    constexpr std::array kNames = {"normal", "harmonics_red", "harmonics_green", "harmonics_blue"};
    for (int i = 0; i < settings_.targets; ++i)
      out[kNames[static_cast<size_t>(i)]] = &volumes_[latest_]->target(i);
    return out;
  }

 protected:
  int64_t samplesPerView() const override { return 1; }
  bool countsSteps() const override { return false; }
  int64_t prepareForm(frame::Frame& frame, const incremental_voxels::SampledVolume& volume, int views,
                      int used) override {
    used_ = used;
    const glm::ivec3 size = volume.grid().resolution;
    const gl::Format format =
        settings_.format == RasterFormat::Full ? gl::Format::RGBA32F : gl::Format::RGBA16F;
    for (auto& each : volumes_) each.emplace(size, settings_.layout, settings_.targets, format);
    injected_.emplace(size, settings_.layout, settings_.targets, format);
    gl::ShaderDefines defines = incremental_voxels::disproofDefines(settings_.cleanUp, volume, views, used);
    defines.merge(incremental_voxels::pointDefines(settings_.points));
    defineEnum(defines, "LAYOUT", settings_.layout);
    defines["TARGETS"] = std::to_string(settings_.targets);
    defines["FORMAT"] = settings_.format == RasterFormat::Full ? "rgba32f" : "rgba16f";
    gl::ProgramCache& programs = frame.context().programs();
    const std::string folder = "renderer/techniques/incremental_voxelization/";
    replace_ = &programs.compute(folder + "keep_voxels.comp.glsl", defines);
    pack_ = &programs.compute(folder + "pack_voxels.comp.glsl", defines);
    seen_ = &programs.compute(folder + "seen_buffers.comp.glsl", defines);
    std::vector<std::string> stages = {folder + "point.vert.glsl"};
    if (settings_.layout == VoxelLayout::Layers) stages.push_back(folder + "point.geom.glsl");
    stages.push_back(folder + "point.frag.glsl");
    draw_ = &programs.get(stages, defines);
    defines["KEEP"] = "1";
    keep_ = &programs.compute(folder + "keep_voxels.comp.glsl", defines);
    glCreateVertexArrays(1, &vertexArray_);
    return 2 * volumes_[0]->bytes() + injected_->bytes();
  }

  void update(const Step& step) override {
    makeBuffers(step);
    {
      const auto scope = step.frame.passes().open("incremental_voxelization/clean_up");
      for (int view = 0; view < used_; ++view) {
        copy(*keep_, step, *volumes_[latest_], *volumes_[1 - latest_], view);
        latest_ = 1 - latest_;
      }
      shift_ = glm::ivec3(0);
    }
    {
      const auto scope = step.frame.passes().open("incremental_voxelization/inject");
      injected_->clear();
      // The light's first: the camera's take their place.
      for (int view = used_ - 1; view >= 0; --view) drawPoints(step, view);
      copy(*replace_, step, *injected_, *volumes_[latest_], 0);
    }
    const auto scope = step.frame.passes().open("incremental_voxelization/pack");
    pack(step);
  }

  /// The clean-up that follows empties what the grid did not hold before.
  void moved(const voxels::VoxelGrid&, glm::ivec3 by) override { shift_ = by; }

 private:
  struct SeenBuffers {
    gl::Texture normal, light;
  };

  void makeBuffers(const Step& step) {
    const auto scope = step.frame.passes().open("incremental_voxelization/buffers");
    for (int view = 0; view < used_; ++view) {
      const glm::ivec2 sizePx = step.views[static_cast<size_t>(view)].sizePx;
      std::optional<SeenBuffers>& buffers = buffers_[static_cast<size_t>(view)];
      if (!buffers)
        buffers.emplace(
            SeenBuffers{gl::Texture(gl::Format::RGBA16F, sizePx), gl::Texture(gl::Format::RGBA32F, sizePx)});
      step.volume.configure(*seen_);
      incremental_voxels::configureViews(*seen_, step.views, step.volume.grid(),
                                         step.frame.gpuScene().anchor());
      incremental_voxels::configureSampleLights(*seen_, step.frame, step.lighting);
      seen_->set("seenView", view);
      seen_->set("pointsPerSide", settings_.points.side);
      buffers->normal.bindImage(kSeenNormalImage, gl::Access::Write);
      buffers->light.bindImage(kSeenLightImage, gl::Access::Write);
      seen_->dispatch(sizePx);
    }
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
  }

  void copy(const gl::Program& program, const Step& step, const VoxelTextures& from, const VoxelTextures& to,
            int view) const {
    step.volume.configure(program);
    incremental_voxels::configureDisproof(program, settings_.cleanUp, step.views, step.volume.grid(),
                                          step.frame.gpuScene().anchor());
    from.configure(program);
    from.bindSources();
    to.bindTargets();
    program.set("cleanedView", view);
    program.set("shiftX", shift_.x);
    program.set("shiftY", shift_.y);
    program.set("shiftZ", shift_.z);
    program.use();
    const glm::ivec3 size = step.volume.grid().resolution;
    glDispatchCompute(static_cast<GLuint>((size.x + kGroupSide - 1) / kGroupSide),
                      static_cast<GLuint>((size.y + kGroupSide - 1) / kGroupSide),
                      static_cast<GLuint>(size.z));
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_FRAMEBUFFER_BARRIER_BIT |
                    GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
  }

  void drawPoints(const Step& step, int view) const {
    step.volume.configure(*draw_);
    incremental_voxels::configureViews(*draw_, step.views, step.volume.grid(),
                                       step.frame.gpuScene().anchor());
    incremental_voxels::configurePoints(*draw_, settings_.points, step.number);
    injected_->configure(*draw_);
    draw_->set("seenView", view);
    draw_->set("weighted", view > 0 ? 1 : 0);
    const SeenBuffers& buffers = *buffers_[static_cast<size_t>(view)];
    buffers.normal.bindTexture(kSeenNormalUnit);
    buffers.light.bindTexture(kSeenLightUnit);
    injected_->bindFramebuffer();
    glDisable(GL_DEPTH_TEST);
    if (view > 0) {
      glEnable(GL_BLEND);
      glBlendFunc(GL_ONE, GL_ONE);
    }
    draw_->use();
    glBindVertexArray(vertexArray_);
    glDrawArrays(GL_POINTS, 0, static_cast<GLsizei>(settings_.points.perStep()));
    if (view > 0) glDisable(GL_BLEND);
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
  }

  void pack(const Step& step) const {
    step.volume.configure(*pack_);
    volumes_[latest_]->configure(*pack_);
    volumes_[latest_]->bindSources();
    step.volume.occupancy().bits().bindImage(kPackedBitsImage, gl::Access::Write);
    pack_->use();
    const glm::ivec3 words(step.volume.occupancy().bits().sizePx(), step.volume.grid().resolution.z);
    glDispatchCompute(static_cast<GLuint>(words.x), static_cast<GLuint>((words.y + 63) / 64),
                      static_cast<GLuint>(words.z));
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
  }

  PointRasterSettings settings_;
  std::array<std::optional<VoxelTextures>, 2> volumes_;
  size_t latest_ = 0;
  std::optional<VoxelTextures> injected_;
  std::array<std::optional<SeenBuffers>, incremental_voxels::kMostDepthViews> buffers_;
  const gl::Program *keep_ = nullptr, *replace_ = nullptr, *pack_ = nullptr, *seen_ = nullptr,
                    *draw_ = nullptr;
  GLuint vertexArray_ = 0;
  int used_ = 1;
  glm::ivec3 shift_{0};  // of the grid since the last step
};

const RegisteredTechnique<PointRaster> kPointRasterRegistered{
    {.name = "incremental_voxelization/point_raster",
     .version = 4,
     .summary = "Voxels kept in textures, used in turn; points are drawn into layers or into an atlas",
     .source = "Gaitatzes 2012, sections 7.4 to 7.6 (IV-01, IV-04, IV-05, IV-09)",
     .product = ProductKind::Colour,
     .followsMotion = true,
     .counters = IncrementalTechnique::quantities()}};

}  // namespace
}  // namespace limen::techniques
