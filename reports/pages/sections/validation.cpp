#include "reports/pages/sections/validation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "reports/pages/html/page.hpp"

namespace reports {
namespace {

const char* const validation_scope =
    "A verdict speaks of these quantities at these places and times, within the inputs' stated "
    "uncertainties, at "
    "coverage k. \"Agrees\" means that no model error could be seen above k u_val: there may be one up to "
    "that size. "
    "\"Model error\" means that E stands out of the noise; the model, the inputs or the experiment's "
    "description is "
    "off by about E. Other flows, other fluids and the space between the measured points are not covered, "
    "and "
    "neither is an error that simulation and data share.";

/// Shares of the three parts in u_val^2, as a bar a tenth of a line high.
std::string parts_bar(const ValidationRecord& r) {
  if (!(r.u_val > 0)) return "";
  const double total = r.u_val * r.u_val;
  const auto share = [&](double u) { return std::isnan(u) ? 0.0 : 100 * u * u / total; };
  const double shares[] = {share(r.u_num), share(r.u_input), share(r.u_data)};
  const char* const colours[] = {"#E69F00", "#56B4E9", "#009E73"};
  std::string text = fmt::format(
      "<svg width=\"90\" height=\"10\" viewBox=\"0 0 100 10\" preserveAspectRatio=\"none\" role=\"img\" "
      "aria-label=\"numerics {:.0f} %, inputs {:.0f} %, data {:.0f} %\">",
      shares[0], shares[1], shares[2]);
  double at = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    text += fmt::format("<rect x=\"{:.2f}\" y=\"0\" width=\"{:.2f}\" height=\"10\" fill=\"{}\"/>", at,
                        shares[i], colours[i]);
    at += shares[i];
  }
  return text + "</svg>";
}

std::string coordinate(double value) {
  return std::isnan(value) ? "" : number(value);
}

std::string point_row(const ValidationRecord& r) {
  const bool predicted = r.verdict == prediction_verdict;
  return fmt::format(
      "<tr><td>{}</td><td class=\"n\">{}</td><td class=\"n\">{}</td><td class=\"n\">{}</td><td "
      "class=\"n\">{}</td>"
      "<td class=\"n\">{}</td><td class=\"n\">{} ± {}</td><td>{}</td><td class=\"n\">{}</td>"
      "<td class=\"{}\">{}</td><td class=\"w\">{}</td></tr>\n",
      html_text(r.quantity + (r.variant.empty() ? "" : ", " + r.variant)), coordinate(r.t), coordinate(r.x),
      coordinate(r.y), predicted ? "none" : number(r.measured), number(r.simulated),
      predicted ? number(r.simulated) : number(r.error, 3), number(r.coverage * r.u_val, 2), parts_bar(r),
      number(r.largest, 3), r.borne ? "pass" : "fail", html_text(r.verdict), html_text(r.note));
}

/// With the table's source where it is the first line on it, and its number afterwards.
std::string joint_line(const JointValidationRecord& joint, std::vector<std::string>& sources) {
  std::string text = fmt::format("<p><b>{}</b>{}: {} value{}", html_text(joint.quantity),
                                 html_text(joint.variant.empty() ? "" : ", " + joint.variant), joint.points,
                                 joint.points == 1 ? "" : "s");
  if (!std::isnan(joint.p_value))
    text += fmt::format("; together d² = {}, p = {}", number(joint.distance_squared, 3),
                        number(joint.p_value, 2));
  if (!std::isnan(joint.bias))
    text += fmt::format("; bias {}, scatter {}", number(joint.bias), number(joint.scatter, 2));
  const auto told = std::ranges::find(sources, joint.source);
  text += fmt::format(". <span class=\"faint\">[{}]", told - sources.begin() + 1);
  if (told != sources.end()) return text + "</span></p>\n";
  sources.push_back(joint.source);
  text += " " + html_text(joint.source);
  if (!joint.obtained.empty()) text += ". " + html_text(joint.obtained);
  if (!joint.licence.empty()) text += ". " + html_text(joint.licence);
  return text + "</span></p>\n";
}

}  // namespace

std::string html_validation(const Results& results, const Chapter& chapter, PageFigures& figures) {
  std::string text;
  for (const StudyRecord& study : chapter.studies) {
    std::string rows, tables;
    std::vector<std::string> sources;
    for (const JointValidationRecord& joint : results.joint_validation)
      if (joint.study == study.study) tables += joint_line(joint, sources);
    for (const ValidationRecord& r : results.validation)
      if (r.study == study.study) rows += point_row(r);
    if (rows.empty()) continue;
    text += "<h4>" + html_text(study.title) + "</h4>\n" + tables +
            html_table(
                "<th>quantity</th><th class=\"n\">t</th><th class=\"n\">x</th><th class=\"n\">y</th><th "
                "class=\"n\">measured D</th><th class=\"n\">simulated S</th><th class=\"n\">E = S − D, ± k "
                "u<sub>val"
                "</sub></th><th>parts of u<sub>val</sub></th><th "
                "class=\"n\">borne</th><th>verdict</th><th>note</th>",
                rows);
  }
  if (text.empty()) return "";
  for (const FigureRecord& figure : results.figures)
    if (figure.kind == "computed-measured") text += figures.shown(figure.figure);
  return "<section>\n<h3 id=\"validation\">Compared with measurements</h3>\n<p class=\"faint\">Bars: share "
         "of "
         "numerics (orange), inputs (blue) and data (green) in u<sub>val</sub>². A prediction has no E: S ± "
         "k u. "
         "Borne: the largest model error, or uncertainty of a prediction, that the study accepts.</p>\n" +
         text + "<p>" + html_text(validation_scope) + "</p>\n</section>\n";
}

}  // namespace reports
