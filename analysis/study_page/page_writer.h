// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "analysis/output/result.h"
#include "analysis/study_page/figure.h"

namespace limen::analysis {

/// A file beside the page.
struct PageFile {
  std::string path;  ///< from the page's folder
  std::string bytes, meaning;
};

/// What the sections of a page write into. Figures and tables are numbered as they come; figures are drawn
/// together when the page is finished.
class PageWriter {
 public:
  void openSection(const std::string& id, const std::string& title);
  void closeSection();
  void heading(const std::string& text);  ///< within a section
  void paragraph(const std::string& text);
  void notice(const std::string& text, bool bad = false);
  void list(const std::vector<std::string>& items);
  /// What people see of a table; its first column heads each row. `file`: CSV with the same at full precision, ""
  /// if there is none. Nothing for a table without rows. Folded from `openRows` rows on.
  void table(const ResultTable& table, const std::string& caption, const std::string& file = {},
             size_t openRows = 40);
  void figure(Figure figure, const std::string& caption);
  void html(const std::string& text) { html_ += text; }  ///< as it is
  void file(const std::string& path, const std::string& bytes, const std::string& meaning);

  const std::vector<Figure>& figures() const { return figures_; }
  const std::vector<PageFile>& files() const { return files_; }

  /// The page's body with figures put in: `drawn` by their names.
  std::string body(const std::map<std::string, std::string>& drawn) const;

 private:
  std::string html_;
  std::vector<Figure> figures_;
  std::vector<PageFile> files_;
  size_t tables_ = 0;
};

}  // namespace limen::analysis
