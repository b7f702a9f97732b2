// SPDX-License-Identifier: BSD-3-Clause
// Several invocations that share the loop over a pixel's micro-occluders.
#include <cstring>

#include "tests/renderer/techniques/technique_fixture.h"

namespace limen::techniques {
namespace {

using SharedLoops = TechniqueTest;

// Masks are joined by OR, whatever the order; areas are added up in another one.
TEST_F(SharedLoops, FindWhatASingleInvocationFinds) {
  const scene::Scene scene = makeScene("sphere_grid");
  for (const char* occluders : {"micropatches", "microquads_microtris", "microrects"})
    for (const char* technique : {"soft_shadows/bitmask", "soft_shadows/backprojection"}) {
      const auto visibility = [&](int64_t lanes) {
        return render(scene, technique,
                      {{"resolution", int64_t{256}},
                       {"occluders", std::string(occluders)},
                       {"passes", std::string("split")},
                       {"passes.lanes", lanes}},
                      {61, 45})
            .product.data;
      };
      const std::vector<float> one = visibility(1);
      for (const int64_t lanes : {2, 8, 16}) {
        SCOPED_TRACE(testing::Message() << technique << ' ' << occluders << ' ' << lanes);
        const std::vector<float> several = visibility(lanes);
        ASSERT_EQ(one.size(), several.size());
        if (technique == std::string("soft_shadows/bitmask")) {
          EXPECT_EQ(std::memcmp(one.data(), several.data(), one.size() * sizeof(float)), 0);
        }
        for (size_t i = 0; i < one.size(); ++i) ASSERT_NEAR(one[i], several[i], 1e-5) << i;
      }
    }
}

}  // namespace
}  // namespace limen::techniques
