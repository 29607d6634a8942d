#include "reports/records/directory/result_files.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "reports/files/csv.hpp"
#include "reports/files/io_error.hpp"
#include "reports/records/directory/time_step_files.hpp"
#include "reports/records/directory/validation_files.hpp"

namespace reports {
namespace {

// The order here is the order of the columns in the files. A new field of a record is one line.
constexpr auto study_columns = std::make_tuple(  //
    column("study", &StudyRecord::study),        //
    column("title", &StudyRecord::title),        //
    column("claim", &StudyRecord::claim),        //
    column("suite", &StudyRecord::suite),        //
    column("left_out", &StudyRecord::left_out),  //
    column("topic", &StudyRecord::topic));

constexpr auto chapter_columns = std::make_tuple(    //
    column("topic", &ChapterRecord::topic),          //
    column("title", &ChapterRecord::title),          //
    column("paragraph", &ChapterRecord::paragraph),  //
    column("figure", &ChapterRecord::figure));

constexpr auto headline_columns = std::make_tuple(  //
    column("title", &HeadlineRecord::title),        //
    column("study", &HeadlineRecord::study),        //
    column("check", &HeadlineRecord::check),        //
    column("figure", &HeadlineRecord::figure));

constexpr auto change_columns = std::make_tuple(  //
    column("file", &ChangeRecord::file),          //
    column("verdict", &ChangeRecord::verdict),    //
    column("name", &ChangeRecord::name),          //
    column("before", &ChangeRecord::before),      //
    column("after", &ChangeRecord::after),        //
    column("unit", &ChangeRecord::unit),          //
    column("note", &ChangeRecord::note));

constexpr auto run_columns = std::make_tuple(    //
    column("run", &RunRecord::run),              //
    column("study", &RunRecord::study),          //
    column("scene", &RunRecord::scene),          //
    column("fluid", &RunRecord::fluid),          //
    column("method", &RunRecord::method),        //
    column("basis", &RunRecord::basis),          //
    column("transfer", &RunRecord::transfer),    //
    column("stepping", &RunRecord::stepping),    //
    column("reset", &RunRecord::reset),          //
    column("cells", &RunRecord::cells),          //
    column("particles", &RunRecord::particles),  //
    column("dt", &RunRecord::dt),                //
    column("steps", &RunRecord::steps),          //
    column("status", &RunRecord::status));

constexpr auto error_columns = std::make_tuple(  //
    column("run", &ErrorRecord::run),            //
    column("t", &ErrorRecord::t),                //
    column("location", &ErrorRecord::location),  //
    column("l1", &ErrorRecord::l1),              //
    column("l2", &ErrorRecord::l2),              //
    column("linf", &ErrorRecord::linf),          //
    column("scale", &ErrorRecord::scale),        //
    column("exact_max", &ErrorRecord::exact_max));

constexpr auto control_columns = std::make_tuple(    //
    column("study", &ControlRecord::study),          //
    column("planted", &ControlRecord::planted),      //
    column("must_fail", &ControlRecord::must_fail),  //
    column("said", &ControlRecord::said),            //
    column("exit_code", &ControlRecord::exit_code),  //
    column("results", &ControlRecord::results),      //
    column("seen", &ControlRecord::seen));

constexpr auto level_columns = std::make_tuple(  //
    column("study", &LevelRecord::study),        //
    column("variant", &LevelRecord::variant),    //
    column("axis", &LevelRecord::axis),          //
    column("location", &LevelRecord::location),  //
    column("norm", &LevelRecord::norm),          //
    column("t", &LevelRecord::t),                //
    column("step", &LevelRecord::step),          //
    column("value", &LevelRecord::value),        //
    column("used", &LevelRecord::used));

constexpr auto order_columns = std::make_tuple(                    //
    column("study", &OrderRecord::study),                          //
    column("variant", &OrderRecord::variant),                      //
    column("axis", &OrderRecord::axis),                            //
    column("location", &OrderRecord::location),                    //
    column("norm", &OrderRecord::norm),                            //
    column("t", &OrderRecord::t),                                  //
    column("theoretical", &OrderRecord::theoretical),              //
    column("observed", &OrderRecord::observed),                    //
    column("ci_lower", &OrderRecord::ci_lower),                    //
    column("ci_upper", &OrderRecord::ci_upper),                    //
    column("levels_used", &OrderRecord::levels_used),              //
    column("levels", &OrderRecord::levels),                        //
    column("classification", &OrderRecord::classification),        //
    column("pairwise", &OrderRecord::pairwise),                    //
    column("gci", &OrderRecord::gci),                              //
    column("gci_safety_factor", &OrderRecord::gci_safety_factor),  //
    column("uncertainty", &OrderRecord::uncertainty),              //
    column("quantity", &OrderRecord::quantity));

constexpr auto check_columns = std::make_tuple(  //
    column("study", &CheckRecord::study),        //
    column("check", &CheckRecord::check),        //
    column("observed", &CheckRecord::observed),  //
    column("lower", &CheckRecord::lower),        //
    column("upper", &CheckRecord::upper),        //
    column("unit", &CheckRecord::unit),          //
    column("verdict", &CheckRecord::verdict),    //
    column("reason", &CheckRecord::reason));

constexpr auto timing_columns = std::make_tuple(                          //
    column("run", &TimingRecord::run),                                    //
    column("wall_s", &TimingRecord::wall_s),                              //
    column("particle_steps_per_s", &TimingRecord::particle_steps_per_s),  //
    column("repetitions", &TimingRecord::repetitions),                    //
    column("spread", &TimingRecord::spread),                              //
    column("source", &TimingRecord::source),                              //
    column("clock", &TimingRecord::clock));

constexpr auto figure_columns = std::make_tuple(    //
    column("figure", &FigureRecord::figure),        //
    column("study", &FigureRecord::study),          //
    column("kind", &FigureRecord::kind),            //
    column("title", &FigureRecord::title),          //
    column("runs", &FigureRecord::runs),            //
    column("labels", &FigureRecord::labels),        //
    column("across", &FigureRecord::across),        //
    column("component", &FigureRecord::component),  //
    column("location", &FigureRecord::location),    //
    column("norm", &FigureRecord::norm),            //
    column("t", &FigureRecord::t));

constexpr auto claim_columns = std::make_tuple(    //
    column("claim", &ClaimRecord::claim),          //
    column("study", &ClaimRecord::study),          //
    column("source", &ClaimRecord::source),        //
    column("statement", &ClaimRecord::statement),  //
    column("verdict", &ClaimRecord::verdict),      //
    column("measured", &ClaimRecord::measured),    //
    column("note", &ClaimRecord::note),            //
    column("stands", &ClaimRecord::stands));

constexpr auto matrix_columns = std::make_tuple(              //
    column("basis", &MatrixRecord::basis),                    //
    column("transfer", &MatrixRecord::transfer),              //
    column("stepping", &MatrixRecord::stepping),              //
    column("scene", &MatrixRecord::scene),                    //
    column("axis", &MatrixRecord::axis),                      //
    column("location", &MatrixRecord::location),              //
    column("theoretical", &MatrixRecord::theoretical),        //
    column("observed", &MatrixRecord::observed),              //
    column("ci_lower", &MatrixRecord::ci_lower),              //
    column("ci_upper", &MatrixRecord::ci_upper),              //
    column("smallest_error", &MatrixRecord::smallest_error),  //
    column("verdict", &MatrixRecord::verdict),                //
    column("reason", &MatrixRecord::reason));

constexpr auto score_columns = std::make_tuple(              //
    column("study", &ScoreRecord::study),                    //
    column("case", &ScoreRecord::hard_case),                 //
    column("scheme", &ScoreRecord::scheme),                  //
    column("basis", &ScoreRecord::basis),                    //
    column("transfer", &ScoreRecord::transfer),              //
    column("stepping", &ScoreRecord::stepping),              //
    column("outcome", &ScoreRecord::outcome),                //
    column("expected", &ScoreRecord::expected),              //
    column("verdict", &ScoreRecord::verdict),                //
    column("t_diverged", &ScoreRecord::t_diverged),          //
    column("error", &ScoreRecord::error),                    //
    column("energy_ratio", &ScoreRecord::energy_ratio),      //
    column("degraded_above", &ScoreRecord::degraded_above),  //
    column("energy_lower", &ScoreRecord::energy_lower),      //
    column("energy_upper", &ScoreRecord::energy_upper),      //
    column("location", &ScoreRecord::location),              //
    column("status", &ScoreRecord::status),                  //
    column("reason", &ScoreRecord::reason),                  //
    column("thresholds", &ScoreRecord::thresholds));

constexpr auto stability_columns = std::make_tuple(            //
    column("study", &StabilityRecord::study),                  //
    column("basis", &StabilityRecord::basis),                  //
    column("transfer", &StabilityRecord::transfer),            //
    column("stepping", &StabilityRecord::stepping),            //
    column("waves", &StabilityRecord::waves),                  //
    column("motion", &StabilityRecord::motion),                //
    column("lattice", &StabilityRecord::lattice),              //
    column("kind", &StabilityRecord::kind),                    //
    column("r_predicted", &StabilityRecord::r_predicted),      //
    column("cfl_predicted", &StabilityRecord::cfl_predicted),  //
    column("r_measured", &StabilityRecord::r_measured),        //
    column("cfl_measured", &StabilityRecord::cfl_measured),    //
    column("r_tested", &StabilityRecord::r_tested),            //
    column("cfl_tested", &StabilityRecord::cfl_tested),        //
    column("theta_x", &StabilityRecord::theta_x),              //
    column("theta_y", &StabilityRecord::theta_y),              //
    column("offset_x", &StabilityRecord::offset_x),            //
    column("offset_y", &StabilityRecord::offset_y),            //
    column("steps", &StabilityRecord::steps),                  //
    column("crossing", &StabilityRecord::crossing));

void require_plain_names(const Results& results) {
  for (const RunRecord& run : results.runs) require_plain_name("run", run.run);
  for (const FigureRecord& figure : results.figures) require_plain_name("figure", figure.figure);
}

}  // namespace

bool is_plain_name(const std::string& name) {
  const auto plain = [](unsigned char c) {
    return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '.' ||
           c == '_' || c == '=' || c == '-';
  };
  const bool other_file = name.ends_with(".history") || name.ends_with(".shear") ||
                          name.ends_with(".state") || name.ends_with(".surface");
  // A file name may have 255 bytes; the ending and the temporary file's number need some of them.
  return !name.empty() && name.size() <= 200 && name.front() != '.' && name.front() != '-' && !other_file &&
         std::all_of(name.begin(), name.end(), plain);
}

const std::string& require_plain_name(const char* what, const std::string& name) {
  if (is_plain_name(name)) return name;
  throw IoError(
      fmt::format("{} name '{}' cannot be a file name; use up to 200 letters, digits and . _ = -, no "
                  "leading dot or dash, no '.history', '.shear', '.state' or '.surface' at the end",
                  what, name));
}

Results read_results(const std::filesystem::path& dir) {
  Results results;
  results.studies = read_csv(dir / "studies.csv", study_columns);
  results.chapters = read_chapters(dir / "chapters.csv");
  results.headlines = read_headlines(dir / "headlines.csv");
  results.runs = read_csv(dir / "runs.csv", run_columns);
  results.errors = read_csv(dir / "errors.csv", error_columns);
  results.levels = read_csv(dir / "levels.csv", level_columns);
  results.orders = read_csv(dir / "orders.csv", order_columns);
  results.checks = read_csv(dir / "checks.csv", check_columns);
  results.timings = read_csv(dir / "timing.csv", timing_columns);
  results.figures = read_csv(dir / "figures.csv", figure_columns);
  results.claims = read_csv(dir / "claims.csv", claim_columns);
  results.matrix = read_csv(dir / "matrix.csv", matrix_columns);
  results.scores = read_csv(dir / "scoreboard.csv", score_columns);
  results.stability = read_csv(dir / "stability.csv", stability_columns);
  if (std::filesystem::exists(dir / "controls.csv"))
    results.controls = read_csv(dir / "controls.csv", control_columns);
  read_time_steps(dir, results);
  read_validation(dir, results);
  require_plain_names(results);
  return results;
}

std::vector<ChapterRecord> read_chapters(const std::filesystem::path& file) {
  return read_csv(file, chapter_columns);
}

std::vector<HeadlineRecord> read_headlines(const std::filesystem::path& file) {
  return read_csv(file, headline_columns);
}

std::optional<std::vector<ChangeRecord>> read_changes(const std::filesystem::path& dir) {
  if (!std::filesystem::exists(dir / "changes.csv")) return std::nullopt;
  return read_csv(dir / "changes.csv", change_columns);
}

void write_changes(const std::filesystem::path& dir, const std::vector<ChangeRecord>& changes) {
  write_csv(dir / "changes.csv", change_columns, changes);
}

void write_results(const std::filesystem::path& dir, const Results& results, Durability durability) {
  require_plain_names(results);
  ensure_directory(dir);
  write_csv(dir / "studies.csv", study_columns, results.studies, durability);
  write_csv(dir / "chapters.csv", chapter_columns, results.chapters, durability);
  write_csv(dir / "headlines.csv", headline_columns, results.headlines, durability);
  write_csv(dir / "runs.csv", run_columns, results.runs, durability);
  write_csv(dir / "errors.csv", error_columns, results.errors, durability);
  write_csv(dir / "levels.csv", level_columns, results.levels, durability);
  write_csv(dir / "orders.csv", order_columns, results.orders, durability);
  write_csv(dir / "checks.csv", check_columns, results.checks, durability);
  write_csv(dir / "timing.csv", timing_columns, results.timings, durability);
  write_csv(dir / "figures.csv", figure_columns, results.figures, durability);
  write_csv(dir / "claims.csv", claim_columns, results.claims, durability);
  write_csv(dir / "matrix.csv", matrix_columns, results.matrix, durability);
  write_csv(dir / "scoreboard.csv", score_columns, results.scores, durability);
  write_csv(dir / "stability.csv", stability_columns, results.stability, durability);
  if (!results.controls.empty())
    write_csv(dir / "controls.csv", control_columns, results.controls, durability);
  write_time_steps(dir, results, durability);
  write_validation(dir, results, durability);
}

void remove_tables(const std::filesystem::path& dir) {
  std::error_code ignored;
  // checks.csv goes first: without it nobody takes what is left for a result.
  for (const char* name :
       {"checks.csv",   "report.html",    "report.pdf",           "report.md",           "summary.md",
        "junit.xml",    "studies.csv",    "chapters.csv",         "headlines.csv",       "changes.csv",
        "runs.csv",     "errors.csv",     "levels.csv",           "orders.csv",          "timing.csv",
        "figures.csv",  "claims.csv",     "matrix.csv",           "scoreboard.csv",      "stability.csv",
        "controls.csv", "validation.csv", "validation-joint.csv", "validation-bias.csv", "time-steps.csv",
        "pilots.csv"})
    std::filesystem::remove(dir / name, ignored);
  for (const char* part : {".", "profiles", "scenes", "figures"})
    if (!std::filesystem::is_symlink(dir / part, ignored))
      for (const auto& entry : std::filesystem::directory_iterator(dir / part, ignored))
        if (is_temporary(entry.path())) std::filesystem::remove(entry.path(), ignored);
}

}  // namespace reports
