#include "solver/kernel/threads/sweep.hpp"

#include <set>

#include "tests/catch.hpp"

using namespace mpm;

namespace {

constexpr int width = 8;  // of the widest vectors

/// Carries a sweep's tasks out on a grid on which every node remembers what was done to it.
class Rehearsal {
 public:
  Rehearsal(const Sweep::Lines& lines, int passes)
      : lines_(lines),
        node_rows_(lines.rows + lines.degree),
        visited_(static_cast<std::size_t>(passes), std::vector<int>(cells(), 0)),
        fresh_(static_cast<std::size_t>(passes), std::vector<int>(nodes(), 0)),
        complete_(fresh_),
        writer_(static_cast<std::size_t>(passes) * nodes()),
        reader_(writer_.size()) {}

  void perform(const Sweep& sweep) {
    for (const auto* phase : {&sweep.cuts(), &sweep.segments()}) {
      std::fill(writer_.begin(), writer_.end(), nobody);
      std::fill(reader_.begin(), reader_.end(), nobody);
      share_ = 0;
      for (const Sweep::Tasks& tasks : *phase) {
        for (const Sweep::Task& task : tasks) perform(task);
        ++share_;
      }
    }
  }

  void require_done() const {
    for (const auto& pass : visited_)
      for (const int times : pass)
        if (times != 1) FAIL("a cell was visited " << times << " times");
    for (const auto* done : {&fresh_, &complete_})
      for (const auto& pass : *done)
        for (const int times : pass)
          if (times != 1) FAIL("a node was cleared or completed " << times << " times");
  }

 private:
  [[nodiscard]] std::size_t cells() const { return static_cast<std::size_t>(lines_.rows * lines_.stride); }
  [[nodiscard]] std::size_t nodes() const { return static_cast<std::size_t>(node_rows_ * lines_.stride); }
  [[nodiscard]] int first_of_row(int row) const { return (row * lines_.stride + width - 1) / width * width; }

  void perform(const Sweep::Task& task) {
    const auto pass = static_cast<std::size_t>(task.pass);
    const bool scatters = pass + 1 < visited_.size();
    const auto each_node = [&](Rows rows, auto&& f) {
      for (int n = rows.begin * lines_.stride; n < rows.end * lines_.stride; ++n)
        f(static_cast<std::size_t>(n));
    };
    each_node(task.part.fresh, [&](std::size_t n) {
      ++fresh_[pass][n];
      if (scatters) write(pass, n);
    });
    const int end = first_of_row(task.part.cells.end);
    for (int c = first_of_row(task.part.cells.begin); c < end; ++c) {
      if (c >= static_cast<int>(cells())) continue;  // of no row
      ++visited_[pass][static_cast<std::size_t>(c)];
      for (int l = 0; l <= lines_.degree; ++l)
        for (int k = 0; k < lines_.degree + 1 + width; ++k)
          visit(pass, c + l * lines_.stride + k, k <= lines_.degree);
    }
    each_node(task.part.complete, [&](std::size_t n) {
      ++complete_[pass][n];
      if (scatters) write(pass, n);
      for (const int c : cells_around(static_cast<int>(n)))
        if (visited_[pass][static_cast<std::size_t>(c)] != 1)
          FAIL("node " << n << " is not complete in pass " << pass);
    });
  }

  /// A cell adds to a node, or reads it; beyond its own nodes a vector reads and writes what stood there.
  void visit(std::size_t pass, int node, bool is_own) {
    if (node >= static_cast<int>(nodes())) return;
    const auto n = static_cast<std::size_t>(node);
    if (pass + 1 < visited_.size()) {
      write(pass, n);
      if (is_own && fresh_[pass][n] != 1) FAIL("node " << n << " was not cleared before pass " << pass);
      if (is_own && complete_[pass][n] != 0) FAIL("node " << n << " was complete before pass " << pass);
    }
    if (pass > 0) {
      read(pass - 1, n);
      if (is_own && complete_[pass - 1][n] != 1) FAIL("pass " << pass << " reads node " << n << " too early");
    }
  }

  void write(std::size_t field, std::size_t n) {
    int& writer = writer_[field * nodes() + n];
    if (writer != nobody && writer != share_) FAIL("two shares write node " << n);
    writer = share_;
    if (const int reader = reader_[field * nodes() + n]; reader != nobody && reader != share_)
      FAIL("a share writes node " << n << ", which another reads");
  }
  void read(std::size_t field, std::size_t n) {
    int& reader = reader_[field * nodes() + n];
    reader = reader == nobody || reader == share_ ? share_ : several;
    if (const int writer = writer_[field * nodes() + n]; writer != nobody && writer != share_)
      FAIL("a share reads node " << n << ", which another writes");
  }

  /// Cells that add to a node, or to an image of it.
  [[nodiscard]] std::set<int> cells_around(int node) const {
    std::set<int> around;
    const int row = node / lines_.stride;
    for (int of = lines_.is_periodic ? row % lines_.rows : row; of < node_rows_; of += lines_.rows) {
      for (int l = 0; l <= lines_.degree; ++l)
        if (const int r = of - l; r >= 0 && r < lines_.rows)
          for (int k = 0; k <= lines_.degree; ++k)
            if (const int i = node % lines_.stride - k; i >= 0) around.insert(r * lines_.stride + i);
      if (!lines_.is_periodic) break;
    }
    return around;
  }

  Sweep::Lines lines_;
  int node_rows_, share_ = 0;
  std::vector<std::vector<int>> visited_, fresh_, complete_;
  static constexpr int nobody = -1, several = -2;
  std::vector<int> writer_, reader_;  // shares of the present phase, by field and node
};

}  // namespace

TEST_CASE("a sweep visits every cell with every pass, when its nodes are complete, and shares do not meet") {
  struct Case {
    int rows, along, degree, shares;  // shares at least
  };
  for (const Case& c : {Case{10, 20, 1, 1}, Case{300, 20, 1, 1}, Case{900, 20, 1, 2}, Case{1100, 17, 3, 2},
                        Case{130, 130, 1, 1}, Case{2100, 9, 2, 2}, Case{600, 64, 2, 4}, Case{6300, 20, 1, 8}})
    for (const bool is_periodic : {false, true})
      for (const int passes : {1, 3, 4}) {
        INFO(c.rows << " rows of " << c.along << ", degree " << c.degree
                    << (is_periodic ? ", periodic, " : ", ") << passes << " passes");
        const Sweep::Lines lines{c.rows, c.along + c.degree, c.degree, is_periodic};
        const Sweep sweep(lines, passes);
        CHECK(sweep.segments().size() >= static_cast<std::size_t>(c.shares));
        Rehearsal rehearsal(lines, passes);
        rehearsal.perform(sweep);
        rehearsal.require_done();
      }
}

TEST_CASE("the shares of a sweep are numbered, and of a cut grid each has its own sums") {
  const Sweep sweep({2000, 21, 1, true}, 3);
  std::set<int> numbers;
  for (const auto* phase : {&sweep.cuts(), &sweep.segments()})
    for (const Sweep::Tasks& tasks : *phase) {
      for (const Sweep::Task& task : tasks) CHECK(task.part.share == tasks.front().part.share);
      numbers.insert(tasks.front().part.share);
    }
  CHECK(static_cast<int>(numbers.size()) == sweep.shares());
  CHECK(*numbers.begin() == 0);
  CHECK(*numbers.rbegin() == sweep.shares() - 1);
}
