#pragma once

#include <algorithm>
#include <array>

#include "solver/kernel/full_mass/lattice.hpp"
#include "solver/kernel/threads/thread_team.hpp"

namespace mpm::MPM_ISA {

/// Bands of rows, which threads visit independently. They depend on the lattice alone, and so does the order
/// in which their sums are added: results are the same whatever the number of threads.
class Bands {
 public:
  Bands(const Lattice& lattice, int cells, ThreadTeam& team)
      : lattice_(lattice), cells_(cells), count_(std::clamp(cells / least_rows, 1, most)), team_(team) {}

  [[nodiscard]] int count() const { return count_; }

  /// f(rows) for all rows of nodes, a few at a time.
  template <class F>
  void each_rows(F&& f) const {
    each_band([&](int band) { each_rows_of(band, f); });
  }
  /// f(i) for the vectors of nodes.
  template <class F>
  void each_vector(F&& f) const {
    each_rows([&](Rows rows) { lattice_.each_vector(rows, f); });
  }
  /// The same, and then the margins of a field.
  template <class F>
  void each_vector_with_margins(LatticeVector& x, F&& f) const {
    each_band([&](int band) {
      lattice_.each_vector(rows_of_nodes(band), f);
      fill_margins(x, rows_of_nodes(band));
    });
  }
  /// The sums to which f(rows, sums) adds a component.
  template <class F>
  [[nodiscard]] Both sum_of_rows(F&& f) const {
    return both(sum_of_bands<2>(
        [&](int band, Lanes(&sums)[2]) { each_rows_of(band, [&](Rows rows) { f(rows, sums); }); }));
  }
  /// The sums to which f(i, sums) adds a component.
  template <class F>
  [[nodiscard]] Both sum(F&& f) const {
    return sum_of_rows(
        [&](Rows rows, Lanes(&sums)[2]) { lattice_.each_vector(rows, [&](int i) { f(i, sums); }); });
  }
  /// The same, and then the margins of a field.
  template <class F>
  [[nodiscard]] Both sum_with_margins(LatticeVector& x, F&& f) const {
    return both(sum_of_bands<2>([&](int band, Lanes(&sums)[2]) {
      lattice_.each_vector(rows_of_nodes(band), [&](int i) { f(i, sums); });
      fill_margins(x, rows_of_nodes(band));
    }));
  }
  /// The sums to which f(rows of cells, sums) adds.
  template <std::size_t count, class F>
  [[nodiscard]] std::array<double, count> sum_of_cells(F&& f) const {
    return sum_of_bands<count>([&](int band, Lanes(&sums)[count]) { f(rows_of_cells(band), sums); });
  }

  /// f(band, rows of cells) for all bands.
  template <class F>
  void each_of_cells(F&& f) const {
    each_band([&](int band) { f(band, rows_of_cells(band)); });
  }
  /// The same for cells that add to their nodes: no band together with its neighbours, with which it shares
  /// nodes.
  template <class F>
  void each_of_cells_apart(F&& f) const {
    for (int parity : {0, 1})
      each((count_ + 1 - parity) / 2, [&](int pair) { f(rows_of_cells(2 * pair + parity)); });
  }
  /// f(k) for all k below a number, on all threads.
  template <class F>
  void each(int shares, F&& f) const {
    team_.run(shares, Flattened<F>{f});
  }

 private:
  /// A band adds to degree rows of nodes above it, and its last vector to the first of the row thereafter;
  /// these must end within the next band.
  static constexpr int least_rows = 8, most = 32;
  /// Rows of nodes at a time: what one loop over them has written is in the first cache for the next.
  static constexpr int together = 4;

  template <class F>
  struct Flattened {
    F& f;
    [[gnu::flatten]] void operator()(int share) const { f(share); }
  };

  template <class F>
  void each_band(F&& f) const {
    each(count_, f);
  }
  template <class F>
  [[gnu::always_inline]] void each_rows_of(int band, F&& f) const {
    const auto [begin, end] = rows_of_nodes(band);
    for (int row = begin; row < end; row += together) f(Rows{row, std::min(row + together, end)});
  }
  [[gnu::always_inline]] void fill_margins(LatticeVector& x, Rows rows) const {
    for (std::size_t c : {0, 1}) lattice_.fill_margins(x[c], rows);
  }

  /// In the order of bands.
  template <std::size_t count, class F>
  [[nodiscard]] std::array<double, count> sum_of_bands(F&& f) const {
    std::array<std::array<double, count>, most> of_band;
    each_band([&](int band) {
      Lanes sums[count];
      std::fill_n(sums, count, Lanes(0));
      f(band, sums);
      for (std::size_t k = 0; k < count; ++k)
        of_band[static_cast<std::size_t>(band)][k] = mpm::MPM_ISA::sum(sums[k]);
    });
    std::array<double, count> total{};
    for (int band = 0; band < count_; ++band)
      for (std::size_t k = 0; k < count; ++k) total[k] += of_band[static_cast<std::size_t>(band)][k];
    return total;
  }
  static Both both(const std::array<double, 2>& sums) { return {{sums[0], sums[1]}}; }

  [[nodiscard]] Rows rows_of_cells(int band) const { return {first(band, cells_), first(band + 1, cells_)}; }
  [[nodiscard]] Rows rows_of_nodes(int band) const {
    return {first(band, lattice_.count(1)), first(band + 1, lattice_.count(1))};
  }
  [[nodiscard]] int first(int band, int rows) const {
    return static_cast<int>(static_cast<long>(rows) * band / count_);
  }

  const Lattice& lattice_;
  int cells_, count_;
  ThreadTeam& team_;
};

}  // namespace mpm::MPM_ISA
