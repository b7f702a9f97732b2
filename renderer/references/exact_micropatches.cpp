// SPDX-License-Identifier: BSD-3-Clause
// Share of the light's area that no micropatch of a shadow map hides: the exact area of their union, in
// double precision and without sampling. It knows no more of the scene than techniques that read the same
// map; by how much they differ from it is what their sums, samples and roundings add to the error of the map.
#include <algorithm>
#include <atomic>
#include <optional>

#include "experiments/base/error.h"
#include "renderer/frame/g_buffer.h"
#include "renderer/references/micropatches_of_map.h"
#include "renderer/references/parallel.h"
#include "renderer/references/receiver_points.h"
#include "renderer/techniques/technique.h"

namespace limen::references {
namespace {

constexpr const char* kPatchesName = "soft_shadows/exact_micropatches";
constexpr Range kConstantRange{0.0, 0.1}, kSlopeRange{0.0, 16.0}, kMaxSlopeRange{0.1, 1e6};
constexpr const char *kConstantHelp =
                         "Share of the receiver's distance from the light's plane by which a "
                         "texel must be nearer",
                     *kMaxSlopeHelp =
                         "Slope of depth, relative to distance and light-space tangent, up to "
                         "which the bias grows";

struct AgainstPlane {
  static constexpr const char *kKind = "receiver_plane",
                              *kSummary =
                                  "against the receiver's own plane at each texel's place; light "
                                  "behind that plane is hidden";
  double constant = 1e-4, slope = 0.5, maxSlope = 10.0;
  static const SettingsTable<AgainstPlane>& table() {
    static const SettingsTable<AgainstPlane> kTable = {
        {&AgainstPlane::constant, "constant", kConstantRange, "", kConstantHelp},
        {&AgainstPlane::slope, "slope", kSlopeRange, "texel",
         "Further bias by the change of the receiver's plane over as many texels of the finest level"},
        {&AgainstPlane::maxSlope, "max_slope", kMaxSlopeRange, "", kMaxSlopeHelp}};
    return kTable;
  }
  BlockingRule rule() const { return {constant, slope, maxSlope, true}; }
};

struct AgainstSlope {
  static constexpr const char *kKind = "receiver_slope",
                              *kSummary = "by the receiver's slope over texels of the level";
  double constant = 1e-4, slope = 1.0, maxSlope = 10.0;
  static const SettingsTable<AgainstSlope>& table() {
    static const SettingsTable<AgainstSlope> kTable = {
        {&AgainstSlope::constant, "constant", kConstantRange, "", kConstantHelp},
        {&AgainstSlope::slope, "slope", kSlopeRange, "texel",
         "Depth bias by the receiver's slope, in texels of the level"},
        {&AgainstSlope::maxSlope, "max_slope", kMaxSlopeRange, "", kMaxSlopeHelp}};
    return kTable;
  }
  BlockingRule rule() const { return {constant, slope, maxSlope, false}; }
};

struct AgainstConstant {
  static constexpr const char *kKind = "constant", *kSummary = "only a share of the receiver's distance";
  double constant = 1e-4;
  static const SettingsTable<AgainstConstant>& table() {
    static const SettingsTable<AgainstConstant> kTable = {
        {&AgainstConstant::constant, "constant", kConstantRange, "", kConstantHelp}};
    return kTable;
  }
  BlockingRule rule() const { return {constant, 0.0, 1e6, false}; }
};

struct ExactMicropatchesSettings {
  int resolution = 256;
  frame::Raster raster = frame::Raster::Auto;
  int level = 0;
  PatchStretch gapFill = PatchStretch::None;
  std::variant<AgainstPlane, AgainstSlope, AgainstConstant> bias;
  static const SettingsTable<ExactMicropatchesSettings>& table() {
    using S = ExactMicropatchesSettings;
    static const SettingsTable<S> kTable = {
        {&S::resolution, "resolution", oneOf({1, 2, 64, 128, 256, 512, 1024, 2048, 4096}), "texel",
         "Side of the shadow map; time grows with its square"},
        {&S::raster, "raster", "How the shadow map is rasterised, as in the techniques that read it"},
        {&S::level,
         "level",
         {0, 12},
         "",
         "Level of the map whose texels are micropatches, each at the nearest depth that it covers",
         "Schwarz 2009, section 4.1"},
        {&S::gapFill, "gap_fill", "Neighbours to which a micropatch is stretched to close gaps",
         "Schwarz 2009, section 4.1"},
        Binding(&S::bias, "bias", "How far a texel must be nearer to the light than a receiver to hide it",
                "Schwarz 2009, section 4.5.4")
            .shorthand("constant")};
    return kTable;
  }
  void check() const {
    if ((resolution >> level) == 0)
      throw Error(
          "a map of " + std::to_string(resolution) + " texels per side has no level " + std::to_string(level),
          "level", "give a lower level, or a higher resolution");
  }
};

class ExactMicropatches : public techniques::Technique {
 public:
  using Settings = ExactMicropatchesSettings;
  explicit ExactMicropatches(const ExactMicropatchesSettings& settings) : settings_(settings) {}

  void prepare(frame::Frame& frame) override {
    triangles_.emplace(frame.scene(), frame.gpuScene().anchor());
    product_.emplace(gl::Format::R32F, frame.sizePx());
    visibility_ = Image(frame.sizePx().x, frame.sizePx().y, 1);
    frame.passes().setBytesHeld("exact_micropatches/upload", product_->bytes());
  }

  void render(frame::Frame& frame) override {
    const auto& map =
        frame.get<frame::ShadowMap>(frame::ShadowMapSettings{settings_.resolution, settings_.raster});
    const BlockingRule rule = std::visit([](const auto& form) { return form.rule(); }, settings_.bias);
    const MicropatchesOfMap patches(map.texture().read(), map.frustum(), frame.scene().lights.at(0).size,
                                    settings_.level, rule, settings_.gapFill);
    const std::vector<ReceiverPoint> points = readReceiverPoints(frame, *triangles_);
    const Image receivers = frame.get<frame::Receivers>().texture().read();
    {
      const auto scope = frame.passes().open("exact_micropatches/union");
      unite(frame, patches, points, receivers);
    }
    const auto scope = frame.passes().open("exact_micropatches/upload");
    product_->write(visibility_);
  }

  const gl::Texture& product() const override { return *product_; }

  std::vector<techniques::Counter> count(frame::Frame&) override {
    return {{"micropatches_per_receiver", patchesPerReceiver_}};
  }

 private:
  /// Positions are those that techniques are given, in float; normals are those of the triangles, in double.
  void unite(const frame::Frame& frame, const MicropatchesOfMap& patches,
             const std::vector<ReceiverPoint>& points, const Image& receivers) {
    const glm::dmat3 toLight(frame.scene().lights.at(0).toLightSpace(frame.gpuScene().anchor()));
    std::fill(visibility_.data.begin(), visibility_.data.end(), 1.0F);
    std::atomic<int64_t> found = 0;
    parallelFor(points.size(), [&](size_t, size_t first, size_t last) {
      RectangleUnion hidden;
      for (size_t i = first; i < last; ++i) {
        const float* at = &receivers.data[4 * size_t{points[i].pixel}];
        const PatchReceiver receiver{{at[0], at[1], at[2]}, toLight * points[i].normal};
        visibility_.data[points[i].pixel] = static_cast<float>(patches.visibility(receiver, hidden));
        found += static_cast<int64_t>(hidden.rectangles().size());
      }
    });
    patchesPerReceiver_ = points.empty() ? 0.0 : double(found) / double(points.size());
  }

  ExactMicropatchesSettings settings_;
  std::optional<Triangles> triangles_;
  std::optional<gl::Texture> product_;
  Image visibility_;
  double patchesPerReceiver_ = 0.0;
};

const techniques::RegisteredTechnique<ExactMicropatches> kExactMicropatchesRegistered{
    {.name = kPatchesName,
     .version = 1,
     .summary =
         "Exact area of the light that the union of a shadow map's micropatches leaves, double precision",
     .source = "Schwarz 2009, section 4.1 (SS-05)",
     .needs = {"rectangular_light"},
     .reference = true,
     .onCpu = true,
     .counters = {{"micropatches_per_receiver", "Micropatches per receiver that hide some of the light", "",
                   Direction::LowerIsBetter}}}};

}  // namespace
}  // namespace limen::references
