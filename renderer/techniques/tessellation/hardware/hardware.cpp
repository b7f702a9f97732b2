// SPDX-License-Identifier: BSD-3-Clause
// Curved surfaces by the tessellation stages of the driver (SC-68), with the factors of tessellation/compute.
// The thesis notes that these stages have no place to make factors agree between patches: a compute pass
// before does. Fractional spacings get the real factors, so that vertices move as the view does.
#include <epoxy/gl.h>

#include <algorithm>

#include "renderer/frame/g_buffer.h"
#include "renderer/techniques/technique.h"
#include "renderer/techniques/tessellation/factor_pass.h"
#include "renderer/techniques/tessellation/surface_picture.h"
#include "renderer/techniques/tessellation/tessellation_bindings.h"

namespace limen::techniques {
namespace {

/// Of the tessellator.
enum class DriverSpacing { Equal, FractionalEven, FractionalOdd };
constexpr EnumNames<DriverSpacing, 3> enumNames(DriverSpacing) {
  return {{{{DriverSpacing::Equal, "equal"},
            {DriverSpacing::FractionalEven, "fractional_even"},
            {DriverSpacing::FractionalOdd, "fractional_odd"}}}};
}

struct HardwareTessellationSettings {
  FactorSettings tessellation;
  DriverSpacing spacing = DriverSpacing::Equal;
  frame::ShadedSetting shading;
  static const SettingsTable<HardwareTessellationSettings>& table() {
    using S = HardwareTessellationSettings;
    static const SettingsTable<S> kTable = {
        included(&S::tessellation),
        {&S::spacing, "spacing", "How the tessellator divides a side", "OpenGL 4.5, section 11.2.2"},
        frame::shadingBinding(&S::shading)};
    return kTable;
  }
};

/// llvmpipe (Mesa 22.3) draws wrong triangles if one draw evaluates more vertices.
constexpr int kVerticesPerSoftwareDraw = 65536;

class HardwareTessellation : public Technique {
 public:
  using Settings = HardwareTessellationSettings;
  explicit HardwareTessellation(const Settings& settings) : settings_(settings) {}
  ~HardwareTessellation() override {
    if (vertexArray_) glDeleteVertexArrays(1, &vertexArray_);
  }

  void prepare(frame::Frame& frame) override {
    patches_.emplace(frame.scene(), frame.gpuScene().anchor(), DrawnSurfaces{.moving = true});
    factors_.emplace(frame, *patches_, settings_.tessellation);
    picture_.emplace(frame, settings_.shading, "tessellation");
    std::vector<uint32_t> numbers;
    for (const surfaces::Domain domain : {surfaces::Domain::Rectangle, surfaces::Domain::Triangle}) {
      Group& group = groups_[static_cast<size_t>(domain)];
      group.first = static_cast<int>(numbers.size());
      const auto& patches = frame.scene().surfaces.patches;
      for (uint32_t i = 0; i < patches.size(); ++i)
        if (patches[i].domain == domain) numbers.push_back(i);
      group.count = static_cast<int>(numbers.size()) - group.first;
      if (group.count > 0) group.program = &programFor(frame, domain);
    }
    numbers_.emplace(numbers);
    glCreateVertexArrays(1, &vertexArray_);
    glVertexArrayAttribIFormat(vertexArray_, 0, 1, GL_UNSIGNED_INT, 0);
    glVertexArrayAttribBinding(vertexArray_, 0, 0);
    glEnableVertexArrayAttrib(vertexArray_, 0);
    glVertexArrayVertexBuffer(vertexArray_, 0, numbers_->id(), 0, sizeof(uint32_t));
    perDraw_ =
        frame.context().device().software ? std::max(1, kVerticesPerSoftwareDraw / mostVertices()) : 1 << 30;
    frame.passes().setBytesHeld("tessellation/factors", patches_->bytes() + factors_->bytes());
  }

  void render(frame::Frame& frame) override {
    factors_->run(frame);
    picture_->render(frame, [&] { draw(frame); });
  }

  const gl::Texture& product() const override { return picture_->texture(); }

  std::vector<Counter> count(frame::Frame& frame) override {
    const uint32_t triangles = picture_->countTriangles(frame, [&] { draw(frame); });
    const std::vector<PatchFactors> factors = factors_->factors().read<PatchFactors>(0, patches_->count());
    const auto culled = [](const PatchFactors& of) { return of.segments == 0; };
    return {{"patches_culled", double(std::count_if(factors.begin(), factors.end(), culled))},
            {"patches_capped", double(factors_->countCapped(frame))},
            {"tessellated_triangles", double(triangles)}};
  }

 private:
  struct Group {  // patches of one domain
    const gl::Program* program = nullptr;
    int first = 0, count = 0;
  };

  const gl::Program& programFor(frame::Frame& frame, surfaces::Domain domain) const {
    gl::ShaderDefines defines = patches_->defines();
    defines["SPACING"] = std::string(limen::toText(settings_.spacing)) + "_spacing";
    if (settings_.spacing != DriverSpacing::Equal) defines["FRACTIONAL"] = "1";
    if (domain == surfaces::Domain::Rectangle) defines["RECTANGLES"] = "1";
    const std::string folder = "renderer/techniques/tessellation/";
    return frame.context().programs().get(
        {folder + "hardware/patch.vert.glsl", folder + "hardware/levels.tesc.glsl",
         folder + "hardware/surface.tese.glsl", folder + "surface.frag.glsl"},
        defines);
  }

  /// Of one patch; fractional spacing rounds up to the next even or odd number.
  int mostVertices() const {
    const int side = settings_.tessellation.mostSegments() + 3;
    return side * side;
  }

  void draw(frame::Frame& frame) const {
    patches_->bindStorage();
    factors_->factors().bindStorage(kFactorsBuffer);
    glBindVertexArray(vertexArray_);
    glPatchParameteri(GL_PATCH_VERTICES, 1);
    for (const Group& group : groups_) {
      if (group.count == 0) continue;
      group.program->use();
      group.program->set("anchorToClip", frame::anchorToClip(frame));
      for (int at = 0; at < group.count; at += perDraw_)
        glDrawArrays(GL_PATCHES, group.first + at, std::min(perDraw_, group.count - at));
    }
  }

  Settings settings_;
  std::optional<PatchBuffers> patches_;
  std::optional<FactorPass> factors_;
  std::optional<SurfacePicture> picture_;
  std::array<Group, 2> groups_;
  std::optional<gl::Buffer> numbers_;
  int perDraw_ = 1;
  uint32_t vertexArray_ = 0;
};

const RegisteredTechnique<HardwareTessellation> kHardwareTessellationRegistered{
    {.name = "tessellation/hardware",
     .version = 2,
     .summary =
         "Curved surfaces by the driver's tessellation stages, with factors made to agree in a compute pass",
     .source = "Schwarz 2009, section 7.5.5 (SC-68)",
     .product = ProductKind::Colour,
     .needs = {"curved_surfaces"},
     .counters = {{"patches_culled", "Patches culled", "patches", Direction::Neither},
                  {"patches_capped", "Patches that more segments than allowed would be needed for", "patches",
                   Direction::LowerIsBetter},
                  {"tessellated_triangles", "Triangles made", "triangles", Direction::LowerIsBetter}}}};

}  // namespace
}  // namespace limen::techniques
