#pragma once

#include <string>
#include <vector>

#include "reports/records/report_data.hpp"

namespace reports {

/// A chapter of the report: the studies of one topic, or of several that share a title.
struct Chapter {
  std::string title, paragraph;
  std::string figure;  ///< shown with the paragraph; "" for none
  std::vector<std::string> topics;
  std::vector<StudyRecord> studies;

  [[nodiscard]] bool has(const std::string& study) const;
};

/// Chapters in the order of chapters.csv, then those of topics that it does not name, then the studies of no
/// topic at all. Every study of studies_of() stands in exactly one; none is empty.
std::vector<Chapter> chapters_of(const ReportData& data);

/// What the results say they do not verify; "" if they say nothing.
std::string scope_of(const Results& results);

/// A number of the first screen: what a group of checks came to.
struct Headline {
  std::string title, study, figure;
  double lowest = 0, highest = 0;  ///< observed; NaN if any of them is; of the decisive one if bands differ
  const CheckRecord* decisive;     ///< the check nearest to a bound, or the worst failure
  std::size_t checks = 0;
  bool holds = false;     ///< all of them
  bool one_band = false;  ///< asked of all of them
};

/// At most `count` headlines: those of headlines.csv whose checks are there, then the checks nearest to their
/// bounds of further studies, those with a figure first.
std::vector<Headline> headlines_of(const ReportData& data, std::size_t count);

/// How far a check is from its nearest bound: 0 at it, 1 as far as can be, negative outside, NaN never.
double margin(const CheckRecord& check);

/// The check of least margin; null for none. Those of the scoreboard are passed over while they hold.
const CheckRecord* decisive(const std::vector<const CheckRecord*>& checks);

/// Words by which a study is found: method, basis, transfer, stepping of its runs, limits and scores.
std::vector<std::string> schemes_of(const Results& results, const std::string& study);

}  // namespace reports
