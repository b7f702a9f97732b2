// SPDX-License-Identifier: BSD-3-Clause
// Ambient occlusion from the depths around each pixel: points in the half sphere over the surface compared
// with them (Mittring 2007), how much of lines through it lies in front of them (Loos and Sloan 2010), or how
// high they rise over the horizon (Bavoil et al. 2008). In full, K x K places; separably (Holländer 2013,
// section 7.2.2), K along each of two axes, the same for all pixels or turned from pixel to pixel in tiles of
// the kernel's size, whose directions smoothing then averages.
//
// Departures: lines are those of sight, so that a plane never occludes itself; sums are divided by what an
// unoccluded point has, where eq. 7.1 divides by K^2; along an axis, places weigh by their distance, so that
// turned axes add up to the disc (`weights: uniform` does without, as printed). Both axes are one pass.
#include <epoxy/gl.h>

#include <numeric>
#include <optional>
#include <variant>

#include "renderer/frame/g_buffer.h"
#include "renderer/techniques/ambient_occlusion/occlusion_bindings.h"
#include "renderer/techniques/ambient_occlusion/occlusion_radius.h"
#include "renderer/techniques/technique.h"

namespace limen::techniques {
namespace {

constexpr const char* kOcclusionFolder = "renderer/techniques/ambient_occlusion/";

enum class OcclusionMethod { Points, Volume, Horizon };
constexpr EnumNames<OcclusionMethod, 3> enumNames(OcclusionMethod) {
  return {{{{OcclusionMethod::Points, "points"},
            {OcclusionMethod::Volume, "volume"},
            {OcclusionMethod::Horizon, "horizon"}}}};
}
enum class OcclusionForm { Full, Separable };
constexpr EnumNames<OcclusionForm, 2> enumNames(OcclusionForm) {
  return {{{{OcclusionForm::Full, "full"}, {OcclusionForm::Separable, "separable"}}}};
}
enum class AxisFrames { Random, Fixed };
constexpr EnumNames<AxisFrames, 2> enumNames(AxisFrames) {
  return {{{{AxisFrames::Random, "random"}, {AxisFrames::Fixed, "fixed"}}}};
}
enum class AxisWeights { Radial, Uniform };
constexpr EnumNames<AxisWeights, 2> enumNames(AxisWeights) {
  return {{{{AxisWeights::Radial, "radial"}, {AxisWeights::Uniform, "uniform"}}}};
}

struct ScreenOcclusion {
  OcclusionMethod method = OcclusionMethod::Volume;
  int kernel = 16;
  double mostPx = 256.0, bias = 0.001, thickness = 1.0;
  OcclusionRadius radius;
  static const SettingsTable<ScreenOcclusion>& table() {
    using S = ScreenOcclusion;
    static const SettingsTable<S> kTable = {
        {&S::method, "method", "Compare points, measure lines, or find horizons",
         "Mittring 2007; Loos and Sloan 2010; Bavoil et al. 2008"},
        {&S::kernel,
         "kernel",
         {2, 64},
         "",
         "Places along each axis of the kernel (k)",
         "Holländer 2013, section 7.2.2"},
        {&S::mostPx, "most_px", {1.0, 2048.0}, "px", "Radius in the picture at most"},
        {&S::bias,
         "bias",
         {0.0, 1.0},
         "",
         "Share of the radius (or sine) that a surface must stand out to occlude"},
        {&S::thickness,
         "thickness",
         {0.0, 1000.0},
         "radii",
         "Surfaces farther in front of the sphere than this occlude nothing (points, volume)"},
        included(&S::radius)};
    return kTable;
  }
};

struct FullOcclusionSettings {
  ScreenOcclusion screen;
  static const SettingsTable<FullOcclusionSettings>& table() {
    static const SettingsTable<FullOcclusionSettings> kTable = {included(&FullOcclusionSettings::screen)};
    return kTable;
  }
};

struct SeparableOcclusionSettings {
  ScreenOcclusion screen;
  AxisFrames frames = AxisFrames::Random;
  AxisWeights weights = AxisWeights::Radial;
  bool smoothing = true;
  double depthTolerance = 0.005;
  static const SettingsTable<SeparableOcclusionSettings>& table() {
    using S = SeparableOcclusionSettings;
    static const SettingsTable<S> kTable = {
        included(&S::screen),
        {&S::frames, "frames", "Axes turned from pixel to pixel, or those of the picture",
         "Holländer 2013, section 7.2.2"},
        {&S::weights, "weights", "Places weigh by their distance, or all the same as printed"},
        {&S::smoothing, "smoothing", "Average over tiles of the kernel's size within surfaces",
         "Holländer 2013, section 7.2.2"},
        {&S::depthTolerance,
         "depth_tolerance",
         {1e-6, 1.0},
         "",
         "Distance from a pixel's plane, as a share of its depth, at which smoothing weighs 1/e"}};
    return kTable;
  }
};

/// Both forms: `Settings` says which.
template <class S>
class ScreenSpaceOcclusion : public Technique {
 public:
  using Settings = S;
  static constexpr bool kSeparable = std::is_same_v<S, SeparableOcclusionSettings>;
  explicit ScreenSpaceOcclusion(const S& settings) : settings_(settings) {}

  void prepare(frame::Frame& frame) override {
    gl::ProgramCache& programs = frame.context().programs();
    gl::ShaderDefines defines = occlusionDefines();
    occlude_ = &programs.compute(std::string(kOcclusionFolder) + "occlusion.comp.glsl", defines);
    defines["COUNT"] = "1";
    counting_ = &programs.compute(std::string(kOcclusionFolder) + "occlusion.comp.glsl", defines);
    const std::string tile = std::to_string(settings_.screen.kernel);
    packed_.emplace(gl::Format::RGBA32F, frame.sizePx());
    picture_.emplace(gl::Format::RGBA32F, frame.sizePx());
    frame.passes().setBytesHeld("ambient_occlusion/occlude", packed_->bytes());
    if (smooths()) {
      along_ = &programs.compute(std::string(kOcclusionFolder) + "smooth.comp.glsl", {{"TILE", tile}});
      across_ = &programs.compute(std::string(kOcclusionFolder) + "smooth.comp.glsl",
                                  {{"TILE", tile}, {"LAST", "1"}});
      half_.emplace(gl::Format::RGBA32F, frame.sizePx());
      frame.passes().setBytesHeld("ambient_occlusion/smooth", half_->bytes() + picture_->bytes());
    } else {
      across_ = &programs.compute(std::string(kOcclusionFolder) + "grey.comp.glsl");
      frame.passes().setBytesHeld("ambient_occlusion/grey", picture_->bytes());
    }
  }

  void render(frame::Frame& frame) override {
    occlude(frame, *occlude_);
    const auto scope = frame.passes().open(smooths() ? "ambient_occlusion/smooth" : "ambient_occlusion/grey");
    if constexpr (kSeparable)
      if (smooths()) {
        packed_->bindTexture(kOcclusionPackedUnit);
        half_->bindImage(kOcclusionPackedImage, gl::Access::Write);
        smoothAlong(frame, *along_, {1, 0});
        half_->bindTexture(kOcclusionPackedUnit);
        picture_->bindImage(kOcclusionOutImage, gl::Access::Write);
        smoothAlong(frame, *across_, {0, 1});
        return;
      }
    packed_->bindTexture(kOcclusionPackedUnit);
    picture_->bindImage(kOcclusionOutImage, gl::Access::Write);
    across_->set("sizePx", frame.sizePx());
    across_->dispatch(frame.sizePx());
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
  }

  const gl::Texture& product() const override { return *picture_; }

  std::vector<Counter> count(frame::Frame& frame) override {
    const gl::Buffer counts(int64_t{4} * kOcclusionSlots, nullptr);
    counts.clearUint(0);
    counts.bindStorage(kOcclusionCountsBuffer);
    occlude(frame, *counting_);
    const std::vector<uint32_t> each = counts.read<uint32_t>();
    const double fetches = std::accumulate(each.begin(), each.end(), 0.0);
    const Image seen = packed_->read();
    double surfaces = 0.0;
    for (int y = 0; y < seen.height; ++y)
      for (int x = 0; x < seen.width; ++x) surfaces += seen.at(x, y, 1) > 0.0F;
    const double taps = smooths() ? 2.0 * settings_.screen.kernel : 0.0;
    return {{"fetches_per_surface_px", surfaces > 0.0 ? fetches / surfaces : 0.0},
            {"smoothing_fetches_per_px", taps}};
  }

 private:
  bool smooths() const {
    if constexpr (kSeparable) return settings_.smoothing;
    return false;
  }

  gl::ShaderDefines occlusionDefines() const {
    const std::string kernel = std::to_string(settings_.screen.kernel);
    gl::ShaderDefines defines = {{"K", kernel}, {"TILE", kernel}};
    defineEnum(defines, "METHOD", settings_.screen.method);
    defineEnum(defines, "FORM", kSeparable ? OcclusionForm::Separable : OcclusionForm::Full);
    if constexpr (kSeparable) {
      defineEnum(defines, "FRAMES", settings_.frames);
      defineEnum(defines, "WEIGHTS", settings_.weights);
    }
    return defines;
  }

  static glm::vec2 rayScaleOf(const frame::Frame& frame) {
    return {frame.tanHalfFov() * frame.aspect(), frame.tanHalfFov()};
  }

  void occlude(frame::Frame& frame, const gl::Program& program) {
    using frame::Channel;
    const auto& depths = frame.get<frame::GBufferChannel>(frame::ChannelSetting{Channel::Depth});
    const auto& normals = frame.get<frame::GBufferChannel>(frame::ChannelSetting{Channel::Normal});
    const auto scope = frame.passes().open("ambient_occlusion/occlude");
    const ScreenOcclusion& screen = settings_.screen;
    program.set("sizePx", frame.sizePx());
    program.set("rayScale", rayScaleOf(frame));
    program.set("toCamera", glm::mat3(frame.anchorToCamera()));
    program.set("radius", screen.radius.of(frame));
    program.set("mostPx", static_cast<float>(screen.mostPx));
    program.set("bias", static_cast<float>(screen.bias));
    program.set("thickness", static_cast<float>(screen.thickness));
    depths.texture().bindTexture(kOcclusionDepthUnit);
    normals.texture().bindTexture(kOcclusionNormalUnit);
    packed_->bindImage(kOcclusionPackedImage, gl::Access::Write);
    program.dispatch(frame.sizePx());
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT |
                    GL_BUFFER_UPDATE_BARRIER_BIT);
  }

  void smoothAlong(frame::Frame& frame, const gl::Program& program, glm::ivec2 axis) {
    if constexpr (kSeparable) {
      program.set("sizePx", frame.sizePx());
      program.set("axis", axis);
      program.set("rayScale", rayScaleOf(frame));
      program.set("depthTolerance", static_cast<float>(settings_.depthTolerance));
      program.dispatch(frame.sizePx());
      glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
    }
  }

  S settings_;
  const gl::Program *occlude_ = nullptr, *counting_ = nullptr, *along_ = nullptr, *across_ = nullptr;
  std::optional<gl::Texture> packed_, half_, picture_;
};

std::vector<Quantity> occlusionQuantities() {
  return {{"fetches_per_surface_px", "Depths fetched per pixel with a surface", "1/px",
           Direction::LowerIsBetter, "Holländer 2013, section 7.2.2"},
          {"smoothing_fetches_per_px", "Pixels that smoothing averages, per pixel", "1/px",
           Direction::LowerIsBetter, "Holländer 2013, section 7.2.2"}};
}

const RegisteredTechnique<ScreenSpaceOcclusion<FullOcclusionSettings>> kFullOcclusion{
    {.name = "ambient_occlusion/full",
     .version = 1,
     .summary = "Ambient occlusion from k x k depths around each pixel",
     .source = "Holländer 2013, section 7.2.1 (HOL-56)",
     .product = ProductKind::Colour,
     .counters = occlusionQuantities()}};

const RegisteredTechnique<ScreenSpaceOcclusion<SeparableOcclusionSettings>> kSeparableOcclusion{
    {.name = "ambient_occlusion/separable",
     .version = 1,
     .summary = "Ambient occlusion from k depths along each of two axes",
     .source = "Holländer 2013, section 7.2.2 (HOL-57, HOL-58)",
     .product = ProductKind::Colour,
     .counters = occlusionQuantities()}};

}  // namespace
}  // namespace limen::techniques
