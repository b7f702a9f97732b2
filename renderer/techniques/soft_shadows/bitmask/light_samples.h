// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "experiments/base/enum_names.h"
#include "renderer/gl/shader_source.h"
#include "renderer/scene/scene.h"

namespace limen::techniques {

/// Positions of samples on the light: on grids, random, stratified, or by Halton's sequence; the number is
/// that of samples, for grids that per side. Source: Schwarz 2009, section 4.2.1.
enum class LightPattern {
  Regular8,
  Regular16,
  Regular32,
  Jittered16,  ///< rotated pairs
  Random128,
  Random256,
  Random1024,
  Stratified256,
  Halton256
};
constexpr EnumNames<LightPattern, 9> enumNames(LightPattern) {
  return {{{{LightPattern::Regular8, "regular_8"},
            {LightPattern::Regular16, "regular_16"},
            {LightPattern::Regular32, "regular_32"},
            {LightPattern::Jittered16, "jittered_16"},
            {LightPattern::Random128, "random_128"},
            {LightPattern::Random256, "random_256"},
            {LightPattern::Random1024, "random_1024"},
            {LightPattern::Stratified256, "stratified_256"},
            {LightPattern::Halton256, "halton_256"}}}};
}

/// Where the samples lie, which decides how masks of rectangles are made.
enum class SamplePlaces {
  Grid,          ///< at the centres of a grid's cells
  JitteredGrid,  ///< on a grid, rotated in pairs
  Anywhere       ///< masks come from a table
};
constexpr EnumNames<SamplePlaces, 3> enumNames(SamplePlaces) {
  return {{{{SamplePlaces::Grid, "grid"},
            {SamplePlaces::JitteredGrid, "jittered_grid"},
            {SamplePlaces::Anywhere, "anywhere"}}}};
}

/// Patterns on grids, for techniques without tables.
enum class GridPattern { Regular8, Regular16, Regular32, Jittered16 };
constexpr EnumNames<GridPattern, 4> enumNames(GridPattern) {
  return {{{{GridPattern::Regular8, "regular_8"},
            {GridPattern::Regular16, "regular_16"},
            {GridPattern::Regular32, "regular_32"},
            {GridPattern::Jittered16, "jittered_16"}}}};
}
inline LightPattern lightPattern(GridPattern pattern) {
  return fromText<LightPattern>(limen::toText(pattern));
}

/// True if masks of rectangles are computed; for other patterns they come from a table.
bool isGridPattern(LightPattern pattern);
/// What occlusion_mask.glsl has to know of a pattern: SAMPLE_PLACES, SAMPLES and, on grids, SAMPLES_ALONG.
void defineSamples(gl::ShaderDefines& defines, LightPattern pattern);

/// Positions of a pattern's light samples in unit light coordinates, in the order of the mask's bits; a
/// multiple of 32, at most 1024. Grids come in rows of ascending y, each with ascending x. `seed` applies to
/// random and stratified patterns.
std::vector<glm::dvec2> lightSamples(LightPattern pattern, int64_t seed = 1);

/// Mask of the samples that lie on a light which need not fill its bounding rectangle: bit b of the words is
/// sample b. Throws Error if there are none. Source: Schwarz 2009, section 4.2.2.
std::vector<uint32_t> lightMask(const scene::AreaLight& light, const std::vector<glm::dvec2>& samples);
/// Number of bits set.
int bitCount(const std::vector<uint32_t>& mask);

}  // namespace limen::techniques
