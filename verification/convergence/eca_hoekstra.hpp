#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "verification/convergence/order.hpp"

namespace verification {

/// Error expansions that the procedure fits (Eca & Hoekstra, eqs. 1 and 5-7).
enum class ErrorModel {
  Constant,             ///< phi_0: the same value on every grid
  PowerLaw,             ///< phi_0 + alpha h^p, p free
  FirstOrder,           ///< phi_0 + alpha h
  FormalOrder,          ///< phi_0 + alpha h^q, q the formal order
  FirstAndFormalOrder,  ///< phi_0 + alpha_1 h + alpha_2 h^q
};

/// A least-squares fit of one expansion.
struct GridFit {
  ErrorModel model = ErrorModel::Constant;
  bool weighted = false;           ///< weights 1/h, normalised (eqs. 16-17), else equal
  double limit = 0.0;              ///< phi_0, in the unit of phi
  std::vector<double> exponents;   ///< powers of h, one a term
  std::vector<double> amplitudes;  ///< contribution of each term on the finest grid, in the unit of phi
  double finest_step = 1.0;        ///< h of the finest grid
  double sigma = 0.0;              ///< standard deviation of the fit, in the unit of phi

  /// Fitted phi at cell size h (the unit of the steps).
  double at(double h) const;
};

/// Numerical uncertainty of phi on one grid; all but the order and the factor in the unit of phi.
struct EcaHoekstraResult {
  Convergence convergence;  ///< Monotone: p > 0 in a fit; Divergent: the paper's anomalous behaviour, p <= 0
                            ///< in both fits; Floor: the same value on every grid; Invalid: NaN or infinity
  double observed_order;    ///< p of the chosen power-law fit; NaN unless Monotone
  GridFit fit;              ///< expansion that the error estimate is taken from
  double data_range;        ///< Delta_phi = (max phi - min phi)/(n_g - 1), eq. 19
  double safety_factor;     ///< 1.25 or 3
  double error_estimate;    ///< eps = |phi_fit(h_i) - phi_0|
  double fit_residual;      ///< |phi_i - phi_fit(h_i)|
  double uncertainty;       ///< U: phi_i - U <= phi_exact <= phi_i + U with 95 % confidence; NaN if Invalid
};

/// Numerical uncertainty from four or more grids: L. Eca, M. Hoekstra, "A procedure for the estimation of the
/// numerical uncertainty of CFD calculations based on grid refinement studies", J. Comput. Phys. 262 (2014)
/// 104-130, Appendices A and B.
///
/// 1. Fit phi_0 + alpha h^p with equal weights and with w_i = (1/h_i)/sum(1/h_j). The standard deviation is
///    sigma^2 = sum n_i (phi_i - fit_i)^2 / (n_g - n_par), n_i = 1 or n_g w_i, n_par the number of fitted
///    parameters. Of the fits with p > 0 the one with the smaller sigma gives p.
///    - 0.5 <= p <= q: that fit is used.
///    - p > q: the best (smallest sigma) of first and formal order, each with both weightings.
///    - p < 0.5, or no fit with p > 0 (anomalous): as before, and the two-term expansion besides.
/// 2. Delta_phi = (max phi - min phi)/(n_g - 1).
/// 3. Fs = 1.25 if 0.5 <= p < 1.05 q and sigma < Delta_phi, else 3.
/// 4. U = Fs eps + sigma + |phi_i - fit_i| if sigma < Delta_phi (eq. 20),
///    else U = 3 (sigma/Delta_phi)(eps + sigma + |phi_i - fit_i|) (eq. 21).
/// Published for q = 2 (expansions h, h^2, h + h^2; bounds 0.5, 2 and 2.1). For other formal orders q the
/// second exponent is q (2 if q = 1 in the two-term expansion) and 2.1 becomes 1.05 q; that is this project's
/// choice.
///
/// Where sources differ: implementations in public use prefer, of the two power-law fits, either the one with
/// the smaller sigma (as here and in ORNL's cfd-verify) or first any with p in [0.5, 2]. cfd-verify also
/// minimises sum (w_i r_i)^2 in its weighted fits where the paper has sum w_i r_i^2.
///
/// `steps`: h, coarse to fine, any ratios; `values`: phi; `level`: the grid i, the finest if not given.
/// Three grids leave no degree of freedom for sigma, so the procedure excludes them: use
/// grid_convergence_index(). The same value on every grid gives U = 0 and Floor.
/// Throws std::invalid_argument for a bad ladder, fewer than four grids, sizes that differ, a formal order
/// below 1, or a level out of range.
EcaHoekstraResult eca_hoekstra(const std::vector<double>& steps, const std::vector<double>& values,
                               double formal_order = 2.0, std::optional<std::size_t> level = std::nullopt);

/// Step 1's power-law fit alone, with p free in [-12, 12] (a fit that wants more stops there): global minimum
/// of the weighted sum of squares over p, then the root of its derivative with respect to p (Appendix B.1).
/// `exponents` holds p. Arguments as eca_hoekstra(); finite values that are not all the same are presumed.
GridFit fit_power_law(const std::vector<double>& steps, const std::vector<double>& values, bool weighted);

}  // namespace verification
