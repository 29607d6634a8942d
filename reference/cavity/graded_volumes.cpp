#include "reference/cavity/graded_volumes.hpp"

#include <Eigen/Sparse>
#include <Eigen/SparseLU>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "reference/cavity/nested_dissection.hpp"
#include "reference/interruption.hpp"
#include "reference/require.hpp"

namespace reference {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using Sparse = Eigen::SparseMatrix<double>;

constexpr int most_iterations = 40;
constexpr double tolerance = 1e-11;

/// A linear function of the stream function, row by row, and what walls add to it.
class Rows {
 public:
  Rows(Index rows, int cells) : cells_(cells), constant(VectorXd::Zero(rows)), rows_(rows) {}

  /// psi at corner (i, j), which is 0 on the walls.
  void add(Index row, int i, int j, double value) {
    if (i <= 0 || j <= 0 || i >= cells_ || j >= cells_) return;
    entries_.emplace_back(row, (i - 1) + (cells_ - 1) * (j - 1), value);
  }
  [[nodiscard]] Sparse matrix() const {
    Sparse m(rows_, Index(cells_ - 1) * (cells_ - 1));
    m.setFromTriplets(entries_.begin(), entries_.end());
    return m;
  }

 private:
  int cells_;
  std::vector<Eigen::Triplet<double>> entries_;

 public:
  VectorXd constant;

 private:
  Index rows_;
};

/// A field on the mesh that depends on the stream function along a straight line: matrix psi + constant.
struct Affine {
  Sparse matrix;
  VectorXd constant;
  explicit Affine(const Rows& rows) : matrix(rows.matrix()), constant(rows.constant) {}
  [[nodiscard]] VectorXd operator()(const VectorXd& psi) const { return matrix * psi + constant; }
};

/// What the equations read off a stream function. Cells: i + n j; corners: i + (n + 1) j, those of the square
/// itself, where nothing flows, left at zero.
struct Readings {
  Readings(const std::vector<double>& x, int n);
  VectorXd cell_area, corner_area;
  Affine stretch, u_centre, v_centre;  // u_x and mean velocities of cells
  Affine shear, jump_u, jump_v;        // u_y + v_x; differences of u along y and of v along x
  Affine u_corner, v_corner;           // means of neighbours
  Affine through_u, through_v;         // volume that crosses a volume of u upwards, of v to the right
  Sparse to_centres, to_corners;       // means over a cell's corners, a corner's cells

 private:
  struct Raw;
  Readings(const Raw& raw);
};

struct Readings::Raw {
  Raw(const std::vector<double>& x, int n)
      : stretch(cells(n), n),
        u_centre(stretch),
        v_centre(stretch),
        shear(corners(n), n),
        jump_u(shear),
        jump_v(shear),
        u_corner(shear),
        v_corner(shear),
        through_u(shear),
        through_v(shear),
        cell_area(cells(n)),
        corner_area(VectorXd::Zero(corners(n))),
        to_centres(cells(n), corners(n)),
        to_corners(corners(n), cells(n)) {
    const auto at = [&](int i) { return x[static_cast<std::size_t>(i)]; };
    const auto width = [&](int i) { return at(i + 1) - at(i); };
    // Between the middles of the cells beside line i; half a cell at walls.
    const auto between = [&](int i) {
      return 0.5 * ((i > 0 ? width(i - 1) : 0.0) + (i < n ? width(i) : 0.0));
    };
    // u on the face of line i in row j, v on that of line j in column i; inside the square.
    const auto add_u = [&](Rows& rows, Index row, int i, int j, double factor) {
      rows.add(row, i, j + 1, factor / width(j));
      rows.add(row, i, j, -factor / width(j));
    };
    const auto add_v = [&](Rows& rows, Index row, int i, int j, double factor) {
      rows.add(row, i + 1, j, -factor / width(i));
      rows.add(row, i, j, factor / width(i));
    };
    std::vector<Eigen::Triplet<double>> centres, ends;
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) {
        const Index c = i + Index(n) * j;
        cell_area[c] = width(i) * width(j);
        add_u(stretch, c, i + 1, j, 1 / width(i));
        add_u(stretch, c, i, j, -1 / width(i));
        for (const int side : {0, 1}) {
          add_u(u_centre, c, i + side, j, 0.5);
          add_v(v_centre, c, i, j + side, 0.5);
        }
      }
    for (int j = 0; j <= n; ++j)
      for (int i = 0; i <= n; ++i) {
        const bool on_x = i == 0 || i == n, on_y = j == 0 || j == n;
        if (on_x && on_y) continue;
        const Index k = i + Index(n + 1) * j;
        corner_area[k] = between(i) * between(j);
        const auto add_jumps = [&](Rows& along_y, double by_y, Rows& along_x, double by_x) {
          if (j < n)
            add_u(along_y, k, i, j, by_y);
          else
            along_y.constant[k] += by_y;  // the lid
          if (j > 0) add_u(along_y, k, i, j - 1, -by_y);
          if (i < n) add_v(along_x, k, i, j, by_x);
          if (i > 0) add_v(along_x, k, i - 1, j, -by_x);
        };
        add_jumps(shear, 1 / between(j), shear, 1 / between(i));
        std::vector<Index> around;
        for (const int b : {j - 1, j})
          for (const int a : {i - 1, i})
            if (a >= 0 && a < n && b >= 0 && b < n) around.push_back(a + Index(n) * b);
        for (const Index c : around) ends.emplace_back(k, c, 1.0 / double(around.size()));
        if (on_x || on_y) continue;  // nothing crosses a wall
        add_jumps(jump_u, 1, jump_v, 1);
        for (const int back : {0, 1}) {
          add_u(u_corner, k, i, j - back, 0.5);
          add_v(v_corner, k, i - back, j, 0.5);
        }
        through_u.add(k, i - 1, j, 0.5), through_u.add(k, i + 1, j, -0.5);  // of psi = - integral of v
        through_v.add(k, i, j + 1, 0.5), through_v.add(k, i, j - 1, -0.5);
      }
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) {
        std::vector<Index> own;
        for (const int b : {j, j + 1})
          for (const int a : {i, i + 1})
            if ((a > 0 && a < n) || (b > 0 && b < n)) own.push_back(a + Index(n + 1) * b);
        for (const Index k : own) centres.emplace_back(i + Index(n) * j, k, 1.0 / double(own.size()));
      }
    to_centres.setFromTriplets(centres.begin(), centres.end());
    to_corners.setFromTriplets(ends.begin(), ends.end());
  }
  static Index cells(int n) { return Index(n) * n; }
  static Index corners(int n) { return Index(n + 1) * (n + 1); }

  Rows stretch, u_centre, v_centre, shear, jump_u, jump_v, u_corner, v_corner, through_u, through_v;
  VectorXd cell_area, corner_area;
  Sparse to_centres, to_corners;
};

Readings::Readings(const std::vector<double>& x, int n) : Readings(Raw(x, n)) {}
Readings::Readings(const Raw& r)
    : cell_area(r.cell_area),
      corner_area(r.corner_area),
      stretch(r.stretch),
      u_centre(r.u_centre),
      v_centre(r.v_centre),
      shear(r.shear),
      jump_u(r.jump_u),
      jump_v(r.jump_v),
      u_corner(r.u_corner),
      v_corner(r.v_corner),
      through_u(r.through_u),
      through_v(r.through_v),
      to_centres(r.to_centres),
      to_corners(r.to_corners) {}

/// One step of Newton's method, added to psi; its largest part.
double improve(const Readings& read, const CavityViscosity& viscosity, VectorXd& psi,
               Eigen::SparseLU<Sparse, NestedDissection>& solver, bool first) {
  const VectorXd e = read.stretch(psi), g = read.shear(psi);
  const VectorXd gg = g.cwiseAbs2(), ee = e.cwiseAbs2();
  const auto laws = [&](const VectorXd& q) {
    std::pair<VectorXd, VectorXd> law{VectorXd(q.size()), VectorXd(q.size())};
    for (Index i = 0; i < q.size(); ++i) {
      const auto [nu, by_q] = viscosity.at(q[i]);
      law.first[i] = nu, law.second[i] = by_q;
    }
    return law;
  };
  const auto [nu_c, by_c] = laws(4 * ee + read.to_centres * gg);
  const auto [nu_k, by_k] = laws(4 * (read.to_corners * ee) + gg);
  const VectorXd uc = read.u_centre(psi), vc = read.v_centre(psi), uk = read.u_corner(psi),
                 vk = read.v_corner(psi), up = read.through_u(psi), right = read.through_v(psi);

  // Work of the fluxes on the differences of a virtual velocity: viscous 4 nu e de + nu g dg, convective
  // - (u u - v v) de at centres, since v_y = -u_x, and - (flux u) du - (flux v) dv at corners.
  const auto& area = read.cell_area;
  const VectorXd at_centres =
      area.array() * (4 * nu_c.array() * e.array() - uc.array().square() + vc.array().square());
  const VectorXd at_corners = read.corner_area.cwiseProduct(nu_k).cwiseProduct(g);
  const VectorXd residual = read.stretch.matrix.transpose() * at_centres +
                            read.shear.matrix.transpose() * at_corners -
                            read.jump_u.matrix.transpose() * up.cwiseProduct(uk) -
                            read.jump_v.matrix.transpose() * right.cwiseProduct(vk);

  const VectorXd twice_g = 2 * g, eight_e = 8 * e;
  const Sparse by_g = twice_g.asDiagonal() * read.shear.matrix,
               by_e = eight_e.asDiagonal() * read.stretch.matrix;
  const Sparse q_c = by_e + Sparse(read.to_centres * by_g), q_k = Sparse(read.to_corners * by_e) + by_g;
  const auto scaled = [](const VectorXd& by, const Sparse& m) -> Sparse { return by.asDiagonal() * m; };
  const Sparse centre_change = scaled(4 * area.cwiseProduct(nu_c), read.stretch.matrix) +
                               scaled(4 * area.cwiseProduct(by_c).cwiseProduct(e), q_c) -
                               scaled(2 * area.cwiseProduct(uc), read.u_centre.matrix) +
                               scaled(2 * area.cwiseProduct(vc), read.v_centre.matrix);
  const Sparse corner_change = scaled(read.corner_area.cwiseProduct(nu_k), read.shear.matrix) +
                               scaled(read.corner_area.cwiseProduct(by_k).cwiseProduct(g), q_k);
  const Sparse u_change = scaled(up, read.u_corner.matrix) + scaled(uk, read.through_u.matrix),
               v_change = scaled(right, read.v_corner.matrix) + scaled(vk, read.through_v.matrix);
  Sparse matrix = Sparse(read.stretch.matrix.transpose()) * centre_change;
  matrix += Sparse(read.shear.matrix.transpose()) * corner_change;
  matrix -= Sparse(read.jump_u.matrix.transpose()) * u_change;
  matrix -= Sparse(read.jump_v.matrix.transpose()) * v_change;
  matrix.makeCompressed();
  if (first) solver.analyzePattern(matrix);
  solver.factorize(matrix);
  if (solver.info() != Eigen::Success) return std::nan("");
  const VectorXd step = solver.solve(-residual);
  psi += step;
  return step.lpNorm<Eigen::Infinity>();
}

/// Weights of the polynomial through some of ascending places: the (at most) six around x.
struct Stencil {
  Index first;
  VectorXd weight;
  Stencil(const std::vector<double>& places, double x) {
    const auto size = static_cast<Index>(places.size()), count = std::min<Index>(6, size);
    const Index above = std::ranges::upper_bound(places, x) - places.begin();
    first = std::clamp<Index>(above - count / 2, 0, size - count);
    weight = VectorXd::Ones(count);
    for (Index a = 0; a < count; ++a)
      for (Index b = 0; b < count; ++b)
        if (a != b) {
          const double here = places[static_cast<std::size_t>(first + a)],
                       other = places[static_cast<std::size_t>(first + b)];
          weight[a] *= (x - other) / (here - other);
        }
  }
};

}  // namespace

CavityGradedVolumes::CavityGradedVolumes(const CavityViscosity& viscosity, int cells,
                                         const CavityGradedVolumes* start, double clustering)
    : cells_(cells), stream_(MatrixXd::Zero(cells + 1, cells + 1)) {
  require(cells >= 8 && cells % 2 == 0, "graded volumes of the cavity: an even number of cells, at least 8");
  for (int i = 0; i <= cells; ++i) {
    const double s = double(i) / cells, turn = 2 * std::numbers::pi;
    lines_.push_back(s - clustering / turn * std::sin(turn * s));
  }
  lines_[static_cast<std::size_t>(cells / 2)] = 0.5;
  lines_.back() = 1;
  VectorXd psi = VectorXd::Zero(Index(cells - 1) * (cells - 1));
  if (start)
    for (int j = 1; j < cells; ++j)
      for (int i = 1; i < cells; ++i)
        psi[(i - 1) + Index(cells - 1) * (j - 1)] =
            start->stream(lines_[static_cast<std::size_t>(i)], lines_[static_cast<std::size_t>(j)]);
  const Readings read(lines_, cells);
  Eigen::SparseLU<Sparse, NestedDissection> solver;
  for (iterations_ = 1; iterations_ <= most_iterations; ++iterations_) {
    between_steps();
    const double change = improve(read, viscosity, psi, solver, iterations_ == 1);
    if (!std::isfinite(change)) break;
    if (change < tolerance) {
      stream_.block(1, 1, cells - 1, cells - 1) = psi.reshaped(cells - 1, cells - 1);
      return;
    }
  }
  throw std::runtime_error("Newton's method does not find the finite volumes of the cavity");
}

double CavityGradedVolumes::stream(double x, double y) const {
  const Stencil a(lines_, x), b(lines_, y);
  return a.weight.dot(stream_.block(a.first, b.first, a.weight.size(), b.weight.size()) * b.weight);
}

std::array<double, 2> CavityGradedVolumes::velocity(double x, double y) const {
  // Middles of the cells, and the walls at either end.
  std::vector<double> middles{0};
  for (int j = 0; j < cells_; ++j)
    middles.push_back(0.5 * (lines_[static_cast<std::size_t>(j)] + lines_[static_cast<std::size_t>(j) + 1]));
  middles.push_back(1);
  const auto mean = [&](Index k, const auto& psi) {  // over face k of a line, or on a wall
    const auto j = static_cast<std::size_t>(k);
    return (psi(k) - psi(k - 1)) / (lines_[j] - lines_[j - 1]);
  };
  const auto interpolated = [&](double along, double across, double lid, const auto& psi) {
    const Stencil a(lines_, along), b(middles, across);
    double sum = 0;
    for (Index i = 0; i < a.weight.size(); ++i)
      for (Index j = 0; j < b.weight.size(); ++j) {
        const Index line = a.first + i, k = b.first + j;
        const bool wall = line == 0 || line == cells_ || k == 0;
        const double value = wall ? 0 : k > cells_ ? lid : mean(k, [&](Index m) { return psi(line, m); });
        sum += a.weight[i] * b.weight[j] * value;
      }
    return sum;
  };
  return {interpolated(x, y, 1, [&](Index line, Index m) { return stream_(line, m); }),
          interpolated(y, x, 0, [&](Index line, Index m) { return -stream_(m, line); })};
}

}  // namespace reference
