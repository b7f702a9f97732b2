// SPDX-License-Identifier: BSD-3-Clause
// Ray casting of PN triangles in prisms around them (SC-30 to SC-32): Schwarz 2009, section 6.5.2. Newton's
// method in the fragment shader starts near the corners and in the middle, nearest first. Differences from
// the thesis and choices where it gives no numbers:
// - Sides turned away from the eye are drawn, so that nothing is lost where the eye is within a prism;
//   `sides: front` is the thesis' way.
// - Prisms are made once, on the CPU.
// - Offset of the starts, tolerance and number of steps are the bench's own: the thesis states none.
// - A root outside the domain by no more than the tolerance counts, so that no holes are left between
// triangles.
// - No start is tried where the hull of the control points misses the ray.
#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>

#include "renderer/frame/g_buffer.h"
#include "renderer/techniques/ray_casting/hit_counters.h"
#include "renderer/techniques/ray_casting/pn_prisms/prism_buffers.h"
#include "renderer/techniques/ray_casting/ray_casting_bindings.h"
#include "renderer/techniques/technique.h"
#include "renderer/techniques/tessellation/surface_picture.h"
#include "renderer/techniques/tessellation/surface_view.h"

namespace limen::techniques {
namespace {

enum class PrismSides { Back, Front };
constexpr EnumNames<PrismSides, 2> enumNames(PrismSides) {
  return {{{{PrismSides::Back, "back"}, {PrismSides::Front, "front"}}}};
}

struct PnPrismSettings {
  int starts = 4;
  bool sorted = true;
  int steps = 8;
  double tolerancePx = 0.003;
  double cornerOffset = 0.1;
  int subPrisms = 1;
  PrismSides sides = PrismSides::Back;
  bool check = true;
  frame::ShadedSetting shading;
  static const SettingsTable<PnPrismSettings>& table() {
    using S = PnPrismSettings;
    static const SettingsTable<S> kTable = {
        {&S::starts, "starts", oneOf({1, 4, 7, 13}), "starts",
         "Starts of Newton's method; 1: below the fragment, as in texturing",
         "Schwarz 2009, section 6.5.2 (4)"},
        {&S::sorted, "sorted", "Starts are tried in the order in which the ray passes them"},
        {&S::steps, "steps", {1, 64}, "steps", "Newton steps from each start at most"},
        {&S::tolerancePx,
         "tolerance_px",
         {0.001, 4},
         "px",
         "Distance from the ray, and of a root from the triangle, that counts as a hit"},
        {&S::cornerOffset,
         "corner_offset",
         {0, 0.3},
         "",
         "Barycentric distance of the starts near corners and sides from these"},
        {&S::subPrisms, "sub_prisms", oneOf({1, 4, 16}), "prisms",
         "Parts of a triangle with a prism of their own", "Schwarz 2009, section 6.5.2"},
        {&S::sides, "sides", "Sides of a prism that are drawn: turned to the eye, or away from it"},
        {&S::check, "check", "Compare all pixels with interval arithmetic when counting"},
        frame::shadingBinding(&S::shading)};
    return kTable;
  }
};

/// Newton steps of each pixel, as a picture: black where no prism is, then blue to green to red.
Image stepsPicture(const std::vector<uint32_t>& steps, const std::vector<uint32_t>& fragments,
                   glm::ivec2 sizePx) {
  constexpr double kMostSteps = 64.0;
  Image out(sizePx.x, sizePx.y, 3);
  for (size_t i = 0; i < steps.size(); ++i) {
    if (fragments[i] == 0) continue;
    const auto t =
        static_cast<float>(2.0 * std::min(std::log2(1.0 + steps[i]) / std::log2(1.0 + kMostSteps), 1.0));
    const glm::vec3 colour = t < 1.0F ? glm::mix(glm::vec3(0, 0, 1), glm::vec3(0, 1, 0), t)
                                      : glm::mix(glm::vec3(0, 1, 0), glm::vec3(1, 0, 0), t - 1.0F);
    for (int c = 0; c < 3; ++c) out.data[3 * i + static_cast<size_t>(c)] = colour[c];
  }
  return out;
}

class PnPrisms : public Technique {
 public:
  using Settings = PnPrismSettings;
  explicit PnPrisms(const Settings& settings) : settings_(settings) {}

  void prepare(frame::Frame& frame) override {
    prisms_.emplace(frame.scene(), frame.gpuScene().anchor(),
                    settings_.subPrisms == 1   ? 0
                    : settings_.subPrisms == 4 ? 1
                                               : 2);
    picture_.emplace(frame, settings_.shading, "ray_casting");
    gl::ShaderDefines defines = {{"STARTS", std::to_string(settings_.starts)}};
    if (settings_.sorted) defines["SORTED"] = "1";
    const std::string folder = "renderer/techniques/ray_casting/pn_prisms/";
    const std::vector<std::string> shaders = {folder + "prism.vert.glsl", folder + "prism.frag.glsl"};
    program_ = &frame.context().programs().get(shaders, defines);
    defines["COUNTING"] = "1";
    countingProgram_ = &frame.context().programs().get(shaders, defines);
    frame.passes().setBytesHeld("ray_casting/prisms", prisms_->bytes());
  }

  void render(frame::Frame& frame) override {
    picture_->render(frame, [&] { draw(frame, *program_); });
  }

  const gl::Texture& product() const override { return picture_->texture(); }

  std::vector<Counter> count(frame::Frame& frame) override {
    const glm::ivec2 size = frame.sizePx();
    const gl::Texture ids(gl::Format::R32UI, size), normals(gl::Format::RGBA32F, size),
        depth(gl::Format::Depth32F, size);
    const gl::Texture steps(gl::Format::R32UI, size), starts(gl::Format::R32UI, size),
        fragments(gl::Format::R32UI, size);
    for (const gl::Texture* texture : {&steps, &starts, &fragments}) texture->clearUint(glm::uvec4(0));
    const gl::Framebuffer framebuffer({&ids, &normals}, &depth);
    framebuffer.bind();
    constexpr std::array<GLfloat, 4> kNothing = {};
    constexpr std::array<GLuint, 4> kNone = {};
    constexpr GLfloat kFar = 0.0F;
    glClearBufferuiv(GL_COLOR, 0, kNone.data());
    glClearBufferfv(GL_COLOR, 1, kNothing.data());
    glClearBufferfv(GL_DEPTH, 0, &kFar);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_GREATER);
    steps.bindImage(kNewtonStepsImage, gl::Access::ReadWrite);
    starts.bindImage(kStartsTriedImage, gl::Access::ReadWrite);
    fragments.bindImage(kPrismFragmentsImage, gl::Access::ReadWrite);
    draw(frame, *countingProgram_);
    glDisable(GL_DEPTH_TEST);
    glMemoryBarrier(GL_TEXTURE_UPDATE_BARRIER_BIT | GL_FRAMEBUFFER_BARRIER_BIT);
    steps_ = steps.readUint(), fragments_ = fragments.readUint(), sizePx_ = size;
    std::vector<Counter> out = stepCounters(starts.readUint());
    if (settings_.check) std::ranges::copy(hitCounters(frame, normals.read()), std::back_inserter(out));
    return out;
  }

  std::map<std::string, PictureMaker> pictures() const override {
    if (steps_.empty()) return {};
    return {{"newton_steps", [steps = steps_, fragments = fragments_, size = sizePx_] {
               return stepsPicture(steps, fragments, size);
             }}};
  }

  static std::vector<Quantity> quantities() {
    const Direction lower = Direction::LowerIsBetter;
    return withHitQuantities(
        {{"prisms", "Prisms", "prisms", Direction::Neither},
         {"prism_fragments_per_px", "Fragments of prisms, mean of the pixels with any", "fragments/px",
          lower},
         {"newton_starts_per_px", "Newton starts, mean of the pixels with prisms", "starts/px", lower},
         {"newton_steps_per_px", "Newton steps, mean of the pixels with prisms", "steps/px", lower},
         {"newton_steps_max", "Newton steps of a pixel, most", "steps", lower}});
  }

 private:
  void draw(frame::Frame& frame, const gl::Program& program) const {
    program.use();
    program.set("anchorToClip", frame::anchorToClip(frame));
    program.set("cameraToAnchor", glm::mat4(glm::inverse(frame.anchorToCamera())));
    program.set("sizePx", frame.sizePx());
    program.set("rayScale", glm::vec2(frame.tanHalfFov() * frame.aspect(), frame.tanHalfFov()));
    const double pixel = 2.0 * frame.tanHalfFov() / frame.sizePx().y;  // at distance 1 along the view
    program.set("tolerance", static_cast<float>(settings_.tolerancePx * pixel));
    program.set("nearest", static_cast<float>(frame::nearPlane(frame)));
    program.set("cornerOffset", static_cast<float>(settings_.cornerOffset));
    program.set("steps", settings_.steps);
    prisms_->draw(settings_.sides == PrismSides::Front);
  }

  std::vector<Counter> stepCounters(const std::vector<uint32_t>& starts) const {
    double covered = 0.0, fragmentSum = 0.0, startSum = 0.0, stepSum = 0.0, most = 0.0;
    for (size_t i = 0; i < starts.size(); ++i) {
      covered += fragments_[i] > 0;
      fragmentSum += fragments_[i], startSum += starts[i], stepSum += steps_[i];
      most = std::max(most, double(steps_[i]));
    }
    const double pixels = std::max(covered, 1.0);
    return {{"prisms", double(prisms_->prisms())},
            {"prism_fragments_per_px", fragmentSum / pixels},
            {"newton_starts_per_px", startSum / pixels},
            {"newton_steps_per_px", stepSum / pixels},
            {"newton_steps_max", most}};
  }

  Settings settings_;
  std::optional<PrismBuffers> prisms_;
  std::optional<SurfacePicture> picture_;
  const gl::Program *program_ = nullptr, *countingProgram_ = nullptr;
  std::vector<uint32_t> steps_, fragments_;
  glm::ivec2 sizePx_{0};
};

const RegisteredTechnique<PnPrisms> kPnPrismsRegistered{
    {.name = "ray_casting/pn_prisms",
     .version = 2,
     .summary =
         "PN triangles by casting rays in prisms around them, with Newton's method from several starts",
     .source = "Schwarz 2009, section 6.5.2 (SC-30, SC-31)",
     .product = ProductKind::Colour,
     .needs = {"curved_surfaces"},
     .counters = PnPrisms::quantities()}};

}  // namespace
}  // namespace limen::techniques
