#pragma once

#include <limits>
#include <map>
#include <string>
#include <vector>

#include "reports/records/validation.hpp"
#include "verification/validation/measurements.hpp"
#include "verification/validation/validated_quantity.hpp"

namespace verification {

/// The largest model error that somebody bears in a quantity, in its unit (or the table's scale), and why.
struct BorneError {
  double largest = 0;
  std::string reason;
};

/// How tables are compared.
struct ComparisonRules {
  double coverage = 2;                      ///< k
  double velocity = 1, length = 1;          ///< V [m/s] and L [m] of scaled tables
  std::map<std::string, BorneError> bears;  ///< by quantity; every one of the tables has one
  /// Standard u_num, u_input relative to |S|, in place of a ladder and of runs that vary the inputs; NaN:
  /// from those.
  double stated_u_num = std::numeric_limits<double>::quiet_NaN();
  double stated_u_input = std::numeric_limits<double>::quiet_NaN();
};

/// The runs that a comparison rests on.
struct ComparedRuns {
  std::vector<RunFiles> levels;  ///< of one ladder, coarse to fine; S is the finest's
  std::vector<double> steps;     ///< refined quantity of each
  double formal_order = 2;
  std::vector<std::pair<RunFiles, RunFiles>>
      sensitivities;              ///< each input one standard deviation down and up
  std::vector<RunFiles> samples;  ///< of the inputs' joint distribution
};

/// What to do about a value that a run cannot deliver.
enum class Missing {
  Refuse,  ///< ConfigError with file, row and remedy
  Record   ///< NaN, which is inconclusive, with the reason in the note
};

struct TableComparison {
  std::vector<reports::ValidationRecord> points;
  std::vector<reports::JointValidationRecord> joint;  ///< one a quantity
};

/// Compares a run with a table, point by point and jointly.
///
/// u_num: half of the 95 % uncertainty by Eca & Hoekstra (four or more levels) or by the GCI of three, of the
/// same quantity at the same place; with fewer levels and nothing stated it is NaN, and the verdict
/// inconclusive. u_input: root of the sum of the squares of (S(X + u) - S(X - u))/2, or the standard
/// deviation over the samples. In the joint distance the errors of inputs and the shared part of the data's
/// are correlated, u_num is not.
TableComparison compare_table(const MeasurementTable& table, const ComparedRuns& runs,
                              const ComparisonRules& rules, Missing missing);

}  // namespace verification
