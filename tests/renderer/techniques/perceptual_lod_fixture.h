// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "renderer/frame/shaded.h"
#include "renderer/scene/lod_set.h"
#include "renderer/scene/shapes.h"
#include "renderer/scene/stage.h"
#include "renderer/techniques/perceptual_lod/oracle.h"
#include "renderer/techniques/perceptual_lod/pipeline.h"
#include "tests/renderer/techniques/technique_fixture.h"

namespace limen::techniques {

/// Scenes of upright squares before a wall, made so that what a pixel shows can be worked out by hand: the
/// camera sees 4 x 4 units of the plane z = 0 from a distance of 5, so a picture of 64 x 64 has 16 pixels a
/// unit there.
class PerceptualLodTest : public TechniqueTest {
 protected:
  static constexpr int kSize = 64;

  static scene::Mesh square(double side, glm::dvec3 centre = glm::dvec3(0.0)) {
    return scene::card(centre, {0.5 * side, 0.0, 0.0}, {0.0, 0.5 * side, 0.0});
  }

  static scene::LodSet squares(const std::vector<double>& sides) {
    scene::LodSet set{"square", {}};
    for (const double side : sides) set.levels.push_back({square(side)});
    return set;
  }

  /// Squares of side 1 whose light is lower by `steps` [cd/m2] from level to level: their normals turn away.
  /// `albedo` gives luminance 100 on the study's display where the light falls straight.
  static scene::LodSet shades(const std::vector<double>& steps) {
    scene::LodSet set{"shade", {}};
    for (const double step : steps) {
      scene::LodMesh level{square(1.0)};
      const double cosine = 1.0 - step / (kRangeCdM2 * kAlbedo100 * 0.8);
      level.mesh.normals.assign(level.mesh.positions.size(),
                                glm::vec3(std::sqrt(1.0 - cosine * cosine), 0.0, cosine));
      set.levels.push_back(std::move(level));
    }
    return set;
  }

  // The display "schwarz_2009" without ambient light: 0.5 to 250 cd/m2.
  static constexpr double kRangeCdM2 = 249.5, kAlbedo100 = 99.5 / 249.5;

  static scene::Scene wall(float albedo) {
    scene::Scene scene;
    scene.name = "wall";
    addPart(scene, "wall", scene::card({0.0, 0.0, -1.0}, {9.0, 0.0, 0.0}, {0.0, 9.0, 0.0}),
            glm::vec3(albedo));
    scene::Camera camera;
    camera.verticalFovDeg = 2.0 * glm::degrees(std::atan(0.4));
    setStillCamera(scene, camera);
    return scene;
  }

  /// Light from so far behind the camera that it is the same all over.
  static void light(scene::Scene& scene) {
    scene.lights = {scene::lightTowards({0.0, 0.0, 1e4}, glm::dvec3(0.0), glm::dvec2(1.0))};
  }

  static void addSquares(scene::Scene& scene, const scene::LodSet& set, glm::dvec3 at, float albedo) {
    scene::Material material{set.name, glm::vec3(albedo)};
    std::vector<double> switches;
    for (size_t i = 1; i < set.levels.size(); ++i) switches.push_back(static_cast<double>(4 * i));
    addLodObject(scene, set, {at, 0.0, 1.0}, material, switches);
  }

  static PerceptualLodSettings settings(Given given = {}) {
    const SettingsTable<PerceptualLodSettings>& table = PerceptualLodSettings::table();
    return table.read(ParameterValues(table.parameters(), given));
  }
  /// Surfaces show their albedo.
  static Given unlit(Given given = {}) {
    given["shading.ambient"] = 1.0;
    given["shading.diffuse"] = 0.0;
    return given;
  }

  /// A pipeline on a scene, frame by frame.
  struct Bench {
    Bench(const scene::Scene& scene, const PerceptualLodSettings& settings,
          glm::ivec2 sizePx = glm::ivec2(kSize), frame::Raster raster = frame::Raster::Auto)
        : gpuScene(scene), frame(context(), scene, gpuScene, sizePx, 0.0, raster), pipeline(frame, settings) {
      pipeline.prime(0.0);
    }
    void run(int frames, double timeS = 0.0) {
      for (int i = 0; i < frames; ++i) {
        frame.begin();
        pipeline.render(timeS, true);
        frame.end();
      }
    }
    frame::GpuScene gpuScene;
    frame::Frame frame;
    PerceptualPipeline pipeline;
  };

  /// The ordinary picture of a choice of levels, with the shadows of that or another one.
  static Image picture(Bench& bench, const scene::LodSelection& selection,
                       const frame::ShadedSetting& shading, double timeS = 0.0,
                       const scene::LodSelection* casters = nullptr) {
    frame::Frame frame(context(), bench.frame.scene(), bench.gpuScene, bench.frame.sizePx(), timeS,
                       bench.frame.raster());
    frame::Frame shadows(frame, "shadows", bench.frame.sizePx());
    if (casters) {
      shadows.setLevels(*casters);
      frame.setCasters(&shadows);
    }
    frame.setLevels(selection);
    frame.begin();
    shadows.begin();
    Image out = frame.get<frame::Shaded>(shading).texture().read();
    frame.end();
    return out;
  }
};

}  // namespace limen::techniques
