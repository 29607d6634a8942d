#include "verification/suite/collect.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <string>

#include "verification/runs/validate.hpp"

namespace verification {
namespace {

/// What the scenes of a study were declared not to need (DESIGN: model only what a scene needs).
std::string left_out(const Study& study) {
  if (study.control) return "";
  if (std::ranges::any_of(study.runs, [](const PlannedRun& r) { return r.solver != nullptr; }))
    return "";  // what a foreign solver does without is not ours to say
  if (study.runs.empty()) return "walls (a uniform periodic lattice)";
  const auto all = [&](auto&& holds) { return std::ranges::all_of(study.runs, holds); };
  const auto any = [&](auto&& holds) { return std::ranges::any_of(study.runs, holds); };
  const auto words = [&](auto&& holds, const std::string& what) {
    return all(holds) ? what + "; " : any(holds) ? what + " (some variants); " : std::string();
  };
  std::string text = words(
      [](const PlannedRun& r) { return !r.scene.fluid.solver.pressure && !r.scene.fluid.incompressible; },
      "pressure and density");
  text += words([](const PlannedRun& r) { return r.scene.discretisation.cells_along == 1; },
                "variation along the flow (one periodic cell)");
  text +=
      words([](const PlannedRun& r) { return r.scene.fluid.label == "newtonian"; }, "shear rate (Newtonian)");
  return text.empty() ? "nothing" : text.substr(0, text.size() - 2);
}

/// Figures in the order of their numbers, conclusions after them.
int place_in_paper(const reports::ClaimRecord& claim) {
  const std::size_t digit = claim.source.find_first_of("0123456789");
  const int number = digit == std::string::npos ? 0 : std::stoi(claim.source.substr(digit));
  return claim.source.starts_with("Fig") ? number : 1000 + number;
}

}  // namespace

reports::Results collect(const std::vector<const StudyData*>& studies) {
  reports::Results results;
  const auto append = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
  std::map<long, reports::ChapterRecord> chapters;
  std::map<long, reports::HeadlineRecord> headlines;
  for (const StudyData* data : studies) {
    const Study& study = *data->study;
    if (study.chapter) chapters[study.chapter->second] = study.chapter->first;
    for (const auto& [headline, place] : study.headlines) headlines[place] = headline;
    if (study.scope) chapters[std::numeric_limits<long>::max()] = *study.scope;
    results.studies.push_back(
        {study.name, study.title, study.claim, name(study.suite), left_out(study), study.topic});
    for (const RunData& run : data->runs) {
      results.runs.push_back(run.record);
      results.timings.push_back(run.timing);
      append(results.errors, run.errors);
    }
    append(results.levels, data->levels);
    append(results.orders, data->orders);
    append(results.checks, data->checks);
    append(results.claims, data->claims);
    append(results.matrix, data->matrix);
    append(results.scores, data->scores);
    append(results.stability, data->stability);
    append(results.controls, data->controls);
    append(results.validation, data->validation);
    append(results.joint_validation, data->joint_validation);
    append(results.timings, data->stability_timings);
    append(results.time_steps, study.time_steps);
    append(results.pilots, study.pilots);
    append(results.timings, study.pilot_timings);
    append(results.figures, study.figures);
  }
  for (const auto& [place, chapter] : chapters) results.chapters.push_back(chapter);
  for (const auto& [place, headline] : headlines) results.headlines.push_back(headline);
  results.validation_bias = validation_bias(results.validation);
  append(results.figures, computed_measured_figures(results.validation_bias));
  std::ranges::stable_sort(results.claims, {}, place_in_paper);
  return results;
}

}  // namespace verification
