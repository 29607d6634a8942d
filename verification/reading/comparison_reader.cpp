#include "verification/reading/comparison_reader.hpp"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <stdexcept>

#include "reports/files/atomic_file.hpp"
#include "reports/files/content_hash.hpp"
#include "reports/files/csv.hpp"
#include "reports/files/io_error.hpp"
#include "verification/flows/grid_of_values.hpp"
#include "verification/runs/pilot/fits.hpp"

namespace verification {
namespace {

struct TableRow {
  double t = 0, x = 0, y = 0, u = 0, v = 0;
};

/// A reference that somebody computed or measured: values at points and times, interpolated in space alone.
class TableField final : public ComparisonTable {
 public:
  TableField(std::map<double, std::vector<GridOfValues::Row>> rows, std::string name, Interpolation rule)
      : name_(std::move(name)) {
    for (const auto& [t, points] : rows) {
      const auto same = [&points = points](int axis) {
        return std::ranges::all_of(points,
                                   [&](const auto& row) { return row.place[axis] == points[0].place[axis]; });
      };
      const bool along_y = same(0), along_x = same(1);
      grids_.emplace(t, GridOfValues(points, Vec2::Zero(), along_y ? 1 : 0, along_x || along_y, rule));
    }
  }
  [[nodiscard]] Vec2 velocity(const Vec2& x, double t, Location) const override {
    const GridOfValues* grid = grid_at(t);
    return grid ? grid->at(x) : Vec2::Constant(std::numeric_limits<double>::quiet_NaN());
  }
  [[nodiscard]] std::string description() const override { return name_; }
  [[nodiscard]] bool holds(double t) const override { return grid_at(t) != nullptr; }

 private:
  /// Of the time that is meant: within a millionth.
  [[nodiscard]] const GridOfValues* grid_at(double t) const {
    for (const auto& [time, grid] : grids_)
      if (std::abs(time - t) <= 1e-6 * std::abs(t)) return &grid;
    return nullptr;
  }
  std::map<double, GridOfValues> grids_;
  std::string name_;
};

void require_times(const TomlTable& root, const ComparisonTable& table, const PlannedRun& planned) {
  for (const double t : planned.scene.outputs)
    if (!table.holds(t))
      root.fail("compare_with",
                fmt::format("the table has no rows at t = {} s, an output of run {}", t, planned.run));
}

void read_table(TomlTable& root, const std::filesystem::path& file, Study& study) {
  TomlTable keys = root.table("compare_table");
  const std::string rule = keys.text("interpolation", "cubic");
  if (rule != "cubic" && rule != "linear") keys.fail("interpolation", "must be \"cubic\" or \"linear\"");
  study.table_uncertainty = keys.number("uncertainty");
  if (!(study.table_uncertainty >= 0))
    keys.fail("uncertainty", "must not be negative: relative to the velocity scale");
  keys.refuse_unknown_keys();
  using Row = TableRow;
  const auto columns = std::make_tuple(reports::column("t", &Row::t), reports::column("x", &Row::x),
                                       reports::column("y", &Row::y), reports::column("u", &Row::u),
                                       reports::column("v", &Row::v));
  try {
    std::map<double, std::vector<GridOfValues::Row>> rows;
    for (const Row& row : reports::read_csv(file, columns)) {
      if (!std::isfinite(row.t + row.x + row.y + row.u + row.v))
        root.fail("compare_with", "'" + file.string() + "' holds what is not finite");
      rows[row.t].push_back({{row.x, row.y}, {row.u, row.v}});
    }
    study.table = std::make_shared<const TableField>(
        std::move(rows), "the table " + file.filename().string() + ", " + rule + " between its points",
        rule == "linear" ? Interpolation::Linear : Interpolation::Cubic);
    study.table_content = reports::content_name(rule + reports::read_file(file));
  } catch (const reports::IoError& error) {
    root.fail("compare_with", error.what());
  } catch (const std::invalid_argument& error) {
    root.fail("compare_with", "'" + file.string() + "': " + error.what());
  }
}

}  // namespace

void read_comparison(TomlTable& root, const std::filesystem::path& study_file, Study& study) {
  const std::string comparison = root.text("compare_with", "exact");
  const std::pair<const char*, Comparison> known[] = {{"exact", Comparison::Exact},
                                                      {"discrete", Comparison::Discrete},
                                                      {"steady-nodes", Comparison::SteadyNodes},
                                                      {"ideal", Comparison::Ideal},
                                                      {"finest", Comparison::Finest}};
  for (const auto& [word, kind] : known)
    if (comparison == word) {
      study.comparison = kind;
      return;
    }
  if (!comparison.ends_with(".csv"))
    root.fail(
        "compare_with",
        "must be \"exact\", \"discrete\", \"steady-nodes\", \"ideal\", \"finest\" or the name of a table "
        "(CSV)");
  study.comparison = Comparison::Table;
  read_table(root, std::filesystem::absolute(study_file).parent_path() / comparison, study);
}

void require_comparable(const TomlTable& root, const Study& study) {
  if (study.comparison == Comparison::SteadyNodes)
    for (const PlannedRun& planned : study.runs)
      if (!planned.scene.flow->steady_nodes(planned.scene.discretisation))
        root.fail("compare_with",
                  "\"steady-nodes\" is known for Poiseuille flow only (run " + planned.run + ")");

  if (study.comparison == Comparison::Ideal)
    for (const PlannedRun& planned : study.runs)
      if (!planned.scene.flow->ideal())
        root.fail("compare_with", "\"ideal\" is for driven channels of a fluid with a yield stress (run " +
                                      planned.run + ")");

  if (study.comparison == Comparison::Table)
    for (const PlannedRun& planned : study.runs) require_times(root, *study.table, planned);
  if (study.comparison != Comparison::Discrete) return;
  for (const PlannedRun& planned : study.runs) {
    const SceneConfig& scene = planned.scene;
    const mpm::Scheme& scheme = scene.scheme;
    const bool papers_scheme =
        !scene.sph && !scene.incompressible && scheme.basis == mpm::Scheme::Basis::Linear &&
        scheme.transfer == mpm::Scheme::Transfer::Flip &&
        (scheme.stepping == mpm::Scheme::Stepping::Usf || scheme.stepping == mpm::Scheme::Stepping::Musl);
    const mpm::Seeding& seeding = scene.scene.seeding;
    const bool evenly = seeding.displacement == 0 && seeding.rule[0] == seeding.rule[1];
    if (!papers_scheme || !evenly || scene.time_step.dt == 0 ||
        !scene.flow->exact_discrete(scene.discretisation, scene.time_step.dt))
      root.fail("compare_with",
                "\"discrete\" is known for linear flip usf and musl channels, even seeding and a fixed dt "
                "only (run " +
                    planned.run + ")");
    for (const double t : scene.outputs)
      if (std::abs(t / scene.time_step.dt - std::round(t / scene.time_step.dt)) > 1e-6)
        root.fail("compare_with",
                  "\"discrete\" needs output times that are multiples of dt (run " + planned.run + ")");
  }
}

void require_decidable(const TomlTable& root, const Study& study) {
  if (study.comparison == Comparison::Finest &&
      (study.ladder.axis != Axis::Space || study.ladder.cells.size() < 3))
    root.fail("compare_with",
              "\"finest\" needs a ladder in space of three levels or more: orders come from differences");
  if (study.comparison == Comparison::Finest)
    for (const CheckSpec& check : study.checks)
      if (check.kind == "error" && check.level != "coarsest")
        for (const PlannedRun& run : study.runs)
          if (run.level + 1 == static_cast<int>(study.ladder.cells.size()) &&
              (check.level == "finest" || check.level == "all" || run.run.ends_with("." + check.level)))
            root.fail("check",
                      "an \"error\" of the finest level has nothing to be compared with: name another level");
  if (study.comparison != Comparison::Table) return;
  for (const CheckSpec& check : study.checks)
    if (check.kind == "error" && check.upper < study.table_uncertainty)
      root.fail("check",
                fmt::format("an error below {:g} cannot be shown by a table that is uncertain by {:g}",
                            check.upper, study.table_uncertainty));
}

void require_step_by_error(const Study& study, TomlTable scene, const Ladder& ladder, bool foreign) {
  if (!scene.table("time").is_text("dt")) return;
  const SceneConfig config = read_scene_config(scene.overlaid_with(TomlTable::from_text("", ""), ""),
                                               foreign ? SceneFor::Theirs : SceneFor::Ours);
  if (const std::string why = why_no_step_by_error(study, ladder, config, foreign); !why.empty())
    scene.fail("time.dt", why);
}

}  // namespace verification
