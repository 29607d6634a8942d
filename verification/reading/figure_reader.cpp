#include "verification/reading/figure_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace verification {
namespace {

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ";") + word;
  return text;
}

void read_name(TomlTable& table, const Study& study, reports::FigureRecord& figure) {
  figure.figure = study.name + "-" + table.text("name", figure.kind);
  if (std::ranges::any_of(study.figures, [&](const auto& other) { return other.figure == figure.figure; }))
    table.fail("name", "a second figure of this kind needs a name of its own");
}

/// Schemes, waves and motions of a map.
void read_map(TomlTable& table, const Study& study, reports::FigureRecord& figure) {
  if (study.stability.cases.empty()) table.fail("kind", "\"stability-map\" needs a [stability]");
  figure.across = table.text("waves");
  const auto motions = table.texts("motions");
  const auto variants = table.has("variants") ? table.texts("variants") : study.variants;
  for (const std::string& motion : motions)
    for (const std::string& variant : variants)
      if (std::ranges::none_of(study.stability.cases, [&](const StabilityCase& one) {
            return one.name() == variant + "." + figure.across + "." + motion;
          }))
        table.fail("variants", "no limit of '" + variant + "' with these waves and motions is measured");
  figure.runs = joined(variants);
  figure.location = joined(motions);
}

/// The whole plane of meshes and regularisations, and the variant that is a path through it.
void read_plane(TomlTable& table, const Study& study, reports::FigureRecord& figure) {
  const std::string path = table.text("path");
  if (std::ranges::count(study.variants, path) == 0)
    table.fail("path", "'" + path + "' is no variant of this study");
  std::vector<std::string> runs, labels, on_path;
  for (const PlannedRun& run : study.runs) {
    const auto* curve = run.scene.fluid.curve.yielding();
    if (!curve) table.fail("kind", "is for fluids with a yield stress");
    runs.push_back(run.run);
    labels.push_back(fmt::format("{:.9g}", curve->m));
    if (run.variant == path) on_path.push_back(run.run);
  }
  figure.runs = joined(runs);
  figure.labels = joined(labels);
  figure.across = joined(on_path);
  figure.norm = table.text("norm", "l2");
  figure.location = "grid";
}

/// Runs of boxes, finest levels.
void read_yielded(TomlTable& table, const Study& study, reports::FigureRecord& figure) {
  const auto variants = table.has("variants") ? table.texts("variants") : study.variants;
  std::vector<std::string> runs, rates;
  figure.t = table.number("t");
  for (const std::string& variant : variants) {
    const auto ladder = study.runs_of(variant);
    if (ladder.empty()) table.fail("variants", "'" + variant + "' is no variant of this study");
    const SceneConfig& scene = ladder.back()->scene;
    const auto* curve = scene.fluid.curve.yielding();
    if (!curve || scene.flow->tabulated_points().empty())
      table.fail("kind", "is for cavities of fluids with a yield stress");
    if (std::ranges::count(scene.outputs, figure.t) == 0) table.fail("t", "is no output time of the study");
    runs.push_back(ladder.back()->run);
    rates.push_back(fmt::format("{:.9g}", scene.fluid.curve.rate(curve->tau_y)));
  }
  figure.runs = joined(runs);
  figure.labels = table.has("labels") ? joined(table.texts("labels")) : joined(variants);
  figure.component = joined(rates);
  figure.location = "grid";
}

}  // namespace

Record record_of_figure(const std::string& kind) {
  if (kind == "history" || kind == "energy") return Record::History;
  if (kind == "shear-rate" || kind == "viscosity") return Record::Shear;
  return kind == "pressure" || kind == "occupancy" ? Record::State : Record::Profile;
}

reports::FigureRecord read_figure(TomlTable& table, const Study& study) {
  reports::FigureRecord figure;
  figure.study = study.name;
  figure.kind = table.text("kind");
  static const std::vector<std::string> kinds = {
      "profiles",  "history",  "energy",        "convergence", "work-precision", "shear-rate",
      "viscosity", "pressure", "stability-map", "yielded",     "regularisation", "occupancy"};
  if (std::ranges::count(kinds, figure.kind) == 0) table.fail("kind", "must be one of: " + joined(kinds));
  figure.title = table.text("title");
  if (figure.kind == "stability-map") {
    read_map(table, study, figure);
    read_name(table, study, figure);
    table.refuse_unknown_keys();
    return figure;
  }
  if (study.runs.empty()) table.fail("kind", "needs runs, and a study with [stability] has none");
  if (figure.kind == "regularisation" || figure.kind == "yielded") {
    (figure.kind == "yielded" ? read_yielded : read_plane)(table, study, figure);
    read_name(table, study, figure);
    table.refuse_unknown_keys();
    return figure;
  }
  figure.norm = table.text("norm", "l2");
  if (figure.norm != "l1" && figure.norm != "l2" && figure.norm != "linf")
    table.fail("norm", "must be \"l1\", \"l2\" or \"linf\"");
  figure.location = table.text("location", figure.kind == "profiles" ? "grid" : "grid;particles");
  if (figure.location != "grid" && figure.location != "particles" && figure.location != "grid;particles")
    table.fail("location", "must be \"grid\", \"particles\" or \"grid;particles\"");

  const std::vector<std::string> variants = table.has("variants") ? table.texts("variants") : study.variants;
  std::vector<std::string> runs;
  const PlannedRun* last = nullptr;
  for (const std::string& variant : variants) {
    const auto ladder = study.runs_of(variant);
    if (ladder.empty()) table.fail("variants", "'" + variant + "' is no variant of this study");
    last = ladder.back();
    runs.push_back(last->run);
  }
  const bool shear = figure.kind == "shear-rate" || figure.kind == "viscosity";
  const bool pressure = figure.kind == "pressure";
  if (shear || pressure) {
    figure.t = table.number("t");
    if (std::ranges::count(last->scene.outputs, figure.t) == 0)
      table.fail("t", "is no output time of the study");
    if (pressure && !std::isfinite(last->scene.flow->pressure_scale()))
      table.fail("kind", "is for flows with an exact pressure");
    if (shear && !last->scene.flow->has_shear_profile()) table.fail("kind", "is for channels");
  }
  const bool occupancy = figure.kind == "occupancy";
  if (occupancy && !last->scene.incompressible)
    table.fail("kind", "is for the incompressible method, whose runs record it");
  if (shear || pressure || occupancy || figure.kind == "profiles" || figure.kind == "history" ||
      figure.kind == "energy") {
    if (figure.kind == "profiles" && runs.size() > 1 && !table.has("variants"))
      table.fail("variants", "say which to show: several in one figure are told apart by colour");
    figure.runs = joined(runs);
    figure.labels = table.has("labels") ? joined(table.texts("labels")) : joined(variants);
    figure.across = last->scene.flow->across() == 0 ? "x" : "y";
    figure.component = last->scene.flow->probe().direction.x() != 0 ? "u" : "v";
  }
  if (figure.kind == "convergence" && table.has("variants")) figure.labels = joined(variants);
  if (figure.kind == "work-precision") {
    // A curve a scheme, or a curve a label: those of one scheme are told apart by it.
    const std::vector<std::string> labels =
        table.has("labels") ? table.texts("labels") : std::vector<std::string>();
    if (!labels.empty() && labels.size() != variants.size())
      table.fail("labels", "must be as many as the variants that it shows, one for each");
    if (table.has("variants") || !labels.empty()) {
      runs.clear();
      std::vector<std::string> label_of;
      for (std::size_t v = 0; v < variants.size(); ++v)
        for (const PlannedRun* run : study.runs_of(variants[v])) {
          runs.push_back(run->run);
          if (!labels.empty()) label_of.push_back(labels[v]);
        }
      figure.runs = joined(runs);
      figure.labels = joined(label_of);
    }
    figure.across = table.text("cost", "wall");
    if (figure.across != "wall" && figure.across != "particle-steps")
      table.fail("cost", "must be \"wall\" or \"particle-steps\"");
  }
  read_name(table, study, figure);
  table.refuse_unknown_keys();
  return figure;
}

}  // namespace verification
