// SPDX-License-Identifier: BSD-3-Clause
#include <limits>

#include "renderer/frame/mirror_rays.h"
#include "renderer/frame/shaded.h"
#include "tests/renderer/techniques/reflections/reflection_fixture.h"

namespace limen::techniques {
namespace {

/// Where the camera's picture shows a point: pixels from its top left corner, and the distance along the
/// view.
struct Place {
  glm::dvec2 px;
  double depth;
};

class ScreenSpace : public ReflectionTest {
 protected:
  static constexpr glm::ivec2 kSizePx{160, 120};

  struct View {
    glm::dvec3 eye, right, up, forward;
    double tanHalf;
    glm::ivec2 sizePx;
    View(const scene::Camera& camera, glm::ivec2 size) : eye(camera.eye), sizePx(size) {
      forward = glm::normalize(camera.target - camera.eye);
      right = glm::normalize(glm::cross(forward, camera.up));
      up = glm::cross(right, forward);
      tanHalf = std::tan(glm::radians(0.5 * camera.verticalFovDeg));
    }
    Place place(glm::dvec3 p) const {
      const glm::dvec3 d = p - eye;
      const double depth = glm::dot(d, forward), unit = 0.5 * sizePx.y / (tanHalf * depth);
      return {{0.5 * sizePx.x + unit * glm::dot(d, right), 0.5 * sizePx.y - unit * glm::dot(d, up)}, depth};
    }
    glm::dvec3 through(glm::dvec2 px) const {
      const double unit = 2.0 * tanHalf / sizePx.y;
      return forward + unit * ((px.x - 0.5 * sizePx.x) * right - (px.y - 0.5 * sizePx.y) * up);
    }
    bool shows(glm::dvec2 px, double margin) const {
      return px.x >= margin && px.y >= margin && px.x <= sizePx.x - margin && px.y <= sizePx.y - margin;
    }
  };

  /// A mirroring floor, y = 0, before a wall, z = -2, of panels half a unit wide and high, no two of which
  /// beside each other are alike; the wall is 4 wide and `height` panels high. Ambient light alone.
  static scene::Scene wallBehindFloor(int height) {
    scene::Scene scene;
    scene::Material mirror = mirrorMaterial(1.0F);
    mirror.albedo = glm::vec3(0.0F);
    scene::addPart(scene, scene::card({0.0, 0.0, 0.0}, {2.0, 0.0, 0.0}, {0.0, 0.0, -2.0}), mirror);
    for (int column = 0; column < 8; ++column)
      for (int row = 0; row < height; ++row)
        scene::addPart(
            scene, "panel",
            scene::card({-1.75 + 0.5 * column, 0.25 + 0.5 * row, -2.0}, {0.25, 0.0, 0.0}, {0.0, 0.25, 0.0}),
            panelColour(column, row));
    scene::setStillCamera(scene, {{0.2, 0.8, 3.0}, {0.0, 0.35, 0.0}, {0.0, 1.0, 0.0}, 40.0});
    return scene;
  }
  static glm::vec3 panelColour(int column, int row) {
    return {0.2F + 0.1F * float(column), 0.2F + 0.15F * float(row), (column + row) % 2 ? 0.9F : 0.3F};
  }
  static Given flat(Given more = {}) {
    more["shading.ambient"] = 1.0;
    more["shading.diffuse"] = 0.0;
    more.emplace("fade", 0.0);
    more.emplace("march", std::string("hierarchical"));
    more.emplace("fallback", std::string("none"));
    return more;
  }
};

/// What a floor mirrors of a wall, by hand: the eye's ray is mirrored at y = 0 and meets the wall at a point
/// that the picture shows or not. The march knows where a ray meets the wall to within the pixel in which the
/// ray goes behind it (of both, the ray's place and the pixel's centre are within 0.5 px of each other, and
/// the crossing is in this pixel or the one before): 1.5 px from a panel's border its colour is the panel's,
/// exactly but for the rounding of ambient light times albedo. Steps of four pixels without refinement: 3 px
/// more. 1.5 px from the picture's border the classification is certain, too.
TEST_F(ScreenSpace, AFloorShowsWhatThePictureShowsOfAWall) {
  struct Case {
    const char* name;
    Given given;
    double px;
  };
  const std::string linear = "linear", triangle = "triangle";
  const std::vector<Case> cases = {
      {"hierarchical", {}, 1.5},
      {"pyramid of one level", {{"march.coarsest", int64_t{0}}}, 1.5},
      {"linear", {{"march", linear}, {"march.stride", 1.0}}, 1.5},
      {"linear, 4 px", {{"march", linear}, {"march.stride", 4.0}}, 1.5},
      {"linear, 4 px, not refined",
       {{"march", linear}, {"march.stride", 4.0}, {"march.refinements", int64_t{0}}},
       4.5},
      {"linear, jittered", {{"march", linear}, {"march.stride", 4.0}, {"march.jitter", 1.0}}, 1.5},
      {"triangle", {{"light", triangle}}, 1.5},
      {"back faces", {{"thickness", std::string("back_faces")}, {"thickness.least", 0.02}}, 1.5},
      {"second layer", {{"thickness", std::string("second_layer")}}, 1.5}};
  const scene::Scene scene = wallBehindFloor(4);
  const View view(scene.camera.at(0.0), kSizePx);
  for (const Case& test : cases) {
    const Image found = render(scene, "reflections/screen_space", flat(test.given), kSizePx).product;
    size_t met = 0, left = 0, wrong = 0;
    for (int y = 0; y < kSizePx.y; ++y)
      for (int x = 0; x < kSizePx.x; ++x) {
        const glm::dvec3 ray = view.through({x + 0.5, y + 0.5});
        if (ray.y >= 0.0) continue;
        const glm::dvec3 floor = view.eye - view.eye.y / ray.y * ray;
        if (std::abs(floor.x) >= 2.0 || floor.z <= -2.0 || floor.z >= 2.0) continue;
        const glm::dvec3 away(ray.x, -ray.y, ray.z), at = floor + (-2.0 - floor.z) / away.z * away;
        const glm::dvec2 panel((at.x + 2.0) / 0.5, at.y / 0.5), cell = glm::floor(panel);
        if (std::abs(at.x) >= 2.0 || at.y >= 2.0) continue;  // past the wall
        const Place seen = view.place(at);
        glm::vec3 expected(0.0F);
        if (view.shows(seen.px, test.px)) {
          const double pxPerPanel = 0.5 * 0.5 * kSizePx.y / (view.tanHalf * seen.depth);
          const glm::dvec2 toBorder = glm::min(panel - cell, cell + 1.0 - panel) * pxPerPanel;
          if (std::min(toBorder.x, toBorder.y) < test.px) continue;
          expected = panelColour(int(cell.x), int(cell.y));
          ++met;
        } else if (!view.shows(seen.px, -1.5)) {
          ++left;
        } else {
          continue;
        }
        for (int c = 0; c < 3; ++c)
          if (!(std::abs(found.at(x, y, c) - expected[c]) <= 1e-5F)) {
            ++wrong;
            break;
          }
      }
    EXPECT_GT(met, 500U) << test.name;
    EXPECT_GT(left, 200U) << test.name;
    EXPECT_EQ(wrong, 0U) << test.name;
  }
}

/// One ray through the picture, pixel by pixel, in double precision: where it meets what the pixels show.
class PixelWalk {
 public:
  PixelWalk(const scene::Scene& scene, glm::dvec3 anchor, glm::ivec2 size, const Image& depths,
            const std::vector<uint32_t>& ids, double thickness)
      : scene_(scene), anchor_(anchor), size_(size), depths_(depths), ids_(ids), thickness_(thickness) {
    const scene::Camera camera = scene.camera.at(0.0);
    eye_ = camera.eye - anchor;
    forward_ = glm::normalize(camera.target - camera.eye);
    const glm::dvec3 right = glm::normalize(glm::cross(forward_, camera.up));
    const double scale = 0.5 * size.y / std::tan(glm::radians(0.5 * camera.verticalFovDeg));
    // Places times distance along the view.
    x_ = scale * right + 0.5 * size.x * forward_;
    y_ = -scale * glm::cross(right, forward_) + 0.5 * size.y * forward_;
  }

  enum class End { Met, Free, None };
  End follow(glm::dvec3 from, glm::dvec3 along, glm::ivec2& pixel) const {
    const glm::dvec3 a(glm::dot(x_, from - eye_), glm::dot(y_, from - eye_), glm::dot(forward_, from - eye_)),
        b(glm::dot(x_, along), glm::dot(y_, along), glm::dot(forward_, along));
    pixel = glm::ivec2(glm::floor(glm::dvec2(a) / a.z));
    bool hidden = false;
    for (double t = 0.0;;) {
      double next = std::numeric_limits<double>::infinity();
      glm::ivec2 step(0);
      for (int axis = 0; axis < 2; ++axis)
        for (int side = 0; side < 2; ++side) {
          const double border = pixel[axis] + side;
          // The ray leaves the pixel there if its place grows beyond the upper border, or falls below the
          // lower.
          const double change = b[axis] - border * b.z, at = (border * a.z - a[axis]) / change;
          if ((side == 1 ? change > 0.0 : change < 0.0) && at < next) {
            next = std::max(at, t);
            step = glm::ivec2(0);
            step[axis] = side == 1 ? 1 : -1;
          }
        }
      if (b.z < 0.0 && a.z + next * b.z <= 0.0) return End::None;
      const float seen = depths_.at(pixel.x, pixel.y);
      if (seen > 0.0F) {
        const double z0 = a.z + t * b.z, z1 = a.z + (std::isinf(next) ? 1e30 : next) * b.z;
        if (std::max(z0, z1) > seen) {
          if (std::min(z0, z1) > seen + thickness_)
            hidden = true;
          else if (faces(ids_[size_t(pixel.y) * size_t(size_.x) + size_t(pixel.x)], along))
            return End::Met;
        }
      }
      if (std::isinf(next)) return hidden ? End::None : End::Free;
      pixel += step;
      if (pixel.x < 0 || pixel.y < 0 || pixel.x >= size_.x || pixel.y >= size_.y) return End::None;
      t = next;
    }
  }

 private:
  /// Whether the ray meets the side that the eye sees.
  bool faces(uint32_t id, glm::dvec3 along) const {
    const glm::uvec3 of = scene_.mesh.triangles[id];
    const glm::dvec3 a = scene_.mesh.positions[of.x] - anchor_, b = scene_.mesh.positions[of.y] - anchor_,
                     c = scene_.mesh.positions[of.z] - anchor_, normal = glm::cross(b - a, c - a);
    return glm::dot(normal, along) * glm::dot(normal, eye_ - a) < 0.0;
  }

  const scene::Scene& scene_;
  glm::dvec3 anchor_, eye_, forward_, x_, y_;
  glm::ivec2 size_;
  const Image& depths_;
  const std::vector<uint32_t>& ids_;
  double thickness_;
};

/// The pyramid skips nothing that a ray could meet, and rays are cut to the picture without loss: pixel by
/// pixel in double precision, along the ray's length instead of its picture, they end the same. Where a ray's
/// depth and a surface's are equal up to rounding they may not: float's depths are known to some 1e-6 of
/// themselves, and along a ray of some 30 px the distance between ray and surface changes by 1e-3 of the
/// depth a pixel or more, so that one step in a thousand is uncertain, a ray in thirty at worst; and borders
/// of pixels within the 0.002 px that the march goes past them decide otherwise in one of 500 steps. Such a
/// step changes the answer only where the surface ends there, one time in ten at most: 1 % of the rays.
TEST_F(ScreenSpace, EndsWhereAWalkThroughAllPixelsEnds) {
  for (const char* name : {"mirrors/kitchen", "mirrors/ball", "mirrors/planes"}) {
    const scene::Scene scene =
        makeScene(name, std::string(name) == "mirrors/planes" ? Given{{"planes", int64_t{1}}}
                                                              : Given{{"tessellation", int64_t{8}}});
    const frame::GpuScene gpuScene(scene);
    for (const char* march : {"hierarchical", "linear"}) {
      const bool linear = std::string(march) == "linear";
      frame::Frame frame(context(), scene, gpuScene, kSizePx);
      const TechniqueInfo& info = TechniqueRegistry::instance().get("reflections/screen_space");
      Given given = {{"fade", 0.0}, {"march", std::string(march)}};
      if (linear) given["march.stride"] = 1.0;
      const auto made = info.make(ParameterValues(info.parameters, given));
      made->prepare(frame);
      frame.begin();
      made->render(frame);
      const Image reflected = made->debugViews().at("reflected")->read();
      const Image picture = frame.get<frame::Shaded>(frame::ShadedSetting{}).texture().read();
      const Image depths =
          frame.get<frame::GBufferChannel>(frame::ChannelSetting{frame::Channel::Depth}).texture().read();
      const std::vector<uint32_t> ids = frame.get<frame::TriangleIds>().texture().readUint();
      const frame::MirrorRays& rays = frame.get<frame::MirrorRays>();
      const Image origins = rays.origins().read(), directions = rays.directions().read();
      frame.end();
      const PixelWalk walk(scene, gpuScene.anchor(), kSizePx, depths, ids, 0.02 * gpuScene.diagonal());
      size_t compared = 0, met = 0, different = 0;
      for (int y = 0; y < kSizePx.y; ++y)
        for (int x = 0; x < kSizePx.x; ++x) {
          if (origins.at(x, y, 3) == 0.0F) continue;
          const auto vectorAt = [&](const Image& image) {
            return glm::dvec3(image.at(x, y, 0), image.at(x, y, 1), image.at(x, y, 2));
          };
          glm::ivec2 pixel;
          const PixelWalk::End end = walk.follow(vectorAt(origins), vectorAt(directions), pixel);
          ++compared;
          met += end == PixelWalk::End::Met;
          if (end == PixelWalk::End::None) {
            different += reflected.at(x, y, 3) != 0.0F;
            continue;
          }
          bool same = reflected.at(x, y, 3) == 1.0F;
          for (int c = 0; c < 3 && !linear; ++c)
            same = same &&
                   std::abs(reflected.at(x, y, c) -
                            (end == PixelWalk::End::Met ? picture.at(pixel.x, pixel.y, c) : 0.05F)) < 1e-6F;
          different += !same;
        }
      EXPECT_GT(met, 300U) << name;
      EXPECT_LE(different, compared / (linear ? 50 : 100)) << name << ' ' << march;
    }
  }
}

/// A mirror that faces the eye shows what is behind the eye: nothing of the picture. All rays end at the near
/// plane or at a border; that of the middle pixel, of which an odd size has one, leads into the eye.
TEST_F(ScreenSpace, RaysTowardsTheEyeFindNothing) {
  for (const double away : {0.1, 1.0, 100.0}) {
    scene::Scene scene;
    scene::addPart(scene, scene::card(glm::dvec3(0.0), {9.0, 0.0, 0.0}, {0.0, 9.0, 0.0}),
                   mirrorMaterial(1.0F));
    scene::addPart(scene, "behind", scene::card({0.0, 0.0, 200.0}, {9.0, 0.0, 0.0}, {0.0, 9.0, 0.0}),
                   {1.0F, 1.0F, 1.0F});
    scene::setStillCamera(scene, {{0.0, 0.0, away}, {0.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, 40.0});
    for (const char* march : {"hierarchical", "linear"}) {
      const Rendered found =
          render(scene, "reflections/screen_space", flat({{"march", std::string(march)}}), {161, 121}, true);
      EXPECT_GT(found.counter("mirror_px"), 100.0);
      EXPECT_EQ(found.counter("left_share"), 1.0) << march << " from " << away;
      EXPECT_EQ(found.counter("met_share"), 0.0) << march << " from " << away;
      for (const float value : found.product.data) ASSERT_TRUE(std::isfinite(value));
    }
  }
}

/// A convex mirror never meets itself.
TEST_F(ScreenSpace, ABallAloneMeetsNothing) {
  scene::Scene scene;
  scene::Mesh ball = scene::sphere(glm::dvec3(0.0), 0.5, 24);
  for (const glm::dvec3& p : ball.positions) ball.normals.emplace_back(glm::normalize(p));
  scene::addPart(scene, ball, mirrorMaterial(1.0F));
  scene::setStillCamera(scene, scene::orbitCamera(glm::dvec3(0.0), 2.0, 20.0, 30.0));
  for (const char* march : {"hierarchical", "linear"}) {
    const Rendered found =
        render(scene, "reflections/screen_space", {{"march", std::string(march)}}, kSizePx, true);
    EXPECT_GT(found.counter("mirror_px"), 3000.0);
    EXPECT_EQ(found.counter("met_share"), 0.0) << march;
  }
}

/// A bar before the wall hides a part of it. Unlimited in depth it catches rays that pass behind it; up to
/// its back face, or a little deep, it lets them pass, and fewer pixels differ from the reference. What the
/// wall shows behind the bar only the second layer knows.
TEST_F(ScreenSpace, ThicknessLetsRaysPassBehind) {
  scene::Scene scene = wallBehindFloor(4);
  scene::addPart(scene, "bar", scene::box({-1.5, 0.58, 0.8}, {1.5, 0.64, 0.86}), {0.1F, 0.9F, 0.1F});
  const Image truth =
      render(scene, "reflections/reference", {{"shading.ambient", 1.0}, {"shading.diffuse", 0.0}}, kSizePx)
          .product;
  const auto error = [&](const char* thickness, Given given) {
    given["thickness"] = std::string(thickness);
    return meanDifference(render(scene, "reflections/screen_space", flat(std::move(given)), kSizePx).product,
                          truth);
  };
  const double thick = error("constant", {{"thickness.depth", 10.0}}),
               thin = error("constant", {{"thickness.depth", 0.005}}),
               faces = error("back_faces", {{"thickness.least", 0.005}}),
               layers = error("second_layer", {{"thickness.depth", 0.005}});
  EXPECT_LT(thin, thick);
  EXPECT_LT(faces, thick);
  EXPECT_LT(layers, thin);
}

/// Rays that go behind the bar and are given up bring nothing; all others bring what they did.
TEST_F(ScreenSpace, RaysThatAreGivenUpBringNothing) {
  scene::Scene scene = wallBehindFloor(4);
  scene::addPart(scene, "bar", scene::box({-1.5, 0.58, 0.8}, {1.5, 0.64, 0.86}), {0.1F, 0.9F, 0.1F});
  for (const char* march : {"hierarchical", "linear"}) {
    const auto of = [&](const char* behind) {
      const Given given = {
          {"march", std::string(march)}, {"thickness.depth", 0.005}, {"behind", std::string(behind)}};
      return render(scene, "reflections/screen_space", flat(given), kSizePx, true);
    };
    const Rendered followed = of("follow"), givenUp = of("give_up");
    size_t lost = 0;
    for (size_t i = 0; i < followed.product.pixels(); ++i) {
      const auto at = [&](const Rendered& rendered, size_t c) { return rendered.product.data[4 * i + c]; };
      if (at(followed, 0) == at(givenUp, 0) && at(followed, 1) == at(givenUp, 1)) continue;
      ++lost;
      for (size_t c = 0; c < 3; ++c) ASSERT_EQ(at(givenUp, c), 0.0F) << march << " pixel " << i;
    }
    EXPECT_GT(lost, 100U) << march;
    EXPECT_GT(givenUp.counter("hidden_share"), followed.counter("hidden_share")) << march;
  }
}

/// Where rays have met something it stays; elsewhere is the environment map's light.
TEST_F(ScreenSpace, TheEnvironmentMapIsUnderneath) {
  const scene::Scene scene = makeScene("mirrors/ball", {{"tessellation", int64_t{12}}});
  const auto of = [&](const char* fallback) {
    Given given = {{"fade", 0.0}, {"fallback", std::string(fallback)}};
    if (given.at("fallback") == ParameterValue(std::string("environment_map")))
      given["fallback.lookup"] = std::string("depth");
    return render(scene, "reflections/screen_space", given, kSizePx, true);
  };
  const Rendered none = of("none"), map = of("environment_map");
  const Image environment =
      render(scene, "reflections/environment_map", {{"lookup", std::string("depth")}}, kSizePx).product;
  size_t kept = 0, replaced = 0;
  for (size_t i = 0; i < map.product.pixels(); ++i) {
    const auto same = [&](const Image& image) {
      for (size_t c = 0; c < 3; ++c)
        if (std::abs(map.product.data[4 * i + c] - image.data[4 * i + c]) > 1e-6F) return false;
      return true;
    };
    const bool asBefore = same(none.product), asMap = same(environment);
    ASSERT_TRUE(asBefore || asMap) << "pixel " << i;
    kept += asBefore && !asMap;
    replaced += asMap && !asBefore;
  }
  EXPECT_GT(kept, 100U);
  // Every pixel without an answer, but for those that the map shows black.
  EXPECT_NEAR(double(replaced), map.counter("fallback_share") * map.counter("mirror_px"),
              0.01 * map.counter("mirror_px"));
}

/// At the picture's border what rays meet fades, by half in the middle of the border's width.
TEST_F(ScreenSpace, ReflectionsFadeAtTheBorder) {
  const scene::Scene scene = wallBehindFloor(4);
  const View view(scene.camera.at(0.0), kSizePx);
  const double width = 0.25 * kSizePx.y;
  const Image plain = render(scene, "reflections/screen_space", flat(), kSizePx).product;
  const Image faded = render(scene, "reflections/screen_space", flat({{"fade", 0.25}}), kSizePx).product;
  size_t compared = 0;
  for (int y = 0; y < kSizePx.y; ++y)
    for (int x = 0; x < kSizePx.x; ++x) {
      const glm::dvec3 ray = view.through({x + 0.5, y + 0.5});
      if (ray.y >= 0.0 || plain.at(x, y, 0) == 0.0F) continue;
      const glm::dvec3 floor = view.eye - view.eye.y / ray.y * ray;
      if (std::abs(floor.x) >= 2.0 || floor.z <= -2.0 || floor.z >= 2.0) continue;
      const glm::dvec3 away(ray.x, -ray.y, ray.z), at = floor + (-2.0 - floor.z) / away.z * away;
      if (std::abs(at.x) >= 2.0 || at.y >= 2.0) continue;
      const glm::dvec2 px = view.place(at).px;
      const double inside = std::min({px.x, px.y, kSizePx.x - px.x, kSizePx.y - px.y});
      // A step of a pixel ends within 1.5 px of the true place.
      EXPECT_NEAR(faded.at(x, y, 0) / plain.at(x, y, 0), std::clamp(inside / width, 0.0, 1.0), 1.5 / width);
      ++compared;
    }
  EXPECT_GT(compared, 500U);
}

}  // namespace
}  // namespace limen::techniques
