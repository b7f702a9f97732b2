// SPDX-License-Identifier: BSD-3-Clause
#include <epoxy/gl.h>

#include "tests/perception/popping_gpu_fixture.h"

namespace limen::perception {
namespace {

using gl::Format;
using gl::Texture;

// Shapes that union-find by tiles of 32 may get wrong: combs, spirals, a diagonal through tiles' corners, a
// full image, isolated pixels, noise of every density.
TEST_F(PoppingGpu, RegionsMatchFloodFill) {
  const int w = 150, h = 101;
  std::vector<std::vector<double>> maps;
  const auto make = [&](const auto& on) {
    std::vector<double> map(static_cast<size_t>(w) * h, 0.5);
    for (int y = 0; y < h; ++y)
      for (int x = 0; x < w; ++x)
        if (on(x, y)) map[static_cast<size_t>(y) * w + x] = 2.0 + 0.01 * ((x * 7 + y * 3) % 100);
    maps.push_back(map);
  };
  make([](int, int) { return true; });
  make([](int, int) { return false; });
  make([](int x, int y) { return x == y; });
  make([](int x, int y) { return x % 2 == 0 && y % 2 == 0; });
  make([](int x, int y) { return (x + y) % 2 == 0; });
  make([](int x, int y) { return y == 100 || x % 2 == 0; });
  make([](int x, int y) { return x == 0 || y % 2 == 0; });
  make([](int x, int y) { return y % 4 == 0 || (y % 4 == 2 && false) || x == (y / 4 % 2 ? 149 : 0); });
  make([](int x, int y) { return std::max(std::abs(x - 75), std::abs(y - 50)) % 3 == 0; });
  make([](int x, int y) { return (x == 31 || x == 32) && (y == 31 || y == 32); });
  make([](int x, int y) { return (x == 32 && y == 31) || (x == 31 && y == 32); });
  for (const double density : {0.1, 0.3, 0.41, 0.5, 0.6, 0.8, 0.95}) {
    const Image noise = noiseImage(w, h, 1, static_cast<unsigned>(100 * density));
    make([&](int x, int y) { return noise.at(x, y) < density; });
  }
  const Image seedNoise = noiseImage(w, h, 1, 77);
  for (const int connectivity : {8, 4}) {
    PoppingSettings settings;
    settings.regions.connectivity = connectivity;
    RegionsGpu gpu(context(), {w, h}, settings);
    for (size_t i = 0; i < maps.size(); ++i)
      for (const double seedShare : {1.1, 0.02}) {
        SCOPED_TRACE(std::to_string(i) + " seeds " + std::to_string(seedShare));
        std::vector<uint8_t> seeds(maps[i].size());
        std::vector<uint8_t> seedBytes;
        for (size_t p = 0; p < seeds.size(); ++p) seeds[p] = seedNoise.data[p] < seedShare ? 1 : 0;
        Image jnd(w, h, 1);
        std::vector<double> rounded(maps[i].size());
        for (size_t p = 0; p < seeds.size(); ++p)
          jnd.data[p] = static_cast<float>(maps[i][p]), rounded[p] = double{jnd.data[p]};
        Texture jndTexture(Format::R32F, {w, h}), seedTexture(Format::R8UI, {w, h});
        jndTexture.write(jnd);
        glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
        glTextureSubImage2D(seedTexture.id(), 0, 0, 0, w, h, GL_RED_INTEGER, GL_UNSIGNED_BYTE, seeds.data());
        glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
        gpu.run(jndTexture, seedTexture);
        expectSameRegions(gpu.read(), findRegions(rounded, seeds, w, h, settings), 1e-5);
      }
  }
}

}  // namespace
}  // namespace limen::perception
