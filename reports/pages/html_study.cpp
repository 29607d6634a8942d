#include "reports/pages/html_study.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <set>

#include "reports/files/atomic_file.hpp"
#include "reports/pages/html_page.hpp"

namespace reports {
namespace {

std::string figure_element(const std::filesystem::path& dir, const ReportFigure& shown) {
  const Figure& figure = shown.figure;
  std::string image;
  if (shown.drawn) {
    image = fmt::format("<img alt=\"{}\" src=\"data:image/svg+xml;base64,{}\">",
                        html_text(figure.title + ". " + figure.caption),
                        base64(read_file(dir / "figures" / (figure.name + ".svg"))));
  } else {
    image = fmt::format("<p class=\"faint\">Not drawn: {}</p>",
                        figure.script.empty()
                            ? "there is nothing finite to draw."
                            : "see the warnings; the script is figures/" + html_text(figure.name) + ".gp.");
  }
  return fmt::format(
      "<figure>{}<figcaption><b>{}</b> {} <span class=\"faint\">({})</span></figcaption></figure>\n", image,
      html_text(figure.title), html_text(figure.caption), html_text(figure.name));
}

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

}  // namespace

std::string html_checks(const std::vector<const CheckRecord*>& checks, bool with_study) {
  std::string rows;
  for (const CheckRecord* check : checks) {
    const bool good = holds(*check);
    rows += fmt::format("<tr><td class=\"{}\">{}</td>", good ? "pass" : "fail", good ? "pass" : "FAIL");
    if (with_study) {
      rows +=
          fmt::format("<td><a href=\"#{}\">{}</a></td>", html_anchor(check->study), html_text(check->study));
    }
    rows += fmt::format(
        "<td class=\"w\">{}</td><td class=\"n\" data-label=\"observed\">{}</td>"
        "<td class=\"n\" data-label=\"bounds\">{}</td><td class=\"reason\" "
        "data-label=\"reason\">{}</td></tr>\n",
        html_text(check->check), html_text(with_unit(observed(*check), *check)),
        html_text(with_unit(bounds(*check), *check)), html_text(check->reason));
  }
  return html_table(std::string("<th>verdict</th>") + (with_study ? "<th>study</th>" : "") +
                        "<th>check</th><th class=\"n\">observed</th><th class=\"n\">bounds</th>"
                        "<th>reason for the bounds</th>",
                    rows, "cards");
}

std::string html_study(const std::filesystem::path& dir, const ReportData& data, const StudyRecord& study) {
  std::string section = fmt::format("<section>\n<h2 id=\"{}\">{}</h2>\n", html_anchor(study.study),
                                    html_text(study.title.empty() ? study.study : study.title));
  if (!study.claim.empty()) section += fmt::format("<p><b>Claim:</b> {}</p>\n", html_text(study.claim));
  if (!study.left_out.empty())
    section += fmt::format("<p class=\"faint\">Left out of the model: {}.</p>\n", html_text(study.left_out));
  section += fmt::format("<p class=\"faint\">Study <code>{}</code>{}</p>\n", html_text(study.study),
                         study.suite.empty() ? "" : ", suite " + html_text(study.suite));
  auto checks = checks_of(data.results, study.study);
  // Outcomes that hold stand in the scoreboard.
  const auto shown_above = std::erase_if(
      checks, [](const CheckRecord* check) { return check->unit == outcome_unit && holds(*check); });
  if (shown_above > 0)
    section +=
        fmt::format("<p>{} schemes ended as expected: see the <a href=\"#board-{}\">scoreboard</a>.</p>\n",
                    shown_above, html_anchor(study.study));
  if (!checks.empty()) section += "<h3>Checks</h3>\n" + html_checks(checks, false);
  for (const ReportFigure& figure : data.figures) {
    if (figure.figure.study == study.study) section += figure_element(dir, figure);
  }
  const auto tables = rate_tables(data.results, study.study);
  for (const char* axis : {"space", "time", "mach"}) {
    std::string text;
    for (const RateTable& table : tables) {
      if (table.axis == axis) text += rate_table(table);
    }
    if (text.empty()) continue;
    section += axis == std::string("space") ? "<h3>Errors and rates in space</h3>\n"
               : axis == std::string("mach")
                   ? "<h3>Errors and rates in the Mach number</h3>\n"
                   : "<h3>Differences to the next finer time step, and rates</h3>\n";
    section += text + "<p class=\"faint\">Levels in italics were left out of the fit.</p>\n";
  }
  const auto orders = orders_of(data.results, study.study);
  if (!orders.empty()) section += "<h3>Observed orders</h3>\n" + order_table(orders);
  return section + "</section>\n";
}

}  // namespace reports
