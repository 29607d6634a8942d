#pragma once

#include <cmath>
#include <limits>

#include "solver/incompressible/lanes/component_fit.hpp"
#include "solver/incompressible/lanes/function_weights.hpp"

namespace mpm::MPM_ISA {

/// The passes of the incompressible method for splines of degree k: the fit in vectors of `width`
/// neighbouring cells, what follows a field in vectors of the functions that meet at a particle.
template <int k>
class LanePlane final : public PlaneKernel {
 public:
  explicit LanePlane(const PlaneSetup& setup)
      : setup_(setup),
        u_(setup_, 0),
        v_(setup_, 1),
        field_u_(u_.rows()),
        field_v_(v_.rows()),
        x_full_(setup_.axis[0].polynomials[0], setup_.axis[0].cells),
        y_full_(setup_.axis[1].polynomials[0], setup_.axis[1].cells),
        x_less_(setup_.axis[0].polynomials[1], setup_.axis[0].cells),
        y_less_(setup_.axis[1].polynomials[1], setup_.axis[1].cells),
        x_full_block_(setup_.axis[0].polynomials[0], setup_.axis[0].cells),
        x_less_block_(setup_.axis[0].polynomials[1], setup_.axis[0].cells),
        blocks_((setup_.axis[0].cells + width - 1) / width) {
    for (std::size_t a : {0, 1}) cells_a_metre_[a] = setup_.axis[a].cells / setup_.axis[a].length;
  }

  void follow(const double* unknowns) override {
    u_.rows().place(unknowns, field_u_.data());
    u_.rows().set_images(field_u_.data());
    v_.rows().place(unknowns + u_.rows().unknowns(0) * u_.rows().unknowns(1), field_v_.data());
    v_.rows().set_images(field_v_.data());
  }

  [[gnu::flatten]] void velocities(const double* places, std::size_t count,
                                   double* velocities) const override {
    for (std::size_t p = 0; p < count; ++p) {
      const Pair v = velocity({places[2 * p], places[2 * p + 1]});
      velocities[2 * p] = v.x;
      velocities[2 * p + 1] = v.y;
    }
  }

  [[gnu::flatten]] void drift(const double* from, std::size_t count, double dt, double* to) const override {
    // All middles of some points first: no point waits for its own.
    constexpr std::size_t some = 32;
    const auto point = [](const double* at, std::size_t p) { return Pair{at[2 * p], at[2 * p + 1]}; };
    for (std::size_t first = 0; first < count; first += some) {
      const std::size_t end = std::min(first + some, count);
      Pair middle[some];
      for (std::size_t p = first; p < end; ++p)
        middle[p - first] = moved(point(from, p), 0.5 * dt, velocity(point(from, p)));
      for (std::size_t p = first; p < end; ++p) {
        const Pair x = moved(point(from, p), dt, velocity(middle[p - first]));
        to[2 * p] = x.x;
        to[2 * p + 1] = x.y;
      }
    }
  }

  void assemble(const double* volumes, const double* places, const double* velocities, std::size_t count,
                ThreadTeam& team) override {
    sort(volumes, places, velocities, count);
    u_.clear();
    v_.clear();
    // Strips of cells that are not neighbours share no function: first all even ones, then all odd ones.
    const int rows = setup_.axis[1].cells, strips = (rows + rows_a_strip - 1) / rows_a_strip;
    for (const int parity : {0, 1})
      team.run((strips + 1 - parity) / 2, [&](int share) {
        const int begin = (2 * share + parity) * rows_a_strip, end = std::min(begin + rows_a_strip, rows);
        for (int row = begin; row < end; ++row)
          for (int block = 0; block < blocks_; ++block) add_block(row, block);
      });
  }

  void solve(int component, double tolerance, const double* last, double* result) const override {
    if (component == 0)
      u_.solve(tolerance, last, result);
    else
      v_.solve(tolerance, last, result);
  }

  [[nodiscard]] std::pair<int, int> occupancy() const override {
    int fewest = std::numeric_limits<int>::max(), most = 0;
    for (const int n : occupants_) fewest = std::min(fewest, n), most = std::max(most, n);
    return {fewest, most};
  }

 private:
  static constexpr int rows_a_strip = 8;  // more than the k + 1 rows of functions that a cell touches

  struct Pair {
    double x, y;
  };
  /// A particle a lane, each in another of neighbouring cells; of volume 0 where there is none.
  struct Slot {
    Lanes xi, eta, volume, momentum[2];
  };

  /// Cell of a coordinate along an axis, and the place in it. What is not a number falls into the first cell.
  struct InCell {
    int cell;
    double xi;
  };
  [[gnu::always_inline]] InCell in_cell(std::size_t axis, double x) const {
    const double scaled = x * cells_a_metre_[axis];
    const int cell = scaled > 0 ? static_cast<int>(std::min(scaled, setup_.axis[axis].cells - 1.0)) : 0;
    return {cell, scaled - cell};
  }

  /// u = sum N_i(x) M_j(y) u_ij, v = sum M_i(x) N_j(y) v_ij.
  [[gnu::always_inline]] Pair velocity(Pair at) const {
    const InCell x = in_cell(0, at.x), y = in_cell(1, at.y);
    FunctionWeights<k + 1> x_full, y_full;
    FunctionWeights<k> x_less, y_less;
    x_full_.at(x.cell, x.xi, x_full);
    x_less_.at(x.cell, x.xi, x_less);
    y_full_.at(y.cell, y.xi, y_full);
    y_less_.at(y.cell, y.xi, y_less);
    const int stride_u = u_.rows().stride(), stride_v = v_.rows().stride();
    return {sum_over(field_u_.data() + y.cell * stride_u + x.cell, stride_u, x_full, y_less),
            sum_over(field_v_.data() + y.cell * stride_v + x.cell, stride_v, x_less, y_full)};
  }

  template <int nx, int ny>
  [[gnu::always_inline]] static double sum_over(const double* field, int stride, const FunctionWeights<nx>& x,
                                                const FunctionWeights<ny>& y) {
    using Row = FunctionWeights<nx>;
    Row sums;
    unroll<Row::parts>([&](int p) { sums.part[p] = y.of()[0] * Row::load_part(field + p * Row::lanes); });
    unroll<ny - 1>([&](int j) {
      unroll<Row::parts>([&](int p) {
        sums.part[p] += y.of()[j + 1] * Row::load_part(field + (j + 1) * stride + p * Row::lanes);
      });
    });
    typename Row::Part total = sums.part[0] * x.part[0];
    for (int p = 1; p < Row::parts; ++p) total += sums.part[p] * x.part[p];
    double sum = 0;
    for (int lane = 0; lane < std::min(Row::lanes, nx); ++lane) sum += total[lane];
    return sum;
  }

  [[gnu::always_inline]] Pair moved(Pair x, double dt, Pair v) const {
    return {inside(0, x.x + dt * v.x), inside(1, x.y + dt * v.y)};
  }
  [[gnu::always_inline]] double inside(std::size_t axis, double x) const {
    const double length = setup_.axis[axis].length;
    if (!setup_.axis[axis].periodic) return std::clamp(x, 0.0, length);
    return x >= 0 && x < length ? x : x - length * std::floor(x / length);
  }

  /// Particles into slots: of every block as many as its fullest cell has particles.
  void sort(const double* volumes, const double* places, const double* velocities, std::size_t count) {
    const int cells = setup_.axis[0].cells, rows = setup_.axis[1].cells;
    occupants_.assign(static_cast<std::size_t>(cells) * static_cast<std::size_t>(rows), 0);
    cell_of_.resize(count);
    for (std::size_t p = 0; p < count; ++p) {
      cell_of_[p] = in_cell(0, places[2 * p]).cell + cells * in_cell(1, places[2 * p + 1]).cell;
      ++occupants_[static_cast<std::size_t>(cell_of_[p])];
    }
    first_slot_.assign(1, 0);
    for (int row = 0; row < rows; ++row)
      for (int block = 0; block < blocks_; ++block) {
        const auto begin = occupants_.begin() + row * cells + block * width;
        const auto end = occupants_.begin() + row * cells + std::min(cells, (block + 1) * width);
        first_slot_.push_back(first_slot_.back() + static_cast<std::size_t>(*std::max_element(begin, end)));
      }
    slots_.assign(first_slot_.back(), Slot{0, 0, 0, {0, 0}});
    next_.assign(occupants_.size(), 0);
    for (std::size_t p = 0; p < count; ++p) {
      const int cell = cell_of_[p], row = cell / cells, cx = cell - row * cells;
      const auto place = static_cast<std::size_t>(next_[static_cast<std::size_t>(cell)]++);
      Slot& slot = slots_[first_slot_[static_cast<std::size_t>(row * blocks_ + cx / width)] + place];
      const int lane = cx % width;
      slot.xi[lane] = places[2 * p] * cells_a_metre_[0] - cx;
      slot.eta[lane] = places[2 * p + 1] * cells_a_metre_[1] - row;
      slot.volume[lane] = volumes[p];
      for (std::size_t c : {0, 1}) slot.momentum[c][lane] = volumes[p] * velocities[2 * p + c];
    }
  }

  [[gnu::flatten]] void add_block(int row, int block) {
    const auto number = static_cast<std::size_t>(row * blocks_ + block);
    const Slot* const begin = slots_.data() + first_slot_[number];
    const Slot* const end = slots_.data() + first_slot_[number + 1];
    if (begin == end) return;
    const double* const y_full =
        setup_.axis[1].polynomials[0] + static_cast<std::ptrdiff_t>(row) * (k + 1) * (k + 1);
    const double* const y_less = setup_.axis[1].polynomials[1] + static_cast<std::ptrdiff_t>(row) * k * k;
    CellSums<k + 1, k> of_u;
    CellSums<k, k + 1> of_v;
    Lanes load_u[(k + 1) * k] = {}, load_v[(k + 1) * k] = {};
    for (const Slot* slot = begin; slot < end; ++slot) {
      Lanes x_full[k + 1], full[k + 1], x_less[k], less[k];
      x_full_block_.at(block, slot->xi, x_full);
      x_less_block_.at(block, slot->xi, x_less);
      functions_at<k + 1>(y_full, slot->eta, full);
      functions_at<k>(y_less, slot->eta, less);
      of_u.add(slot->volume, x_full, less);
      of_v.add(slot->volume, x_less, full);
      unroll<k>([&](int a) {
        const Lanes at_y = slot->momentum[0] * less[a], at_x = slot->momentum[1] * x_less[a];
        unroll<k + 1>([&](int b) {
          load_u[a * (k + 1) + b] += at_y * x_full[b];
          load_v[b * k + a] += at_x * full[b];
        });
      });
    }
    u_.add(block * width, row, of_u, load_u);
    v_.add(block * width, row, of_v, load_v);
  }

  const PlaneSetup& setup_;
  double cells_a_metre_[2];
  ComponentFit<k + 1, k> u_;
  ComponentFit<k, k + 1> v_;
  FunctionArray field_u_, field_v_;
  CellPolynomials<k + 1> x_full_, y_full_;
  CellPolynomials<k> x_less_, y_less_;
  BlockPolynomials<k + 1> x_full_block_;
  BlockPolynomials<k> x_less_block_;
  int blocks_;  // of `width` cells, in a row
  std::vector<int> occupants_, cell_of_, next_;
  std::vector<std::size_t> first_slot_;  // of every block, row by row
  LargeArray<Slot> slots_;
};

}  // namespace mpm::MPM_ISA
