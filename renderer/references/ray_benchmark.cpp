// SPDX-License-Identifier: BSD-3-Clause
// limen-ray-benchmark: rays per second on registered scenes, on the GPU (renderer/ray_tracing) and on the CPU
// (Embree, packets and single rays, all cores), and time and memory of the trees, as CSV on standard output.
// Shadow rays go from what the scene's camera sees to points on its light, as soft_shadows/ray_traced sends
// them; hemisphere rays leave the same points in directions distributed by the cosine.
#include <epoxy/gl.h>
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <exception>
#include <numbers>
#include <string>
#include <vector>

#include "experiments/base/error.h"
#include "experiments/base/program.h"
#include "renderer/ray_tracing/ray_batch.h"
#include "renderer/references/compute_tracer.h"
#include "renderer/references/embree_tracer.h"
#include "renderer/references/parallel.h"
#include "renderer/references/square_number.h"

namespace {

using namespace limen;
using namespace limen::references;
using HostClock = std::chrono::steady_clock;

struct Options {
  std::vector<std::string> scenes = {"bunny", "columns_hall", "foliage"};
  int width = 1024, height = 768, samples = 256;
  double seconds = 1.0;  ///< for each figure, at least
  bool cpu = true;
};

double since(HostClock::time_point start) {
  return std::chrono::duration<double>(HostClock::now() - start).count();
}

void printRow(const std::string& scene, const std::string& what, double value, const char* unit) {
  fmt::print("{},{},{:.6g},{}\n", scene, what, value, unit);
  std::fflush(stdout);
}

/// Calls work(), which returns the rays it traced, until `seconds` have passed; returns rays per second. A
/// first call, up to half a second of them, is not counted: an idle GPU takes a third to raise its clock.
template <class Work>
double raysPerSecond(double seconds, const Work& work) {
  const auto warmUp = HostClock::now();
  do work();
  while (since(warmUp) < std::min(0.5, seconds));
  double rays = 0.0;
  const auto start = HostClock::now();
  do rays += work();
  while (since(start) < seconds);
  return rays / since(start);
}

double total(const std::vector<ShadowCounts>& counts) {
  double rays = 0.0;
  for (const ShadowCounts& one : counts) rays += one.rays;
  return rays;
}

glm::dvec3 hemisphere(const ReceiverPoint& point, uint64_t index) {
  const glm::dvec2 random = uniform2(17, point.pixel, index);
  const double radius = std::sqrt(random.x), angle = 2.0 * std::numbers::pi * random.y;
  const glm::dvec3 n = point.normal;
  const glm::dvec3 x =
      glm::normalize(glm::cross(n, std::abs(n.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0)));
  return x * (radius * std::cos(angle)) + glm::cross(n, x) * (radius * std::sin(angle)) +
         n * std::sqrt(1.0 - random.x);
}

class SceneBenchmark {
 public:
  SceneBenchmark(gl::Context& context, const Options& options, const std::string& name)
      : context_(context),
        options_(options),
        name_(name),
        scene_(build(name)),
        gpuScene_(scene_),
        frame_(context, scene_, gpuScene_, {options.width, options.height}),
        triangles_(scene_, gpuScene_.anchor()),
        map_(scene_.lights.at(0)),
        samples_{scene_.lights.at(0), map_, options.samples, gridSide(options.samples), 1} {
    frame_.begin();
    points_ = readReceiverPoints(frame_, triangles_);
    frame_.end();
    if (points_.empty()) throw Error("the camera sees nothing", name, "name another scene");
  }

  void run() {
    row("triangles", double(triangles_.count()), "");
    row("receivers", double(points_.size()), "");
    gpu();
    if (options_.cpu) cpu();
  }

 private:
  static scene::Scene build(const std::string& name) {
    const scene::SceneInfo& info = scene::SceneRegistry::instance().get(name);
    return scene::buildScene(name, ParameterValues(info.allParameters(), {}));
  }

  void row(const std::string& what, double value, const char* unit) const {
    printRow(name_, what, value, unit);
  }

  void gpu() {
    const ray_tracing::RayScene& tree = gpuScene_.rays(context_);
    ComputeTracer tracer(context_, tree, triangles_);
    row("tree build", 1e3 * tree.buildS(), "ms");
    row("tree size", double(tree.bytes()), "byte");
    row("tree nodes", tree.nodeCount(), "");
    row("tree levels", tree.levels(), "");
    const std::vector<ReceiverPoint> points = some(context_.device().software ? 4000 : points_.size());
    row("shadow rays on the GPU",
        1e-6 * raysPerSecond(options_.seconds,
                             [&] { return total(tracer.trace(points, samples_, gpuScene_.anchor())); }),
        "M/s");
    const std::vector<ray_tracing::BatchRay> rays =
        hemisphereRays(context_.device().software ? 1 << 16 : 1 << 22);
    for (const auto& [wanted, what] :
         {std::pair(ray_tracing::Wanted::AnyHit, "hemisphere any hit on the GPU"),
          {ray_tracing::Wanted::ClosestHit, "hemisphere closest hit on the GPU"}}) {
      const ray_tracing::RayBatch batch(context_, tree, rays, wanted);
      row(what,
          1e-6 * raysPerSecond(options_.seconds,
                               [&] {
                                 batch.trace();
                                 glFinish();
                                 return double(rays.size());
                               }),
          "M/s");
      size_t hits = 0;
      for (const ray_tracing::BatchHit& hit : batch.hits())
        hits += hit.triangle != ray_tracing::kRayNoTriangle;
      row("hemisphere rays that hit", double(hits) / double(rays.size()), "");
    }
  }

  /// Rays that the GPU finds hidden and the CPU does not, or the other way round: ties at edges.
  void compare(ShadowTracer& cpu) {
    const std::vector<ReceiverPoint> points = some(context_.device().software ? 1000 : 20000);
    ComputeTracer gpu(context_, gpuScene_.rays(context_), triangles_);
    const auto one = cpu.trace(points, samples_, gpuScene_.anchor()),
               other = gpu.trace(points, samples_, gpuScene_.anchor());
    double differing = 0.0;
    for (size_t i = 0; i < points.size(); ++i)
      differing += std::abs(double(one[i].seen) - double(other[i].seen));
    row("shadow rays that differ between GPU and CPU", differing / total(one), "");
  }

  void cpu() {
    const auto start = HostClock::now();
    EmbreeTracer tracer(triangles_);
    row("Embree build", 1e3 * since(start), "ms");
    const EmbreeScene& embree = tracer.scene();
    compare(tracer);
    const std::vector<ReceiverPoint> points = some(20000);
    row("shadow rays on the CPU in packets",
        1e-6 * raysPerSecond(options_.seconds,
                             [&] { return total(tracer.trace(points, samples_, gpuScene_.anchor())); }),
        "M/s");
    row("shadow rays on the CPU one by one",
        1e-6 * raysPerSecond(options_.seconds, [&] { return singles(embree, points); }), "M/s");
    row("hemisphere any hit on the CPU in packets",
        1e-6 * raysPerSecond(options_.seconds, [&] { return hemispherePackets(embree, points); }), "M/s");
  }

  double singles(const EmbreeScene& embree, const std::vector<ReceiverPoint>& points) {
    std::atomic<int64_t> rays = 0;
    parallelFor(points.size(), [&](size_t, size_t first, size_t last) {
      int64_t cast = 0;
      for (size_t i = first; i < last; ++i)
        for (int64_t sample = 0; sample < samples_.count; ++sample) {
          const glm::dvec3 to = samples_.point(points[i].pixel, sample) - gpuScene_.anchor();
          if (!(glm::dot(points[i].normal, to - points[i].position) > 0.0)) continue;
          ++cast;
          sink_ = embree.occluded(points[i], to);
        }
      rays += cast;
    });
    return double(rays);
  }

  double hemispherePackets(const EmbreeScene& embree, const std::vector<ReceiverPoint>& points) {
    parallelFor(points.size(), [&](size_t, size_t first, size_t last) {
      std::array<glm::dvec3, EmbreeScene::kPacket> to;
      for (size_t i = first; i < last; ++i) {
        for (size_t ray = 0; ray < to.size(); ++ray)
          to[ray] = points[i].position + gpuScene_.diagonal() * hemisphere(points[i], ray);
        sink_ = embree.countOccluded(points[i], to) > 0;
      }
    });
    return double(points.size() * EmbreeScene::kPacket);
  }

  /// At most `count` of the receivers, evenly chosen.
  std::vector<ReceiverPoint> some(size_t count) const {
    if (points_.size() <= count) return points_;
    std::vector<ReceiverPoint> out;
    for (size_t i = 0; i < count; ++i) out.push_back(points_[i * points_.size() / count]);
    return out;
  }

  std::vector<ray_tracing::BatchRay> hemisphereRays(size_t count) const {
    const double diagonal = gpuScene_.diagonal();
    std::vector<ray_tracing::BatchRay> rays(count);
    parallelFor(count, [&](size_t, size_t first, size_t last) {
      for (size_t i = first; i < last; ++i) {
        const ReceiverPoint& point = points_[i % points_.size()];
        rays[i] = {glm::vec3(point.position + 1e-4 * diagonal * point.normal), 0.0F,
                   glm::vec3(hemisphere(point, i / points_.size())), static_cast<float>(diagonal)};
      }
    });
    return rays;
  }

  gl::Context& context_;
  const Options& options_;
  std::string name_;
  scene::Scene scene_;
  frame::GpuScene gpuScene_;
  frame::Frame frame_;
  Triangles triangles_;
  LightShapeMap map_;
  LightSamples samples_;
  std::vector<ReceiverPoint> points_;
  std::atomic<bool> sink_ = false;  ///< results go here, so that the compiler leaves their making alone
};

int measureAll(const Options& options) {
  try {
    const auto context = gl::createHeadlessContext();
    fmt::print("# {}{}, {} x {} pixels, {} shadow rays a pixel\nscene,what,value,unit\n",
               context->device().line(), context->device().software ? " (a software renderer)" : "",
               options.width, options.height, options.samples);
    for (const std::string& name : options.scenes) SceneBenchmark(*context, options, name).run();
    context->checkDebugMessages();
    return kExitSuccess;
  } catch (const std::exception& error) {
    fmt::print(stderr, "limen-ray-benchmark: {}\n", error.what());
    return kExitFailedRuns;
  }
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Rays per second on the GPU and on the CPU, and cost of their trees, as CSV.",
               "limen-ray-benchmark");
  int exitCode = kExitSuccess;
  Options options;
  app.add_option("--scene", options.scenes, "registered scenes")->capture_default_str();
  app.add_option("--width", options.width, "pixels")->check(CLI::Range(1, 8192))->capture_default_str();
  app.add_option("--height", options.height, "pixels")->check(CLI::Range(1, 8192))->capture_default_str();
  app.add_option("--samples", options.samples, "shadow rays a pixel; a square number")
      ->check(CLI::Range(1, 65536))
      ->capture_default_str();
  app.add_option("--seconds", options.seconds, "to measure each figure for, at least")
      ->check(CLI::Range(0.01, 60.0))
      ->capture_default_str();
  app.add_flag("!--no-cpu", options.cpu, "leave out the CPU");
  app.callback([&] {
    checkSquareNumber(options.samples);
    exitCode = measureAll(options);
  });
  return runProgram(app, argc, argv, exitCode);
}
