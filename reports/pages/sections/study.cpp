#include "reports/pages/sections/study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include "reports/files/csv.hpp"
#include "reports/pages/html/page.hpp"
#include "reports/pages/sections/time_steps.hpp"
#include "reports/records/chapters.hpp"
#include "reports/summaries/scoreboard.hpp"
#include "reports/summaries/work_precision.hpp"

namespace reports {
namespace {

std::string rate_table(const RateTable& table) {
  std::string head = fmt::format("<th class=\"n\">{}</th>", step_symbol(table.axis));
  for (const double t : table.times) {
    head += fmt::format("<th class=\"n\">t = {} s</th><th class=\"n\">rate</th>", number(t));
  }
  std::string rows;
  for (const RateTable::Row& row : table.rows) {
    rows += fmt::format("<tr><td class=\"n\">{}</td>", number(row.step));
    for (std::size_t i = 0; i < row.errors.size(); ++i) {
      rows += fmt::format("<td class=\"n{}\">{}</td><td class=\"n\">{}</td>", row.used[i] ? "" : " out",
                          number(row.errors[i], 3), rate(row.rates[i]));
    }
    rows += "</tr>\n";
  }
  return fmt::format("<p>{}{}, norm {}</p>\n", table.variant.empty() ? "" : html_text(table.variant) + ", ",
                     html_text(table.location), html_text(norm_symbol(table.norm))) +
         html_table(head, rows);
}

std::string optional_number(double value) {
  return std::isnan(value) ? "-" : number(value, 3);
}

/// A dash for a count that a foreign solver did not give.
std::string optional_count(long value) {
  return value == unknown_count ? "-" : std::to_string(value);
}

std::string order_table(const std::vector<const OrderRecord*>& orders) {
  std::set<std::string> quantities;
  for (const OrderRecord* order : orders) {
    if (!std::isnan(order->gci) || !std::isnan(order->uncertainty)) quantities.insert(order->quantity);
  }
  const bool one_quantity = quantities.size() <= 1;
  std::string rows;
  for (const OrderRecord* order : orders) {
    std::string ladder = html_text(order->variant), pairwise;
    for (const std::string& part : {order->axis, order->location, norm_symbol(order->norm)}) {
      if (!part.empty()) ladder += (ladder.empty() ? "" : ", ") + html_text(part);
    }
    for (const std::string& part : split_list(order->pairwise)) {
      double value = 0;
      const auto [stop, error] = std::from_chars(part.data(), part.data() + part.size(), value);
      const bool is_number = error == std::errc() && stop == part.data() + part.size();
      pairwise += (pairwise.empty() ? "" : ", ") + (is_number ? rate(value) : html_text(part));
    }
    rows += fmt::format(
        "<tr><td>{}</td><td class=\"n\">{}</td><td class=\"n\">{}</td><td class=\"n\">{}</td><td>{}, {} of "
        "{}</td>"
        "<td class=\"n\">{}</td><td class=\"n\">{}</td><td class=\"n\">{}</td>{}</tr>\n",
        ladder, number(order->t), optional_number(order->theoretical), order_with_interval(*order),
        html_text(order->classification), order->levels_used, order->levels, pairwise,
        optional_number(order->gci) +
            (std::isnan(order->gci) ? "" : fmt::format(" ({})", optional_number(order->gci_safety_factor))),
        optional_number(order->uncertainty),
        one_quantity ? "" : "<td>" + html_text(order->quantity) + "</td>");
  }
  std::string note =
      "<p class=\"faint\">Class: how the levels behave, and how many of them were fitted. GCI: grid "
      "convergence index of the finest level with its safety factor; U95: its Eça-Hoekstra uncertainty";
  if (one_quantity && !quantities.empty()) note += ", both of the " + html_text(*quantities.begin());
  return html_table(
             std::string(
                 "<th>ladder</th><th class=\"n\">t [s]</th><th class=\"n\">theory</th>"
                 "<th class=\"n\">observed [95 %]</th><th>class</th><th class=\"n\">between levels</th>"
                 "<th class=\"n\">GCI (Fs)</th><th class=\"n\">U95</th>") +
                 (one_quantity ? "" : "<th>of</th>"),
             rows) +
         note + ".</p>\n";
}

/// Failures first, then what is demanded with the same bounds for the same reason together, in the order in
/// which each demand comes first.
std::vector<const CheckRecord*> by_demand(const std::vector<const CheckRecord*>& checks) {
  std::map<std::tuple<bool, std::string, std::string, std::string>, std::size_t> place;
  const auto demand = [](const CheckRecord* check) {
    return std::tuple{holds(*check), check->reason, bounds(*check), check->unit};
  };
  for (const CheckRecord* check : checks) place.emplace(demand(check), place.size());
  std::vector<const CheckRecord*> sorted = checks;
  std::ranges::stable_sort(sorted, {}, [&](const CheckRecord* check) {
    return std::pair{holds(*check), place.at(demand(check))};
  });
  return sorted;
}

}  // namespace

std::string html_checks(const std::vector<const CheckRecord*>& checks, bool with_study) {
  constexpr std::size_t most_passes = 36;  // a study; failures are all shown
  std::string rows;
  std::size_t passes = 0;
  const CheckRecord* before = nullptr;
  for (const CheckRecord* check : by_demand(checks)) {
    if (holds(*check) && ++passes > most_passes) continue;
    const bool good = holds(*check);
    const bool alike = before != nullptr && before->reason == check->reason && before->unit == check->unit &&
                       bounds(*before) == bounds(*check);
    if (!alike)
      rows += fmt::format(
          "<tr class=\"reason\"><th colspan=\"{}\" scope=\"rowgroup\"><b>{}</b>: {}</th></tr>\n",
          with_study ? 4 : 3, html_text(with_unit(bounds(*check), *check)), html_text(check->reason));
    before = check;
    rows += fmt::format("<tr><td class=\"{}\">{}</td>", good ? "pass" : "fail", good ? "pass" : "FAIL");
    if (with_study)
      rows +=
          fmt::format("<td><a href=\"#{}\">{}</a></td>", html_anchor(check->study), html_text(check->study));
    rows += fmt::format("<td class=\"w\">{}</td><td class=\"n\">{}</td></tr>\n", html_text(check->check),
                        html_text(with_unit(observed(*check), *check)));
  }
  return html_table(std::string("<th>verdict</th>") + (with_study ? "<th>study</th>" : "") +
                        "<th>check (bounds: their reason)</th><th class=\"n\">observed</th>",
                    rows) +
         (passes > most_passes ? fmt::format("<p class=\"faint\">{} more, which hold, in checks.csv.</p>\n",
                                             passes - most_passes)
                               : "");
}

std::string html_runs(const Results& results, const std::string& study) {
  constexpr std::size_t most_runs = 12;
  std::map<std::string, const TimingRecord*> timing_of;
  for (const TimingRecord& timing : results.timings) timing_of[timing.run] = &timing;
  std::string rows;
  std::size_t all = 0, shown = 0;
  for (const RunRecord& run : results.runs) {
    if (run.study != study) continue;
    ++all;
    if (completed(run) && shown >= most_runs) continue;
    ++shown;
    const auto timing = timing_of.find(run.run);
    const double wall = timing == timing_of.end() ? std::nan("") : timing->second->wall_s;
    const double speed =
        timing == timing_of.end() ? std::nan("") : timing->second->particle_steps_per_s / 1e6;
    const std::string name = run.run.starts_with(study + ".") ? run.run.substr(study.size() + 1) : run.run;
    rows += fmt::format(
        "<tr><td class=\"w\">{}</td><td>{}, {}</td><td>{}</td><td class=\"n\">{}</td><td "
        "class=\"n\">{}</td><td "
        "class=\"n\">{}</td><td class=\"n\">{}</td><td class=\"n\">{}</td><td class=\"n\">{}</td><td "
        "class=\"{}\">{}</td></tr>\n",
        html_text(name), html_text(run.scene), html_text(run.fluid),
        html_text(run.method + (run.basis == foreign_scheme ? "" : ": " + scheme_of(run))), run.cells,
        optional_count(run.particles), optional_number(run.dt), optional_count(run.steps),
        optional_number(wall), optional_number(speed),
        completed(run)                      ? "pass"
        : expected_to_diverge(results, run) ? "faint"
                                            : "fail",
        html_text(run.status));
  }
  if (rows.empty()) return "";
  return "<h4>Runs</h4>\n" +
         html_table(
             "<th>run</th><th>scene, fluid</th><th>method, scheme</th><th class=\"n\">cells</th><th "
             "class=\"n\">particles</th><th class=\"n\">dt [s]</th><th class=\"n\">steps</th><th "
             "class=\"n\">wall [s]</th><th class=\"n\">10⁶ particle-steps/s</th><th>status</th>",
             rows) +
         (all > shown ? fmt::format("<p class=\"faint\">{} more, completed, in runs.csv.</p>\n", all - shown)
                      : "");
}

namespace {

/// Rate tables with anything finite in them: a location that nobody sampled has no block of "nan".
std::string rates(const Results& results, const std::string& study) {
  constexpr std::size_t most_tables = 12;
  auto tables = rate_tables(results, study);
  std::erase_if(tables, [](const RateTable& table) {
    return std::ranges::none_of(table.rows, [](const RateTable::Row& row) {
      return std::ranges::any_of(row.errors, [](double e) { return std::isfinite(e); });
    });
  });
  const std::size_t left_out = tables.size() > most_tables ? tables.size() - most_tables : 0;
  tables.resize(tables.size() - left_out);
  std::string section;
  for (const char* axis : {"space", "time", "mach"}) {
    std::string text;
    for (const RateTable& table : tables)
      if (table.axis == axis) text += rate_table(table);
    if (text.empty()) continue;
    section += axis == std::string("space") ? "<h4>Errors and rates in space</h4>\n"
               : axis == std::string("mach")
                   ? "<h4>Errors and rates in the Mach number</h4>\n"
                   : "<h4>Differences to the next finer time step, and rates</h4>\n";
    section += text + "<p class=\"faint\">Levels in italics were left out of the fit.</p>\n";
  }
  if (left_out > 0)
    section += fmt::format("<p class=\"faint\">{} more tables in levels.csv.</p>\n", left_out);
  return section;
}

/// Orders of the L2 norm, or of what norm there is, as far as anything was fitted.
std::string orders(const Results& results, const std::string& study) {
  constexpr std::size_t most_orders = 30;
  auto list = orders_of(results, study);
  std::erase_if(
      list, [](const OrderRecord* order) { return std::isnan(order->observed) && std::isnan(order->gci); });
  const bool has_l2 = std::ranges::any_of(list, [](const OrderRecord* order) { return order->norm == "l2"; });
  const std::size_t all = list.size();
  if (has_l2) std::erase_if(list, [](const OrderRecord* order) { return order->norm != "l2"; });
  if (list.size() > most_orders) list.resize(most_orders);
  if (list.empty()) return "";
  return "<h4>Observed orders</h4>\n" + order_table(list) +
         (all > list.size()
              ? fmt::format("<p class=\"faint\">{} more, of other norms too, in orders.csv.</p>\n",
                            all - list.size())
              : "");
}

}  // namespace

std::string html_study(const ReportData& data, const StudyRecord& study, const std::string& topic,
                       PageFigures& figures, Medium medium) {
  const Results& results = data.results;
  auto checks = checks_of(results, study.study);
  const auto held = static_cast<std::size_t>(
      std::ranges::count_if(checks, [](const CheckRecord* check) { return holds(*check); }));
  const bool good = !checks.empty() && held == checks.size();
  std::string schemes;
  for (const std::string& word : schemes_of(results, study.study))
    schemes += (schemes.empty() ? "" : " ") + html_token(word);
  std::string text = fmt::format(
      "<section class=\"study {0}\" id=\"{1}\" data-status=\"{0}\" data-topic=\"{2}\" data-scheme=\"{3}\">\n"
      "<h3>{4}<a class=\"link\" href=\"#{1}\" aria-label=\"Link to this study\">#</a></h3>\n",
      good ? "pass" : "fail", html_anchor(study.study), html_token(topic), schemes,
      html_text(study.title.empty() ? study.study : study.title));
  if (!study.claim.empty()) text += "<p>" + html_text(study.claim) + "</p>\n";
  text +=
      fmt::format("<p class=\"faint\"><b class=\"{}\">{} of {} checks hold</b>; study <code>{}</code>{}{}",
                  good ? "pass" : "fail", held, checks.size(), html_text(study.study),
                  study.suite.empty() ? "" : ", suite " + html_text(study.suite),
                  study.left_out.empty() ? "" : "; left out of the model: " + html_text(study.left_out));
  const auto failed_end = std::ranges::find_if(
      checks, [](const CheckRecord* check) { return holds(*check); });  // failures stand first
  const std::vector<const CheckRecord*> failed(checks.begin(), failed_end);
  text += ".</p>\n" + (failed.empty() ? "" : html_checks(failed, false));

  std::string drawn;
  const std::vector<std::string> names = figures.of_study(study.study);
  for (const std::string& name : names) drawn += figures.shown(name);
  if (medium == Medium::Paper) return text + drawn + "</section>\n";

  checks.erase(checks.begin(), checks.begin() + static_cast<std::ptrdiff_t>(failed.size()));
  // Outcomes that hold stand in the scoreboard.
  const auto in_scoreboard =
      std::erase_if(checks, [](const CheckRecord* check) { return check->unit == outcome_unit; });
  std::string details = drawn;
  if (in_scoreboard > 0)
    details +=
        fmt::format("<p>{} schemes ended as expected: see the <a href=\"#board-{}\">scoreboard</a>.</p>\n",
                    in_scoreboard, html_anchor(study.study));
  if (!checks.empty()) details += "<h4>Checks that hold</h4>\n" + html_checks(checks, false);
  details += rates(results, study.study) + orders(results, study.study) + html_runs(results, study.study) +
             html_time_steps(results, study.study);
  if (details.empty()) return text + "</section>\n";
  return text +
         fmt::format("<details{}><summary>{}checks, errors, orders, runs</summary>\n", good ? "" : " open",
                     names.empty()       ? ""
                     : names.size() == 1 ? "Figure, "
                                         : fmt::format("{} figures, ", names.size())) +
         details + "</details>\n</section>\n";
}

}  // namespace reports
