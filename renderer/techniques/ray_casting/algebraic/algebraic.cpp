// SPDX-License-Identifier: BSD-3-Clause
// Ray casting of algebraic surfaces (SC-27 to SC-29): Schwarz 2009, section 6.4.1. The surface stands around
// the camera's target, in place of the scene's own curved parts, within a ball. Roots along a ray are found
// - by closed formulas up to degree 4 (quadrics; Loop and Blinn 2006),
// - by interval arithmetic on the polynomial (Knoll et al. 2007), which misses none,
// - in Bernstein form, halved until a part has one sign (Reimers and Seland 2008 insert knots instead).
// Coefficients come
//   from values along the ray by interpolation, in float or double.
#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "renderer/frame/g_buffer.h"
#include "renderer/surfaces/algebraic.h"
#include "renderer/techniques/ray_casting/hit_counters.h"
#include "renderer/techniques/ray_casting/ray_casting_bindings.h"
#include "renderer/techniques/technique.h"
#include "renderer/techniques/tessellation/surface_picture.h"
#include "renderer/techniques/tessellation/surface_view.h"

namespace limen::techniques {
namespace {

using surfaces::Algebraic;

enum class Roots { ClosedFormula, Intervals, Bernstein };
constexpr EnumNames<Roots, 3> enumNames(Roots) {
  return {{{{Roots::Bernstein, "bernstein"},
            {Roots::Intervals, "intervals"},
            {Roots::ClosedFormula, "closed_formula"}}}};
}
enum class Precision { Float, Double };
constexpr EnumNames<Precision, 2> enumNames(Precision) {
  return {{{{Precision::Float, "float"}, {Precision::Double, "double"}}}};
}

struct AlgebraicSettings {
  Algebraic surface = Algebraic::Torus;
  Roots roots = Roots::Bernstein;
  Precision precision = Precision::Double;
  int mostSteps = 20;
  double size = 0.3;
  double tiltDeg = 35.0;
  bool compare = true;
  frame::ShadedSetting shading;
  static const SettingsTable<AlgebraicSettings>& table() {
    using S = AlgebraicSettings;
    static const SettingsTable<S> kTable = {
        {&S::surface, "surface", "Which surface, around the camera's target", "Schwarz 2009, section 6.4"},
        {&S::roots, "roots", "How the first root along a ray is found", "Schwarz 2009, section 6.4.1"},
        {&S::precision, "precision", "Of the polynomial's values and coefficients"},
        {&S::mostSteps, "most_steps", {4, 24}, "steps", "Halvings of a ray's part in the ball"},
        {&S::size, "size", {0.01, 10}, "", "Radius of the surface's ball over the target's distance"},
        {&S::tiltDeg, "tilt_deg", {-180, 180}, "degree", "Rotation around the x axis"},
        {&S::compare, "check", "Compare all pixels with exact ray casting when counting"},
        frame::shadingBinding(&S::shading)};
    return kTable;
  }
  void check() const {
    const int degree = surfaces::degreeOf(surface);
    if (roots == Roots::ClosedFormula && degree > 4)
      throw Error("there is no closed formula for roots of degree " + std::to_string(degree), "roots",
                  "choose bernstein or intervals");
  }
};

/// Inverse of the Bernstein polynomials' values at equal steps, row by row.
std::vector<double> bernsteinFromValues(int n) {
  const auto size = static_cast<size_t>(n + 1);
  std::vector<std::vector<double>> rows(size, std::vector<double>(2 * size, 0.0));
  for (size_t i = 0; i < size; ++i) {
    const double t = double(i) / n;
    for (size_t j = 0; j < size; ++j) {
      double choose = 1.0;
      for (size_t k = 0; k < j; ++k) choose *= double(size - 1 - k) / double(k + 1);
      rows[i][j] = choose * std::pow(t, double(j)) * std::pow(1.0 - t, double(size - 1 - j));
    }
    rows[i][size + i] = 1.0;
  }
  for (size_t c = 0; c < size; ++c) {
    size_t pivot = c;
    for (size_t r = c; r < size; ++r)
      if (std::abs(rows[r][c]) > std::abs(rows[pivot][c])) pivot = r;
    std::swap(rows[c], rows[pivot]);
    const double inverse = 1.0 / rows[c][c];
    for (double& value : rows[c]) value *= inverse;
    for (size_t r = 0; r < size; ++r) {
      const double factor = rows[r][c];
      if (r == c || factor == 0.0) continue;
      for (size_t k = 0; k < 2 * size; ++k) rows[r][k] -= factor * rows[c][k];
    }
  }
  std::vector<double> out;
  for (size_t i = 0; i < size; ++i)
    for (size_t j = 0; j < size; ++j) out.push_back(rows[i][size + j]);
  return out;
}

class AlgebraicRays : public Technique {
 public:
  using Settings = AlgebraicSettings;
  explicit AlgebraicRays(const Settings& settings) : settings_(settings) {}
  ~AlgebraicRays() override {
    if (vertexArray_) glDeleteVertexArrays(1, &vertexArray_);
  }

  void prepare(frame::Frame& frame) override {
    gl::ShaderDefines defines = {{"DEGREE", std::to_string(surfaces::degreeOf(settings_.surface))}};
    defineEnum(defines, "SURFACE", settings_.surface);
    defineEnum(defines, "ROOTS", settings_.roots);
    if (settings_.precision == Precision::Double) defines["DOUBLE"] = "1";
    const std::string folder = "renderer/techniques/ray_casting/";
    const std::vector<std::string> shaders = {folder + "exact/seen.vert.glsl",
                                              folder + "algebraic/algebraic.frag.glsl"};
    program_ = &frame.context().programs().get(shaders, defines);
    defines["COUNTING"] = "1";
    countingProgram_ = &frame.context().programs().get(shaders, defines);
    const std::vector<double> matrix = bernsteinFromValues(surfaces::degreeOf(settings_.surface));
    const std::vector<float> rounded(matrix.begin(), matrix.end());
    for (const gl::Program* program : {program_, countingProgram_}) {
      const GLint location = glGetUniformLocation(program->id(), "toBernstein");
      const auto count = static_cast<GLsizei>(matrix.size());
      if (settings_.precision == Precision::Double) {
        glProgramUniform1dv(program->id(), location, count, matrix.data());
      } else {
        glProgramUniform1fv(program->id(), location, count, rounded.data());
      }
    }
    picture_.emplace(frame, settings_.shading, "ray_casting");
    glCreateVertexArrays(1, &vertexArray_);
  }

  void render(frame::Frame& frame) override {
    picture_->render(frame, [&] { draw(frame, *program_); });
  }

  const gl::Texture& product() const override { return picture_->texture(); }

  std::vector<Counter> count(frame::Frame& frame) override {
    const glm::ivec2 size = frame.sizePx();
    const gl::Texture ids(gl::Format::R32UI, size), normals(gl::Format::RGBA32F, size),
        depth(gl::Format::Depth32F, size), steps(gl::Format::R32UI, size);
    steps.clearUint(glm::uvec4(0));
    const gl::Framebuffer framebuffer({&ids, &normals}, &depth);
    framebuffer.bind();
    constexpr std::array<GLfloat, 4> kNothing = {};
    glClearBufferfv(GL_COLOR, 1, kNothing.data());
    steps.bindImage(kNewtonStepsImage, gl::Access::Write);
    draw(frame, *countingProgram_);
    glMemoryBarrier(GL_TEXTURE_UPDATE_BARRIER_BIT | GL_FRAMEBUFFER_BARRIER_BIT);
    double sum = 0.0, covered = 0.0, most = 0.0;
    for (const uint32_t taken : steps.readUint()) {
      sum += taken, covered += taken > 0;
      most = std::max(most, double(taken));
    }
    std::vector<Counter> out = {{"root_steps_per_px", sum / std::max(covered, 1.0)},
                                {"root_steps_max", most}};
    if (settings_.compare) std::ranges::copy(errorsOf(frame, normals.read()), std::back_inserter(out));
    return out;
  }

  static std::vector<Quantity> quantities() {
    const Direction lower = Direction::LowerIsBetter;
    return withHitQuantities(
        {{"root_steps_per_px", "Parts of rays looked at, mean of the pixels within the ball", "steps/px",
          lower},
         {"root_steps_max", "Parts of a ray looked at, most", "steps", lower}});
  }

 private:
  /// From the surface's coordinates to the world's.
  glm::dmat4 objectToWorld(frame::Frame& frame) const {
    const scene::Camera& camera = frame.camera();
    const double scale =
        settings_.size * glm::length(camera.target - camera.eye) / surfaces::radiusOf(settings_.surface);
    return glm::translate(glm::dmat4(1.0), camera.target) *
           glm::rotate(glm::dmat4(1.0), glm::radians(settings_.tiltDeg), glm::dvec3(1.0, 0.0, 0.0)) *
           glm::scale(glm::dmat4(1.0), glm::dvec3(scale));
  }

  void draw(frame::Frame& frame, const gl::Program& program) const {
    const glm::dmat4 objectToAnchor =
        glm::translate(glm::dmat4(1.0), -frame.gpuScene().anchor()) * objectToWorld(frame);
    const glm::dmat4 cameraToObject = glm::inverse(frame.anchorToCamera() * objectToAnchor);
    program.use();
    program.set("cameraToObject", glm::mat4(cameraToObject));
    program.set("objectToAnchor", glm::mat4(objectToAnchor));
    program.set("sizePx", frame.sizePx());
    program.set("rayScale", glm::vec2(frame.tanHalfFov() * frame.aspect(), frame.tanHalfFov()));
    program.set("nearest", static_cast<float>(frame::nearPlane(frame)));
    program.set("ballRadius", static_cast<float>(surfaces::radiusOf(settings_.surface)));
    program.set("mostSteps", settings_.mostSteps);
    program.set("material", frame.scene().parts.empty() ? 0U : frame.scene().parts.back().material);
    glBindVertexArray(vertexArray_);
    glDrawArrays(GL_TRIANGLES, 0, 3);
  }

  std::vector<Counter> errorsOf(frame::Frame& frame, const Image& seen) const {
    const surfaces::SurfaceView view = viewOf(frame);
    const glm::ivec2 size = frame.sizePx();
    const glm::dmat4 toObject = glm::inverse(objectToWorld(frame));
    ExactView exact;
    exact.sizePx = size;
    exact.pixels.resize(seen.pixels());
    forAllPixels(exact.pixels.size(), [&](size_t, size_t i) {
      const auto number = static_cast<int>(i);
      const ViewRay ray = viewRay(view, {number % size.x, number / size.x}, size);
      exact.pixels[i] = exactPixel(ray, toObject);
    });
    return hitCounters(compareHits(exact, view, seenDistances(seen)));
  }

  ExactPixel exactPixel(const ViewRay& ray, const glm::dmat4& toObject) const {
    ExactPixel out;
    const glm::dvec3 origin(toObject * glm::dvec4(ray.ray.origin, 1.0)),
        along(toObject * glm::dvec4(ray.ray.direction, 0.0));
    const double perUnit = glm::length(along), radius = surfaces::radiusOf(settings_.surface);
    const surfaces::Ray local{origin, along / perUnit};
    const double middle = -glm::dot(local.origin, local.direction);
    const glm::dvec3 closest = local.origin + middle * local.direction;
    const double half = radius * radius - glm::dot(closest, closest);
    if (half <= 0.0) return out;
    const double start = std::max(middle - std::sqrt(half), 0.0), end = middle + std::sqrt(half);
    if (end <= start) return out;
    const std::optional<double> root = surfaces::firstRoot(settings_.surface, local, start, end);
    if (!root) return out;
    out.hit = true;
    out.distance = ray.distanceAt(*root / perUnit);
    const glm::dvec3 at = local.origin + *root * local.direction;
    glm::dvec3 gradient;
    for (int axis = 0; axis < 3; ++axis) {
      glm::dvec3 step(0.0);
      step[axis] = 1e-5;
      gradient[axis] =
          surfaces::valueOf(settings_.surface, at + step) - surfaces::valueOf(settings_.surface, at - step);
    }
    const double length = glm::length(gradient);
    const double cosine = length > 0.0 ? std::abs(glm::dot(gradient, local.direction)) / length : 1.0;
    out.slope = std::sqrt(std::max(0.0, 1.0 - cosine * cosine)) / std::max(cosine, 1e-9);
    return out;
  }

  Settings settings_;
  std::optional<SurfacePicture> picture_;
  const gl::Program *program_ = nullptr, *countingProgram_ = nullptr;
  uint32_t vertexArray_ = 0;
};

const RegisteredTechnique<AlgebraicRays> kAlgebraicRaysRegistered{
    {.name = "ray_casting/algebraic",
     .version = 1,
     .summary = "An algebraic surface of degree 2 to 10 around the camera's target, by roots along view rays",
     .source = "Schwarz 2009, section 6.4.1 (SC-27 to SC-29)",
     .product = ProductKind::Colour,
     .counters = AlgebraicRays::quantities()}};

}  // namespace
}  // namespace limen::techniques
