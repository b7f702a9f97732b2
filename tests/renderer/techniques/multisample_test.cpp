// SPDX-License-Identifier: BSD-3-Clause
// Visibility for one sample a pixel: what samples see against rays, the resolve against a twin on the CPU and
// known edges.
#include <epoxy/gl.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "experiments/base/error.h"
#include "renderer/techniques/soft_shadows/multisample/multisample_bindings.h"
#include "renderer/techniques/soft_shadows/multisample/pixel_samples.h"
#include "tests/renderer/frame/brute_force.h"
#include "tests/renderer/techniques/technique_fixture.h"

namespace limen::techniques {
namespace {

constexpr int kSamples = 4;  // what every driver has

/// Depths of all samples and of the chosen ones, and the visibility of these: what the resolve works on.
struct MultisampleView {
  glm::ivec2 sizePx;
  std::vector<std::array<float, kSamples>> samples;
  Image depths, visibility;
  explicit MultisampleView(glm::ivec2 size)
      : sizePx(size),
        samples(static_cast<size_t>(size.x * size.y)),
        depths(size.x, size.y, 1),
        visibility(size.x, size.y, 1) {}
};

struct ResolveSetting {
  int neighbours = 4;
  float tolerance = 0.01F;
  bool interpolate = true;
};

class MultisampleResolve : public TechniqueTest {
 protected:
  static Image resolve(const MultisampleView& view, const ResolveSetting& setting) {
    const gl::Texture sampleDepths(gl::Format::R32F, view.sizePx, 1, kSamples),
        depths(gl::Format::R32F, view.sizePx), visibility(gl::Format::R32F, view.sizePx),
        out(gl::Format::R32F, view.sizePx);
    std::vector<float> layer(view.samples.size());
    for (int k = 0; k < kSamples; ++k) {
      for (size_t i = 0; i < layer.size(); ++i) layer[i] = view.samples[i][static_cast<size_t>(k)];
      glTextureSubImage3D(sampleDepths.id(), 0, 0, 0, k, view.sizePx.x, view.sizePx.y, 1, GL_RED, GL_FLOAT,
                          layer.data());
    }
    depths.write(view.depths);
    visibility.write(view.visibility);
    const gl::Program& program =
        context().programs().compute("renderer/techniques/soft_shadows/multisample/resolve.comp.glsl");
    program.set("sizePx", view.sizePx);
    program.set("samples", kSamples);
    program.set("neighbours", setting.neighbours);
    program.set("tolerance", setting.tolerance);
    program.set("interpolate", setting.interpolate ? 1 : 0);
    sampleDepths.bindTexture(kSampleResolveSampleDepthsUnit);
    depths.bindTexture(kSampleResolveDepthsUnit);
    visibility.bindTexture(kSampleResolveVisibilityUnit);
    out.bindImage(kSampleResolveVisibilityImage, gl::Access::Write);
    program.dispatch(view.sizePx);
    return out.read();
  }

  /// The rule of Schwarz 2009, section 4.6, in words of its own: candidates in a list, sorted by how close
  /// they are.
  static double expected(const MultisampleView& view, const ResolveSetting& setting, int x, int y) {
    const auto at = [&](int u, int v) { return static_cast<size_t>(v * view.sizePx.x + u); };
    double sum = 0.0;
    for (const float z : view.samples[at(x, y)]) {
      if (!(z > 0.0F)) {
        sum += 1.0;
        continue;
      }
      struct Candidate {
        float apart;
        float visibility;
      };
      std::vector<Candidate> candidates;
      const auto add = [&](int u, int v) {
        if (u < 0 || v < 0 || u >= view.sizePx.x || v >= view.sizePx.y) return;
        const float depth = view.depths.data[at(u, v)];
        if (depth > 0.0F) candidates.push_back({std::abs(z - depth), view.visibility.data[at(u, v)]});
      };
      add(x, y);
      const bool own = !candidates.empty();
      if (own && (!setting.interpolate || candidates[0].apart <= setting.tolerance * z)) {
        sum += candidates[0].visibility;
        continue;
      }
      if (setting.interpolate) {
        add(x - 1, y), add(x + 1, y), add(x, y - 1), add(x, y + 1);
        if (setting.neighbours == 8)
          add(x - 1, y - 1), add(x + 1, y - 1), add(x - 1, y + 1), add(x + 1, y + 1);
      }
      const auto best =
          std::min_element(candidates.begin(), candidates.end(),
                           [](const Candidate& a, const Candidate& b) { return a.apart < b.apart; });
      sum += best == candidates.end() ? 1.0 : best->visibility;
    }
    return sum / kSamples;
  }
};

TEST_F(MultisampleResolve, IsTheRuleOnRandomDepthsAndVisibilities) {
  std::mt19937 engine(5);
  std::uniform_real_distribution<float> uniform(0.0F, 1.0F);
  MultisampleView view({33, 18});
  for (size_t i = 0; i < view.samples.size(); ++i) {
    // Few depths, so that samples find partners; some surfaces turn away from the light, some samples see
    // none.
    const auto depth = [&] {
      const float z = 1.0F + std::floor(4.0F * uniform(engine)) + 0.02F * uniform(engine),
                  kind = uniform(engine);
      return kind < 0.1F ? 0.0F : kind < 0.2F ? -z : z;
    };
    for (float& sample : view.samples[i]) sample = depth();
    view.depths.data[i] = view.samples[i][0];
    view.visibility.data[i] = uniform(engine);
  }
  for (const int neighbours : {4, 8})
    for (const bool interpolate : {true, false})
      for (const float tolerance : {0.0F, 0.005F, 0.05F}) {
        const ResolveSetting setting{neighbours, tolerance, interpolate};
        const Image out = resolve(view, setting);
        for (int y = 0; y < view.sizePx.y; ++y)
          for (int x = 0; x < view.sizePx.x; ++x)
            // Four values added in float, each at most 1.
            ASSERT_NEAR(out.data[static_cast<size_t>(y * view.sizePx.x + x)], expected(view, setting, x, y),
                        4.0 * 0x1p-24)
                << neighbours << interpolate << tolerance << " " << x << " " << y;
      }
}

/// A dark near surface left of a straight edge, a lit far one right of it. Every pixel has a neighbour wholly
/// on either surface, so that the mean is the covered share itself; without interpolation it is 0 or 1.
TEST_F(MultisampleResolve, GivesAnEdgeTheShareOfSamplesOnEitherSide) {
  constexpr std::array<glm::vec2, kSamples> kPlaces = {glm::vec2(0.375F, 0.125F), glm::vec2(0.875F, 0.375F),
                                                       glm::vec2(0.125F, 0.625F), glm::vec2(0.625F, 0.875F)};
  MultisampleView view({24, 30});
  std::vector<double> share(view.samples.size());
  const auto isNear = [](glm::vec2 place) { return place.x + 0.3F * place.y < 13.2F; };
  for (int y = 0; y < view.sizePx.y; ++y)
    for (int x = 0; x < view.sizePx.x; ++x) {
      const auto i = static_cast<size_t>(y * view.sizePx.x + x);
      int lit = 0;
      for (int k = 0; k < kSamples; ++k) {
        const bool near = isNear(glm::vec2(x, y) + kPlaces[static_cast<size_t>(k)]);
        view.samples[i][static_cast<size_t>(k)] = near ? 2.0F : 5.0F;
        lit += near ? 0 : 1;
      }
      share[i] = lit / double(kSamples);
      view.depths.data[i] = view.samples[i][0];
      view.visibility.data[i] = view.depths.data[i] < 3.0F ? 0.0F : 1.0F;
    }
  const Image interpolated = resolve(view, {}), centre = resolve(view, {4, 0.01F, false});
  int edges = 0;
  for (size_t i = 0; i < share.size(); ++i) {
    EXPECT_EQ(interpolated.data[i], share[i]);
    EXPECT_EQ(centre.data[i], view.visibility.data[i]);
    edges += share[i] > 0.0 && share[i] < 1.0;
  }
  EXPECT_GT(edges, 10);
}

TEST_F(MultisampleResolve, LeavesABackgroundLit) {
  MultisampleView view({9, 7});
  for (float& value : view.visibility.data) value = 0.25F;
  for (const float value : resolve(view, {}).data) EXPECT_EQ(value, 1.0F);
  // A lone sample without any surface beside it: nothing is known, and nothing is shadowed.
  view.samples[30][2] = 3.0F;
  for (const float value : resolve(view, {}).data) EXPECT_EQ(value, 1.0F);
}

class MultisampleShadows : public TechniqueTest {};

/// Triangles that all samples of a frame see, and their places in the picture: sample k of pixel p at k times
/// the number of pixels plus p.
struct SamplesSeen {
  std::vector<uint32_t> ids;
  std::vector<glm::dvec2> places;
};

SamplesSeen samplesSeen(frame::Frame& frame, const PixelSamples& samples) {
  const glm::ivec2 sizePx = frame.sizePx(),
                   tallPx(sizePx.x, sizePx.y * static_cast<int>(samples.places().size()));
  const gl::Texture spread(gl::Format::R32UI, tallPx), places(gl::Format::RG32F, tallPx);
  const gl::Program& program = frame.context().programs().compute(
      "renderer/techniques/soft_shadows/multisample/spread.comp.glsl", samples.defines());
  program.set("sizePx", sizePx);
  for (size_t k = 0; k < samples.places().size(); ++k)
    program.set(("samplePlaces[" + std::to_string(k) + "]").c_str(), samples.places()[k]);
  // The second frame has the first one's leftovers to clear.
  for (int i = 0; i < 2; ++i) {
    frame.begin();
    samples.draw(frame, "samples");
    samples.bindForSampleIds(frame);
    spread.bindImage(kSamplePointIdsImage, gl::Access::Write);
    places.bindImage(kSamplePlacesImage, gl::Access::Write);
    program.dispatch(sizePx);
    glMemoryBarrier(GL_TEXTURE_UPDATE_BARRIER_BIT);
    frame.end();
  }
  SamplesSeen out{spread.readUint(), {}};
  const Image written = places.read();
  for (size_t i = 0; i < out.ids.size(); ++i)
    out.places.emplace_back(written.data[2 * i], written.data[2 * i + 1]);
  return out;
}

/// Triangle behind a place of a frame's picture, in double precision.
class SeenByRays {
 public:
  SeenByRays(const frame::Frame& frame, const scene::Scene& scene, const frame::GpuScene& gpuScene)
      : frame_(frame), truth_(scene, gpuScene.anchor()), toWorld_(glm::inverse(frame.anchorToCamera())) {}
  uint32_t at(glm::dvec2 place) const {
    const glm::dvec2 ndc =
        glm::dvec2(2.0, -2.0) * place / glm::dvec2(frame_.sizePx()) + glm::dvec2(-1.0, 1.0);
    const glm::dvec3 ray(ndc.x * frame_.tanHalfFov() * frame_.aspect(), ndc.y * frame_.tanHalfFov(), -1.0);
    return truth_.trace(glm::dvec3(toWorld_[3]), glm::dvec3(toWorld_ * glm::dvec4(ray, 0.0)), 0.0).triangle;
  }
  /// Whether a ray within this share of the rasterisers' snapping distance sees the triangle, which may be
  /// thinner than that distance.
  bool isNear(uint32_t triangle, glm::dvec2 place, double share = 1.0) const {
    if (at(place) == triangle) return true;
    for (const double radius : {1.0, 0.5, 0.25, 0.75})
      for (const glm::dvec2 offset : frame::snappingOffsets())
        if (at(place + radius * share * offset) == triangle) return true;
    return false;
  }

 private:
  const frame::Frame& frame_;
  frame::BruteForce truth_;
  glm::dmat4 toWorld_;
};

TEST_F(MultisampleShadows, SamplesSeeWhatRaysThroughTheirPlacesSee) {
  for (const char* name : {"two_boxes", "street_light", "sphere_grid"})
    for (const frame::Raster raster : {frame::Raster::Hardware, frame::Raster::Compute}) {
      // Drivers snap vertices to 1/256 of a pixel, which turns triangles of twigs that are thinner than this.
      if (raster == frame::Raster::Hardware && name == std::string("street_light")) continue;
      const scene::Scene scene = makeScene(name);
      const frame::GpuScene gpuScene(scene);
      const glm::ivec2 sizePx(33, 26);
      frame::Frame frame(context(), scene, gpuScene, sizePx);
      const PixelSamples samples(frame, kSamples, raster, nullptr);
      ASSERT_EQ(samples.places().size(), size_t{kSamples});
      const SamplesSeen seen = samplesSeen(frame, samples);
      const SeenByRays rays(frame, scene, gpuScene);
      // In compute only rounding decides: a thousandth of a pixel is far more.
      const double share = raster == frame::Raster::Hardware ? 1.0 : 0.128;
      size_t edges = 0, wrong = 0;
      for (size_t i = 0; i < seen.ids.size(); ++i) {
        if (rays.at(seen.places[i]) == seen.ids[i]) continue;
        ++edges;
        wrong += !rays.isNear(seen.ids[i], seen.places[i], share);
      }
      EXPECT_EQ(wrong, 0U) << name << int(raster);
      // Ties happen beside edges alone.
      EXPECT_LT(edges, seen.ids.size() / 50) << name << int(raster);
    }
}

TEST_F(MultisampleShadows, BothRasterisersAgreeOnSamplesExceptBesideEdges) {
  for (const char* name : {"two_boxes", "sphere_grid", "columns_hall", "foliage"}) {
    const scene::Scene scene = makeScene(name);
    const frame::GpuScene gpuScene(scene);
    const glm::ivec2 sizePx(61, 43);
    frame::Frame frame(context(), scene, gpuScene, sizePx);
    const PixelSamples driver(frame, kSamples, frame::Raster::Hardware, nullptr);
    const frame::SampleRaster compute(frame, driver.places());
    const SamplesSeen expected = samplesSeen(frame, driver);
    frame.begin();
    compute.draw(frame, "samples");
    const std::vector<uint32_t> ids = compute.ids().read<uint32_t>(), marks = compute.marks().readUint(),
                                centres = frame.get<frame::TriangleIds>().texture().readUint();
    frame.end();
    const SeenByRays rays(frame, scene, gpuScene);
    const size_t pixels = marks.size();
    size_t differing = 0, wrong = 0;
    for (size_t p = 0; p < pixels; ++p)
      for (size_t k = 0; k < kSamples; ++k) {
        const uint32_t id = marks[p] ? ids[p * kSamples + k] : centres[p];
        const size_t i = k * pixels + p;
        if (id == expected.ids[i]) continue;
        ++differing;
        wrong += !(rays.isNear(id, expected.places[i]) && rays.isNear(expected.ids[i], expected.places[i]));
      }
    EXPECT_EQ(wrong, 0U) << name;
    EXPECT_LT(differing, pixels * kSamples / 50) << name;
  }
}

/// A tilted plane of many triangles, each about a pixel, with a card in front of it.
scene::Scene tessellatedPlane(bool card) {
  scene::Scene scene;
  constexpr int kCells = 40;
  const auto corner = [](int x, int y) {
    const double u = x / double(kCells) - 0.5, v = y / double(kCells) - 0.5;
    return glm::dvec3(12.0 * u, 12.0 * v, 2.0 * u - 3.0 * v - 2.0);
  };
  const auto add = [&](glm::dvec3 a, glm::dvec3 b, glm::dvec3 c) {
    const auto first = static_cast<uint32_t>(scene.mesh.positions.size());
    scene.mesh.positions.insert(scene.mesh.positions.end(), {a, b, c});
    scene.mesh.triangles.emplace_back(first, first + 1, first + 2);
  };
  for (int y = 0; y < kCells; ++y)
    for (int x = 0; x < kCells; ++x) {
      add(corner(x, y), corner(x + 1, y), corner(x + 1, y + 1));
      add(corner(x, y), corner(x + 1, y + 1), corner(x, y + 1));
    }
  if (card) {
    add({-0.9, -0.7, 1.0}, {0.8, -0.6, 1.0}, {0.9, 0.7, 1.0});
    add({-0.9, -0.7, 1.0}, {0.9, 0.7, 1.0}, {-0.8, 0.6, 1.0});
  }
  scene.parts.push_back({"all", 0, static_cast<uint32_t>(scene.mesh.triangles.size())});
  scene.materials.emplace_back();
  scene::AreaLight light;
  light.centre = {0.5, 0.3, 9.0};
  light.axisY = {0.0, -1.0, 0.0};  // looks along -z
  light.size = {1.0, 1.0};
  scene.lights.push_back(light);
  scene::Camera camera;
  camera.eye = {0.0, 0.0, 5.0};
  camera.target = {0.0, 0.0, 0.0};
  scene.camera.keys = {{0.0, camera}};
  return scene;
}

TEST_F(MultisampleShadows, OneSurfaceOfManyTrianglesTakesOnePointPerPixel) {
  const glm::ivec2 sizePx(48, 36);
  for (const char* raster : {"hardware", "compute"}) {
    const Rendered out =
        render(tessellatedPlane(false), "soft_shadows/multisample",
               withMaps("soft_shadows/multisample", 128, {{"raster", std::string(raster)}}), sizePx, true);
    EXPECT_EQ(out.counter("complex_share"), 0.0) << raster;
    EXPECT_EQ(out.counter("inner_evaluations_per_px"), 1.0) << raster;
  }
}

/// The card's outline crosses some pixels, and only these have a second point. The card is lit, and so is the
/// plane beside it as the camera sees it, except where it is shadowed by the card.
TEST_F(MultisampleShadows, TwoSurfacesInAPixelTakeTwoPoints) {
  const glm::ivec2 sizePx(48, 36);
  const scene::Scene scene = tessellatedPlane(true);
  const auto firstOfCard = static_cast<uint32_t>(scene.mesh.triangles.size() - 2);
  const frame::GpuScene gpuScene(scene);
  frame::Frame frame(context(), scene, gpuScene, sizePx);
  for (const frame::Raster raster : {frame::Raster::Hardware, frame::Raster::Compute}) {
    const PixelSamples samples(frame, kSamples, raster, nullptr);
    const SamplesSeen seen = samplesSeen(frame, samples);
    frame.begin();
    const std::vector<uint32_t> centres = frame.get<frame::TriangleIds>().texture().readUint();
    frame.end();
    const size_t pixels = centres.size();
    double points = 0.0, complex = 0.0;
    for (size_t p = 0; p < pixels; ++p) {
      int onCard = 0;
      for (size_t k = 0; k < kSamples; ++k) onCard += seen.ids[k * pixels + p] >= firstOfCard;
      const bool centreOnCard = centres[p] >= firstOfCard;
      complex += onCard > 0 && onCard < kSamples;
      points += 1.0 + ((centreOnCard ? kSamples - onCard : onCard) > 0);
    }
    const char* name = raster == frame::Raster::Hardware ? "hardware" : "compute";
    const Rendered out =
        render(scene, "soft_shadows/multisample",
               withMaps("soft_shadows/multisample", 128, {{"raster", std::string(name)}}), sizePx, true);
    EXPECT_GT(complex, 20.0);
    EXPECT_DOUBLE_EQ(out.counter("complex_share"), complex / double(pixels)) << name;
    EXPECT_DOUBLE_EQ(out.counter("inner_evaluations_per_px"), points / double(pixels)) << name;
    EXPECT_EQ(out.counter("orphan_share"), 0.0);
  }
}

TEST_F(MultisampleShadows, OneSampleIsTheInnerTechniqueBitForBit) {
  const scene::Scene scene = makeScene("two_boxes");
  const glm::ivec2 sizePx(41, 30);
  for (const char* inner : {"backprojection", "bitmask"}) {
    const std::string plain = std::string("soft_shadows/") + inner;
    const Rendered full = render(scene, plain, withMaps(plain, 256), sizePx);
    for (const char* method : {"surfaces", "interpolate", "centre", "per_sample"}) {
      const Given given =
          withMaps("soft_shadows/multisample", 256,
                   {{"inner", std::string(inner)}, {"samples", int64_t{1}}, {"method", std::string(method)}});
      const Rendered multisample = render(scene, "soft_shadows/multisample", given, sizePx, true);
      EXPECT_EQ(multisample.product.data, full.product.data) << method << " " << inner;
    }
    const Given given =
        withMaps("soft_shadows/supersampled", 256, {{"inner", std::string(inner)}, {"samples", int64_t{1}}});
    EXPECT_EQ(render(scene, "soft_shadows/supersampled", given, sizePx).product.data, full.product.data)
        << inner;
  }
}

TEST_F(MultisampleShadows, SupersamplingIsTheMeanOfALargerPicture) {
  const scene::Scene scene = makeScene("pole");
  const Given map = withMaps("soft_shadows/backprojection", 256);
  const Given given = withMaps("soft_shadows/supersampled", 256, {{"samples", int64_t{3}}});
  const Image mean = render(scene, "soft_shadows/supersampled", given, {20, 15}).product;
  const Image large = render(scene, "soft_shadows/backprojection", map, {60, 45}).product;
  for (int y = 0; y < 15; ++y)
    for (int x = 0; x < 20; ++x) {
      double sum = 0.0;
      for (int v = 0; v < 3; ++v)
        for (int u = 0; u < 3; ++u) sum += large.data[static_cast<size_t>((3 * y + v) * 60 + 3 * x + u)];
      EXPECT_NEAR(mean.data[static_cast<size_t>(y * 20 + x)], sum / 9.0, 9.0 * 0x1p-24);
    }
}

/// Against a visibility for every sample. Squares, since what matters is the few pixels at edges, not the
/// many on which one place differs a little from four.
TEST_F(MultisampleShadows, InterpolationErrsLessThanTheCentreOnTwigsAndPoles) {
  const scene::Scene scene = makeScene("street_light", {{"branching", int64_t{3}}});
  const glm::ivec2 sizePx(128, 96);
  const auto made = [&](const Given& given, bool counting = false) {
    return render(scene, "soft_shadows/multisample", withMaps("soft_shadows/multisample", 512, given), sizePx,
                  counting);
  };
  const Rendered all = made({{"method", std::string("per_sample")}}, true);
  const Rendered interpolated = made({{"method", std::string("interpolate")}}, true),
                 surfaces = made({}, true), centre = made({{"method", std::string("centre")}}, true);
  double interpolationError = 0.0, centreError = 0.0, surfacesError = 0.0;
  for (size_t i = 0; i < all.product.data.size(); ++i) {
    const double reference = all.product.data[i], a = interpolated.product.data[i] - reference,
                 b = centre.product.data[i] - reference, c = surfaces.product.data[i] - reference;
    interpolationError += a * a, centreError += b * b, surfacesError += c * c;
  }
  EXPECT_LT(interpolationError, centreError);
  // Twigs that no neighbour's first sample is on have points of their own.
  EXPECT_LT(surfacesError, 0.5 * interpolationError);
  EXPECT_LT(surfaces.counter("inner_evaluations_per_px"),
            1.3 * interpolated.counter("inner_evaluations_per_px"));
  EXPECT_GT(interpolated.counter("complex_share"), 0.0);
  EXPECT_LT(interpolated.counter("complex_share"), 0.5);
  // Both see the same pixels; only one of the two looks for better.
  EXPECT_EQ(interpolated.counter("complex_share"), centre.counter("complex_share"));
  EXPECT_LT(interpolated.counter("orphan_share"), centre.counter("orphan_share"));
  EXPECT_EQ(centre.counter("borrowed_share"), 0.0);
  // One point a pixel against four.
  EXPECT_LE(interpolated.counter("inner_evaluations_per_px"), 1.0);
  EXPECT_GT(all.counter("inner_evaluations_per_px"), 3.0 * interpolated.counter("inner_evaluations_per_px"));
}

TEST_F(MultisampleShadows, RendersOnePixelAndEveryRepresentative) {
  const scene::Scene scene = makeScene("street_light", {{"branching", int64_t{2}}});
  for (const char* representative : {"first", "nearest", "farthest", "median"})
    for (const glm::ivec2 sizePx : {glm::ivec2(1, 1), glm::ivec2(13, 7)}) {
      const Rendered out = render(scene, "soft_shadows/multisample",
                                  withMaps("soft_shadows/multisample", 128,
                                           {{"method", std::string("interpolate")},
                                            {"method.representative", std::string(representative)},
                                            {"method.depth_at", std::string("sample")},
                                            {"method.neighbours", int64_t{8}}}),
                                  sizePx);
      for (const float value : out.product.data)
        EXPECT_TRUE(value >= 0.0F && value <= 1.0F) << representative;
    }
}

TEST_F(MultisampleShadows, WhatMeansNothingBesideTheMethodCannotBeWritten) {
  const auto accepted = [](const Given& given) { return !refusal("soft_shadows/multisample", given); };
  EXPECT_TRUE(accepted({}));
  EXPECT_TRUE(
      accepted({{"method", std::string("centre")}, {"method.representative", std::string("median")}}));
  EXPECT_FALSE(accepted({{"method", std::string("centre")}, {"method.tolerance", 0.05}}));
  EXPECT_FALSE(
      accepted({{"method", std::string("per_sample")}, {"method.representative", std::string("median")}}));
  EXPECT_FALSE(accepted({{"inner.samples", int64_t{64}}}));
  EXPECT_FALSE(accepted({{"inner", std::string("ray_traced")}, {"inner.budget.limit", int64_t{25}}}));
}

}  // namespace
}  // namespace limen::techniques
