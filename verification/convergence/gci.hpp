#pragma once

#include <vector>

#include "verification/convergence/order.hpp"

namespace verification {

/// Which safety factor and which order the grid convergence index (GCI) uses.
enum class SafetyRule {
  /// Celik, Ghia, Roache, Freitas, Coleman, Raad, J. Fluids Eng. 130 (2008) 078001: Fs = 1.25 with the
  /// observed
  /// order, for monotone and oscillatory ladders alike. For comparison with published tables.
  Celik2008,
  /// Oberkampf & Roy, Verification and Validation in Scientific Computing (2010), Table 8.1: if
  /// |p - p_formal| <= 0.1 p_formal then Fs = 1.25 with p_formal, else Fs = 3 with min(max(0.5, p),
  /// p_formal).
  /// The table is for monotone ladders; an oscillatory one always gets Fs = 3 here.
  OberkampfRoy2010
};

/// Outcome of the three-grid procedure; fine grid 1, medium 2, coarse 3. Relative values refer to phi on a
/// grid and are NaN where that phi is zero; `uncertainty` is in the unit of phi and does not need a nonzero
/// phi. For a ladder that is Divergent, Floor or Invalid everything but `observed_order` and `ratio` is NaN:
/// no uncertainty can be claimed for it.
struct GciResult {
  Convergence convergence;    ///< by classify_functional() with the steps
  double ratio;               ///< R = e21/e32
  double observed_order;      ///< p of three_grid_order(); negative if Divergent, NaN if undefined
  double used_order;          ///< order in the error estimate, by the rule
  double safety_factor;       ///< Fs, by the rule
  double extrapolated;        ///< Richardson: (r21^p phi_1 - phi_2)/(r21^p - 1) with the observed p
  double relative_error;      ///< e_a21 = |(phi_1 - phi_2)/phi_1|
  double extrapolated_error;  ///< e_ext21 = |(phi_ext - phi_1)/phi_ext|
  double gci_fine;            ///< Fs |e21/phi_1| / (r21^p - 1), p = used_order
  double gci_coarse;          ///< Fs |e32/phi_2| / (r32^p - 1), for the medium grid
  double uncertainty;         ///< Fs |e21| / (r21^p - 1), absolute, of the fine grid
  double uncertainty_coarse;  ///< Fs |e32| / (r32^p - 1), absolute, of the medium grid
  double asymptotic_ratio;    ///< gci_coarse / (r21^p gci_fine); see below
};

/// Grid convergence index of a functional on exactly three grids of any refinement ratios.
///
/// `steps`: h (m or any unit), coarse to fine; `values`: phi on them. Where only cell counts N are known,
/// h = (volume/N)^(1/dimension) (Celik et al., eq. 1).
/// `asymptotic_ratio` is reported because it is customary. With p from the same three grids it is
/// |phi_1/phi_2| identically for monotone ladders and so no evidence of anything; use observed_orders() on
/// four grids. Throws std::invalid_argument for a bad ladder, other than three levels, or a formal order that
/// is not positive.
GciResult grid_convergence_index(const std::vector<double>& steps, const std::vector<double>& values,
                                 double formal_order, SafetyRule rule = SafetyRule::OberkampfRoy2010);

/// Observed orders of successive grid triplets.
struct OrderSequence {
  std::vector<double> orders;  ///< one a triplet, coarse to fine; NaN where the triplet does not converge
  double drift;  ///< largest |p_k+1 - p_k| / |p_finest|; NaN if an order is NaN: a check on it then fails
};

/// Evidence for the asymptotic range from four or more grids: successive triplets must agree on p.
/// `steps` and `values` as in grid_convergence_index(). Throws std::invalid_argument for fewer than four
/// levels, a bad ladder, or sizes that differ.
OrderSequence observed_orders(const std::vector<double>& steps, const std::vector<double>& values);

}  // namespace verification
