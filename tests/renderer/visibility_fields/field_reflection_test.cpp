// SPDX-License-Identifier: BSD-3-Clause
// Reflections from fields with normals, and by the same rays traced, against geometry and double precision.
#include <cmath>

#include "renderer/visibility_fields/map_functions.h"
#include "renderer/visibility_fields/visibility_fields.h"
#include "tests/renderer/techniques/reflections/reflection_fixture.h"

namespace limen::techniques {
namespace {

constexpr const char *kFieldMirrors = "visibility_fields/reflections",
                     *kTracedMirrors = "visibility_fields/traced_reflections";

class FieldReflectionTest : public ReflectionTest {
 protected:
  static constexpr double kLobe = 0.3, kBallAngle = 0.15;  // rad

  /// A glossy mirror below a white ball whose middle the mirrored view meets; the rest is black.
  static scene::Scene ballAboveAGlossyMirror() {
    scene::Scene scene;
    scene::Material glossy = mirrorMaterial(1.0F);
    glossy.albedo = glm::vec3(0.0F);
    glossy.glossRad = static_cast<float>(kLobe);
    scene::addPart(scene, scene::planeGrid(glm::dvec3(0.0), 0.2, 0.2, 2), glossy);
    const glm::dvec3 middle = 4.0 * glm::normalize(glm::dvec3(0.0, 1.0, -1.0));
    scene::addPart(scene, "ball", scene::sphere(middle, 4.0 * std::sin(kBallAngle), 64), glm::vec3(1.0F));
    scene::setStillCamera(scene, {{0.0, 1.0, 1.0}, glm::dvec3(0.0), {0.0, 1.0, 0.0}, 0.5});
    return scene;
  }
};

// The ball takes (1 - cos b) / (1 - cos g) of the cone. 64 rays in cells of equal solid angle, 8 rings of 8,
// turned: only the ring that the ball's outline cuts is undecided, 8 rays at most, so that a pixel has a
// deviation of at most sqrt(8) / 2 / 64 = 0.022, and 256 pixels one of 0.0014; four of them. Facets of the
// ball take less than 1e-3, and a field's position lies within 0.04 radii of where a ray enters, where it
// enters the ball itself: another 0.5 % of its area.
TEST_F(FieldReflectionTest, ABallInALobeHasTheShareOfItsSolidAngle) {
  const scene::Scene scene = ballAboveAGlossyMirror();
  const double share = (1.0 - std::cos(kBallAngle)) / (1.0 - std::cos(kLobe));
  for (const char* technique : {kTracedMirrors, kFieldMirrors}) {
    const Image image = render(scene, technique,
                               {{"rays", int64_t{64}},
                                {"turned", true},
                                {"shading.ambient", 1.0},
                                {"shading.diffuse", 0.0},
                                {"shading.background", 0.0}},
                               {16, 16})
                            .product;
    double sum = 0.0;
    for (size_t i = 0; i < image.pixels(); ++i) sum += image.data[4 * i];
    EXPECT_NEAR(sum / double(image.pixels()), share, 0.0056 + 1e-3 + 0.005 * share) << technique;
  }
}

// Perfect mirrors by the rays traced: as in RayTracedMirrors.AgreesWithTheReferencePixelByPixel, of which
// this is a bounce without shadows: 2e-4, but for 40 pixels at edges.
TEST_F(FieldReflectionTest, TracedRaysAgreeWithTheReferencePixelByPixel) {
  const scene::Scene scene = makeScene("mirrors/ball", {{"tessellation", int64_t{24}}});
  const Image truth = render(scene, "reflections/reference", {{"bounces", int64_t{1}}}, {160, 120}).product;
  const Image found = render(scene, kTracedMirrors, {{"rays", int64_t{1}}}, {160, 120}).product;
  EXPECT_LE(differing(found, truth, 2e-4).count, 40U);
}

// A ball with its own normals, seen in a flat mirror: everything that the mirror shows is known. Where the
// field's position is as far from the entry as it can be, 0.04 radii of the ball, the hit and so the normal
// are off by as much; the texel adds nothing, as the ball is met where its sphere is entered. 8 bits a
// coordinate: 0.017 (FieldNormals below). Lambert's light changes by no more than the normal: 0.06 of the
// albedo 0.5 times the light's 1, on average half of it.
TEST_F(FieldReflectionTest, AMirrorShowsABallWithItsShading) {
  scene::Scene scene;
  scene::Material mirror = mirrorMaterial(1.0F);
  mirror.albedo = glm::vec3(0.0F);
  scene::addPart(scene, scene::planeGrid(glm::dvec3(0.0), 6.0, 6.0, 2), mirror);
  const glm::dvec3 middle(0.0, 1.0, -1.0);
  scene::Mesh ball = scene::sphere(middle, 0.5, 32);
  for (const glm::dvec3& position : ball.positions)
    ball.normals.emplace_back(glm::normalize(position - middle));
  scene::addPart(scene, "ball", ball, glm::vec3(0.5F));
  scene.lights = {scene::lightTowards({0.0, 6.0, 3.0}, middle, glm::dvec2(0.1))};
  scene::setStillCamera(scene, {{0.0, 0.8, 0.8}, {0.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, 40.0});
  const Given shading = {{"shading.ambient", 0.0}};
  const Image truth = render(scene, "reflections/reference", shading, {64, 48}).product;
  Given given = shading;
  given.insert({{"rays", int64_t{1}}, {"positions", int64_t{4226}}, {"directions", int64_t{64}}});
  const Image found = render(scene, kFieldMirrors, given, {64, 48}).product;
  double sum = 0.0;
  size_t shown = 0, far = 0;
  for (size_t i = 0; i < truth.pixels(); ++i) {
    if (!(truth.data[4 * i] > 0.0F)) continue;
    const double apart =
        std::abs(double(found.data[4 * i]) - truth.data[4 * i]) / double(truth.data[4 * i] + 0.1F);
    sum += apart, ++shown, far += apart > 0.3;
  }
  ASSERT_GT(shown, 200U);
  EXPECT_LT(sum / double(shown), 0.06);
  // At the ball's outline and where light grazes it.
  EXPECT_LT(double(far) / double(shown), 0.06);
}

// Slack tells an object's own surface from what blocks its rays: on a mirror without a field, within the
// sphere of a box that stands on it, none is needed, however large, and what is near to the box is shown.
TEST_F(FieldReflectionTest, ReceiversOfOtherObjectsHaveNoSlack) {
  scene::Scene scene;
  scene::Material mirror = mirrorMaterial(1.0F);
  mirror.albedo = glm::vec3(0.0F);
  scene::addPart(scene, scene::planeGrid(glm::dvec3(0.0), 6.0, 6.0, 2), mirror);
  scene.parts.back().receiverOnly = true;
  scene::addPart(scene, "box", scene::box({-0.5, 0.0, -0.5}, {0.5, 1.0, 0.5}), glm::vec3(0.5F));
  scene.lights = {scene::lightTowards({0.0, 6.0, 3.0}, {0.0, 0.0, 0.0}, glm::dvec2(0.1))};
  scene::setStillCamera(scene, {{0.0, 0.6, 1.6}, {0.0, 0.0, 0.6}, {0.0, 1.0, 0.0}, 20.0});
  Given given = {{"rays", int64_t{1}}, {"positions", int64_t{1090}}};
  const Image without = render(scene, kFieldMirrors, given, {40, 30}).product;
  given["slack"] = 20.0;
  EXPECT_EQ(meanDifference(without, render(scene, kFieldMirrors, given, {40, 30}).product), 0.0);
  const Image exact = render(scene, kTracedMirrors, {{"rays", int64_t{1}}}, {40, 30}).product;
  // But for the box's outlines, within half a footprint, 0.06 radii of 0.87, of 1.2 across the view: a
  // twentieth.
  EXPECT_LT(differing(without, exact, 0.02).count, 0.05 * 40 * 30);
}

// The switch: fields for rays from the eye as well put mirrors where their positions are, so that the error
// grows.
TEST_F(FieldReflectionTest, LookingUpRaysFromTheEyeShowsThePattern) {
  const scene::Scene scene = makeScene("mirrors/ball", {{"tessellation", int64_t{24}}});
  const Image traced = render(scene, kTracedMirrors, {{"rays", int64_t{1}}}, {80, 60}).product;
  Given given = {{"rays", int64_t{1}}};
  const double exact = meanDifference(render(scene, kFieldMirrors, given, {80, 60}).product, traced);
  given["primary"] = std::string("field");
  const double looked = meanDifference(render(scene, kFieldMirrors, given, {80, 60}).product, traced);
  EXPECT_GT(looked, 2.0 * exact);
}

// Normals that a field stores are those of what its rays hit: of two balls, whose vertices have the balls'
// own, which triangles interpolate so that they are normal to the ball at every hit. 8 bits a coordinate
// place a normal within 1 / 255 of its place on both axes of the octahedron, which is sqrt(6) / 255 in space
// on a surface no nearer than 1 / sqrt(3): 0.0167.
TEST_F(FieldReflectionTest, StoredNormalsAreThoseOfTheSurface) {
  namespace vf = visibility_fields;
  const glm::dvec3 centres[] = {{-0.6, 0.1, 0.0}, {0.5, 0.3, 0.2}};
  scene::Mesh mesh;
  for (const glm::dvec3 centre : centres) {
    scene::Mesh ball = scene::sphere(centre, 0.3, 16);
    for (const glm::dvec3& p : ball.positions) ball.normals.emplace_back(glm::normalize(p - centre));
    scene::append(mesh, ball);
  }
  const vf::RigidObject object = vf::makeRigidObject("balls", mesh.positions, mesh.triangles, mesh.normals);
  const vf::FieldForm form{vf::PositionForm::Lattice, 82, vf::DirectionForm::Concentric, 32, 32, 16};
  const vf::VisibilityFields fields(context(), {object}, form);
  const vf::PositionMap positions(form.positionMap, form.positions);
  const std::vector<uint32_t> words = fields.readWords(0);
  const std::vector<float> shares = fields.readShares(0);
  ASSERT_EQ(words.size(), shares.size());
  double worst = 0.0;
  size_t hits = 0;
  for (size_t i = 0; i < words.size(); ++i) {
    if (shares[i] < 0.0F) continue;
    ++hits;
    const glm::vec3 position = positions.points()[i / 1024], z = -position;
    const glm::vec3 local =
        vf::fieldDirection((glm::vec2(i % 32, i % 1024 / 32) + 0.5F) / 32.0F, vf::kFieldConcentric);
    const glm::vec3 way = local.x * vf::fieldTangent(z) + local.y * vf::fieldBitangent(z) + local.z * z;
    const glm::dvec3 at =
        object.sphere.centre + object.sphere.radius * glm::dvec3(position + 2.0F * shares[i] * way);
    const glm::dvec3 centre =
        glm::length(at - centres[0]) < glm::length(at - centres[1]) ? centres[0] : centres[1];
    worst = std::max(
        worst, glm::length(glm::dvec3(vf::fieldNormal(words[i] >> 16, 8)) - glm::normalize(at - centre)));
  }
  EXPECT_GT(hits, 5000U);
  EXPECT_LT(worst, 0.0167 + 1e-3);
}

TEST_F(FieldReflectionTest, RefusesRaysThatAreNoSquare) {
  const std::optional<Error> error = refusal(kFieldMirrors, {{"rays", int64_t{5}}});
  ASSERT_TRUE(error);
}

}  // namespace
}  // namespace limen::techniques
