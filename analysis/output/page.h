// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace limen::analysis {

/// A page that needs no other file: the style that all pages share and then `style`, `body` as it is, and
/// `script` at the end unless that is "". Follows the reader's choice of a light or a dark page.
std::string renderDocument(const std::string& title, const std::string& style, const std::string& body,
                           const std::string& script = {});

/// An SVG file of gnuplot's as a part of a page: no XML head, no titles that would pop up, ids that open with
/// `name`, colours that follow the page. `role` "group" if its parts speak for themselves, else "img".
std::string inlineSvg(std::string svg, const std::string& name, const std::string& description,
                      const std::string& role);

}  // namespace limen::analysis
