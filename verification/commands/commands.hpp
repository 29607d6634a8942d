#pragma once

#include <filesystem>
#include <limits>
#include <string>
#include <vector>

// The verbs of mpm-verify. Each returns the exit code: 0 all checks pass, 1 a check failed, 3 a solver error.
// Mistakes of the user are thrown (ConfigError, reports::IoError) and become exit code 2 in main.
namespace verification {

struct ListOptions {
  std::filesystem::path studies;
  std::string suite = "deep";
  bool names = false;  ///< nothing but names, for scripts and completion
};
int list_command(const ListOptions& options);

struct ExplainOptions {
  std::filesystem::path studies;
  std::string study;  ///< name, or path of a study file
};
/// Prints what a study runs, what it checks and why those bounds, and what it costs.
int explain_command(const ExplainOptions& options);

struct SchemaOptions {
  bool scene = false;     ///< of a scene file, not of a study
  bool markdown = false;  ///< the page of all keys instead
};
/// Prints the JSON Schema of studies, for editors.
int schema_command(const SchemaOptions& options);

struct RunOptions {
  std::filesystem::path studies;
  std::vector<std::string> names;  ///< of studies, or paths of study files; empty: the suite
  std::string suite;               ///< "": full, or all that is named
  std::filesystem::path out = "results";
  int jobs = 0;                ///< 0: as many as there are cores
  bool no_cache = false;       ///< leave the cache of finished runs alone
  bool plain = false;          ///< judge negative controls as if they were none
  bool fresh = false;          ///< run everything, and replace what the cache holds
  bool force = false;          ///< `out` may hold files that are not ours
  bool resume = false;         ///< `out` must hold a suite that was begun
  bool pdf = false;            ///< print the report too
  bool keep_profiles = false;  ///< of every run, drawn or not
  std::string shard;           ///< "K/N": that part of the suite alone, kept in `out` for `collect`
  std::string command_line;
};
int run_command(const RunOptions& options);
/// run_command() with a shard: its runs are kept below `out`, and nothing is judged.
int shard_command(const RunOptions& options);

struct SceneOptions {
  std::filesystem::path scene, out;
  bool force = false;       ///< `out` may hold files that are not ours
  bool no_figures = false;  ///< solve: leave the drawing to a later `report`
  std::string command_line;
};
int solve_command(const SceneOptions& options);
int reference_command(const SceneOptions& options);

struct CavityTablesOptions {
  std::filesystem::path out;
  std::vector<std::string> fluids;  ///< names; empty: all
  bool force = false;               ///< `out` may hold files that are not ours
  std::string command_line;
};
/// Computes the tables of verification/studies/cavity anew: a file a fluid, and one of extrema.
int cavity_tables_command(const CavityTablesOptions& options);

struct CavityProfileOptions {
  std::filesystem::path scene, out;
  bool volumes = false;  ///< by finite volumes, not by splines
};
/// The steady cavity of a scene with one of the tables' fluids, on a mesh of its cells, as somebody else's
/// solver would hand it in: profile.csv in the directory `out`.
int cavity_profile_command(const CavityProfileOptions& options);

/// How many simulations or figures are made at the same time: `asked`, or as many as there are cores for 0.
int job_count(int asked);

struct CompareOptions {
  std::filesystem::path before, after;
  double tolerance = 1e-9;  ///< relative change of errors and orders that is round-off
  bool all = false;         ///< list every change
};
/// 0: nothing got worse beyond noise; 1: something did.
int compare_command(const CompareOptions& options);

struct ValidateOptions {
  std::filesystem::path data, result, out;
  std::string quantity;           ///< of the table; empty: the only one
  std::vector<std::string> runs;  ///< of a result directory, coarse to fine; empty: profile.csv
  double largest_error = 0;       ///< model error that is borne, in the unit of the table
  double coverage = 2, velocity = 0, length = 0, formal_order = 2;
  /// Standard uncertainties relative to |S|; NaN: from the ladder.
  double u_num = std::numeric_limits<double>::quiet_NaN();
  double u_input = std::numeric_limits<double>::quiet_NaN();
  std::string command_line;
};
/// 0: every value is borne; 1: a model error that is not, or an inconclusive comparison.
int validate_command(const ValidateOptions& options);

struct ReportCommandOptions {
  std::filesystem::path dir;
  bool pdf = false;  ///< print it too
};
int report_command(const ReportCommandOptions& options);

}  // namespace verification
