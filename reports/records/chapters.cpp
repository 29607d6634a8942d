#include "reports/records/chapters.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace reports {
namespace {

/// "free-surfaces" as a heading: "Free surfaces".
std::string heading(std::string topic) {
  std::ranges::replace(topic, '-', ' ');
  if (!topic.empty() && topic[0] >= 'a' && topic[0] <= 'z')
    topic[0] = static_cast<char>(topic[0] - 'a' + 'A');
  return topic;
}

std::string figure_of(const ReportData& data, const std::string& study) {
  for (const ReportFigure& shown : data.figures)
    if (shown.figure.study == study && shown.drawn) return shown.figure.name;
  return "";
}

Headline headline(const std::string& title, const std::string& figure,
                  const std::vector<const CheckRecord*>& checks) {
  Headline result{title,
                  checks.front()->study,
                  figure,
                  std::numeric_limits<double>::infinity(),
                  -std::numeric_limits<double>::infinity(),
                  decisive(checks),
                  checks.size(),
                  true,
                  true};
  for (const CheckRecord* check : checks) {
    result.lowest = std::isnan(check->observed) ? check->observed : std::min(result.lowest, check->observed);
    result.highest =
        std::isnan(check->observed) ? check->observed : std::max(result.highest, check->observed);
    result.holds = result.holds && holds(*check);
    result.one_band &= check->lower == result.decisive->lower && check->upper == result.decisive->upper;
  }
  // One range beside one band would say that all of them must lie in it.
  if (!result.one_band) result.lowest = result.highest = result.decisive->observed;
  return result;
}

}  // namespace

bool Chapter::has(const std::string& study) const {
  return std::ranges::any_of(studies, [&](const StudyRecord& s) { return s.study == study; });
}

std::vector<Chapter> chapters_of(const ReportData& data) {
  std::vector<Chapter> chapters;
  const auto titled = [&](const std::string& title) -> Chapter& {
    const auto found = std::ranges::find(chapters, title, &Chapter::title);
    return found != chapters.end() ? *found : chapters.emplace_back(Chapter{title, "", "", {}, {}});
  };
  for (const ChapterRecord& record : data.results.chapters) {
    if (record.topic == scope_topic) continue;
    Chapter& chapter = titled(record.title);
    chapter.topics.push_back(record.topic);
    if (chapter.paragraph.empty()) chapter.paragraph = record.paragraph;
    if (chapter.figure.empty()) chapter.figure = record.figure;
  }
  std::vector<StudyRecord> of_none;
  for (const StudyRecord& study : studies_of(data.results)) {
    const auto found = std::ranges::find_if(
        chapters, [&](const Chapter& c) { return std::ranges::count(c.topics, study.topic) > 0; });
    if (found != chapters.end()) {
      found->studies.push_back(study);
    } else if (study.topic.empty()) {
      of_none.push_back(study);
    } else {
      Chapter& chapter = titled(heading(study.topic));
      chapter.topics.push_back(study.topic);
      chapter.studies.push_back(study);
    }
  }
  if (!of_none.empty()) chapters.push_back({"Studies", "", "", {""}, of_none});
  std::erase_if(chapters, [](const Chapter& chapter) { return chapter.studies.empty(); });
  for (Chapter& chapter : chapters) {
    const bool drawn = std::ranges::any_of(data.figures, [&](const ReportFigure& shown) {
      return shown.figure.name == chapter.figure && shown.drawn && chapter.has(shown.figure.study);
    });
    if (!drawn) chapter.figure.clear();
    for (const StudyRecord& study : chapter.studies)
      if (chapter.figure.empty()) chapter.figure = figure_of(data, study.study);
  }
  return chapters;
}

std::string scope_of(const Results& results) {
  for (const ChapterRecord& chapter : results.chapters)
    if (chapter.topic == scope_topic) return chapter.paragraph;
  return "";
}

std::vector<Headline> headlines_of(const ReportData& data, std::size_t count) {
  std::vector<Headline> headlines;
  std::set<std::string> shown;
  for (const HeadlineRecord& record : data.results.headlines) {
    if (headlines.size() == count) break;
    auto checks = checks_of(data.results, record.study);
    std::erase_if(checks,
                  [&](const CheckRecord* c) { return c->check.find(record.check) == std::string::npos; });
    if (checks.empty()) continue;
    const bool drawn = std::ranges::any_of(data.figures, [&](const ReportFigure& figure) {
      return figure.figure.name == record.figure && figure.drawn;
    });
    headlines.push_back(headline(record.title, drawn ? record.figure : "", checks));
    shown.insert(record.study);
  }
  for (const bool with_figure : {true, false})
    for (const StudyRecord& study : studies_of(data.results)) {
      const std::string figure = figure_of(data, study.study);
      if (headlines.size() == count || shown.contains(study.study) || figure.empty() == with_figure) continue;
      const CheckRecord* check = decisive(checks_of(data.results, study.study));
      if (check == nullptr) continue;
      headlines.push_back(headline(check->check, figure, {check}));
      shown.insert(study.study);
    }
  return headlines;
}

double margin(const CheckRecord& check) {
  const double below = check.observed - check.lower, above = check.upper - check.observed;
  if (std::isfinite(check.lower) && std::isfinite(check.upper)) {
    const double band = check.upper - check.lower;
    // An error in [0, bound] is as good as it can be at 0, not in the middle.
    if (check.lower == 0 && band > 0 && below >= 0) return above / band;
    return band > 0 ? 2 * std::min(below, above) / band : (below == 0 ? 1 : -1);
  }
  const double scale =
      std::max({std::abs(check.observed), std::isfinite(check.upper) ? std::abs(check.upper) : 0,
                std::isfinite(check.lower) ? std::abs(check.lower) : 0});
  const double distance = std::min(below, above);
  return scale > 0 ? distance / scale : (distance >= 0 ? 1 : -1);
}

const CheckRecord* decisive(const std::vector<const CheckRecord*>& checks) {
  const CheckRecord* least = nullptr;
  const auto distance = [](const CheckRecord& check) {
    const double m = margin(check);
    return std::isnan(m) ? -std::numeric_limits<double>::infinity() : m;
  };
  // What did not happen ("runs that did not complete: 0") decides only where nothing else is measured.
  const auto counted = [](const CheckRecord& check) {
    return check.unit == outcome_unit || check.lower == check.upper;
  };
  for (const bool also_counted : {false, true}) {
    for (const CheckRecord* check : checks) {
      if (holds(*check) && counted(*check) != also_counted) continue;
      if (least == nullptr || distance(*check) < distance(*least)) least = check;
    }
    if (least != nullptr) return least;
  }
  return least;
}

std::vector<std::string> schemes_of(const Results& results, const std::string& study) {
  std::set<std::string> words;
  const auto add = [&](const auto& record) {
    if (record.study == study) words.insert({record.basis, record.transfer, record.stepping});
  };
  for (const RunRecord& run : results.runs) {
    add(run);
    if (run.study == study) words.insert(run.method);
  }
  for (const StabilityRecord& record : results.stability) add(record);
  for (const ScoreRecord& record : results.scores) add(record);
  words.erase("");
  words.erase(foreign_scheme);
  return {words.begin(), words.end()};
}

}  // namespace reports
