// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/tessellation/trim_settings.h"

namespace limen::techniques {

const SettingsTable<TrimByTexture>& TrimByTexture::table() {
  using S = TrimByTexture;
  static const SettingsTable<S> kTable = {
      {&S::content, "content",
       "What texels hold: whether their middles are left, or their interpolated distance from the curves",
       "Schwarz 2009, section 6.1.4 (the former)"},
      {&S::resolution,
       "resolution",
       {8, 1024},
       "texel",
       "Texels along each direction of a surface's domain"}};
  return kTable;
}

}  // namespace limen::techniques
