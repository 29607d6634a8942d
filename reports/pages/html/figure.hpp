#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "reports/records/report_data.hpp"

namespace reports {

/// The figures of a page. Each is there once, where it is first wanted; later it is a picture of that one.
class PageFigures {
 public:
  /// Reads the drawn figures of <dir>/figures. @throws IoError if one of them cannot be read.
  PageFigures(const std::filesystem::path& dir, const std::vector<ReportFigure>& figures);

  /// Figure with caption; a link to where it stands if it has been shown before. "" for an unknown name.
  std::string shown(const std::string& name);
  /// The bare picture of a figure that stands elsewhere in the page; "" if it is not drawn.
  [[nodiscard]] std::string thumbnail(const std::string& name) const;
  /// Names of a study's figures, drawn or not.
  [[nodiscard]] std::vector<std::string> of_study(const std::string& study) const;

 private:
  struct Entry {
    const ReportFigure* figure;
    std::string svg;      ///< element; "" when not drawn
    std::string viewbox;  ///< of it
    bool placed = false;
  };
  std::map<std::string, Entry> entries_;
  std::vector<std::string> order_;
};

}  // namespace reports
