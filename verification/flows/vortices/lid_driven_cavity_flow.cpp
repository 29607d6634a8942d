#include "verification/flows/vortices/lid_driven_cavity_flow.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <future>
#include <limits>
#include <map>
#include <mutex>

#include "reference/cavity/benchmark_fluids.hpp"
#include "reference/cavity/cavity_finite_volumes.hpp"
#include "reference/vortices/smooth_cavity.hpp"
#include "verification/flows/vortices/cavity_tables.hpp"

namespace verification {
namespace {

/// The tables' values where they stand, NaN elsewhere and for the other component.
class TabulatedField final : public ExactField {
 public:
  TabulatedField(std::vector<reference::CavityPoint> points, double side, double lid_velocity,
                 std::string description)
      : points_(std::move(points)),
        side_(side),
        lid_velocity_(lid_velocity),
        description_(std::move(description)) {}

  [[nodiscard]] Vec2 velocity(const Vec2& x, double, Location location) const override {
    Vec2 v = Vec2::Constant(std::numeric_limits<double>::quiet_NaN());
    if (location != Location::Grid) return v;
    for (const reference::CavityPoint& point : points_)
      if (std::hypot(x.x() / side_ - point.x, x.y() / side_ - point.y) < 1e-9)
        v[point.component] = lid_velocity_ * point.value;
    return v;
  }
  [[nodiscard]] std::string description() const override { return description_; }

 private:
  std::vector<reference::CavityPoint> points_;
  double side_, lid_velocity_;
  std::string description_;
};

/// Cells of the coarsest of three meshes of finite volumes, each of twice the cells of the one before. The
/// viscosity of a plug takes successive substitution some hundred rounds, and a minute on 128 cells.
int coarsest(const reference::FlowCurve& curve) {
  return curve.yielding() ? 16 : 32;
}

/// Squares along a side of the lattice on which a fluid with a yield stress is sampled: it shows where the
/// fluid yields, and holds the places of the tables.
constexpr int lattice_squares = 64;

/// The centre lines of a fluid, in units of L and U. Each is computed once a process, whoever asks.
std::vector<reference::CavityLine> computed_lines(const LidDrivenCavityParameters& p) {
  static std::mutex mutex;
  static std::map<std::string, std::shared_future<std::vector<reference::CavityLine>>> known;
  std::shared_future<std::vector<reference::CavityLine>> lines;
  {
    const std::scoped_lock lock(mutex);
    auto& entry = known[fmt::format("{} {:.17g} {:.17g}", p.curve.describe(), p.side, p.lid_velocity)];
    if (!entry.valid())
      entry = std::async(std::launch::deferred, [p] {
                const double rate = p.lid_velocity / p.side, diffusivity = p.lid_velocity * p.side;
                return reference::cavity_centre_lines(
                    [&](double w) { return p.curve.viscosity(w * rate) / diffusivity; }, coarsest(p.curve));
              }).share();
    lines = entry;
  }
  return lines.get();
}

/// The steady flow under a smooth lid.
class SmoothField final : public ExactField {
 public:
  SmoothField(double reynolds, double side, double lid_velocity)
      : flow_(reynolds, functions), fewer_(reynolds, fewer), side_(side), lid_velocity_(lid_velocity) {}

  [[nodiscard]] Vec2 velocity(const Vec2& x, double, Location) const override { return in(flow_, x); }
  [[nodiscard]] std::string description() const override {
    double largest = 0;
    for (int j = 1; j < 16; ++j)
      for (int i = 1; i < 16; ++i) {
        const Vec2 x = side_ / 16 * Vec2(i, j);
        largest = std::max(largest, (in(flow_, x) - in(fewer_, x)).norm() / lid_velocity_);
      }
    return fmt::format(
        "steady state: Galerkin's method with {} polynomials an axis, which differs from that with {} by "
        "{:.1e} "
        "of the lid's velocity",
        functions, fewer, largest);
  }

 private:
  static constexpr int functions = 24, fewer = 18;
  [[nodiscard]] Vec2 in(const reference::SmoothCavity& flow, const Vec2& x) const {
    const auto v = flow.velocity(x.x() / side_, x.y() / side_);
    return lid_velocity_ * Vec2(v[0], v[1]);
  }
  reference::SmoothCavity flow_, fewer_;
  double side_, lid_velocity_;
};

/// Each is computed once a process, whoever asks.
std::shared_ptr<const ExactField> smooth_field(double reynolds, double side, double lid_velocity) {
  static std::mutex mutex;
  static std::map<std::string, std::shared_future<std::shared_ptr<const ExactField>>> known;
  std::shared_future<std::shared_ptr<const ExactField>> field;
  {
    const std::scoped_lock lock(mutex);
    auto& entry = known[fmt::format("{:.17g} {:.17g} {:.17g}", reynolds, side, lid_velocity)];
    if (!entry.valid())
      entry = std::async(std::launch::deferred, [=]() -> std::shared_ptr<const ExactField> {
                return std::make_shared<SmoothField>(reynolds, side, lid_velocity);
              }).share();
    field = entry;
  }
  return field.get();
}

}  // namespace

mpm::Scene LidDrivenCavityFlow::scene(const Discretisation& d) const {
  mpm::Scene scene;
  scene.size = Vec2::Constant(parameters_.side);
  scene.cells = {d.cells, d.cells};
  scene.particles_per_cell = {d.particles_along, d.particles_across};
  for (mpm::Side& side : scene.sides) side = mpm::Side::wall(Vec2::Zero());
  scene.side(mpm::Edge::Top) = mpm::Side::wall(Vec2(parameters_.lid_velocity, 0));
  scene.fluid = parameters_.fluid;
  return scene;
}

mpm::WallShares LidDrivenCavityFlow::wall_shares() const {
  mpm::WallShares shares;
  if (parameters_.smooth)
    shares[static_cast<std::size_t>(mpm::Edge::Top)] = [side = parameters_.side](double x) {
      const double s = x / side;
      return 16 * s * s * (1 - s) * (1 - s);
    };
  return shares;
}

std::optional<double> LidDrivenCavityFlow::reynolds() const {
  const auto nu = parameters_.curve.newtonian();
  if (!nu) return std::nullopt;
  return parameters_.lid_velocity * parameters_.side / *nu;
}

std::vector<reference::CavityPoint> LidDrivenCavityFlow::published() const {
  if (parameters_.smooth) return {};
  if (reynolds()) return reference::marchi_2009(*reynolds());
  const CavityTable* table = own_table();
  return table ? table->points : std::vector<reference::CavityPoint>();
}

const CavityTable* LidDrivenCavityFlow::own_table() const {
  if (reynolds() || parameters_.smooth || parameters_.curve.yielding()) return nullptr;
  const auto* fluid =
      reference::find_cavity_benchmark(parameters_.curve, parameters_.lid_velocity, parameters_.side);
  return fluid ? cavity_table(fluid->name) : nullptr;
}

bool LidDrivenCavityFlow::has_exact() const {
  if (parameters_.smooth) return reynolds().has_value();
  return !reynolds() || !published().empty();
}

std::optional<CostlyReference> LidDrivenCavityFlow::costly_reference(const std::vector<double>&) const {
  if (!has_exact() || !published().empty()) return std::nullopt;
  // Good at any time: the steady state.
  return CostlyReference{
      fmt::format("steady {} cavity, {}", parameters_.smooth ? "regularised" : "lid-driven",
                  parameters_.curve.describe()),
      std::numeric_limits<double>::infinity()};
}

std::shared_ptr<const ExactField> LidDrivenCavityFlow::exact(const std::vector<double>&) const {
  if (!has_exact()) return nullptr;
  if (parameters_.smooth) return smooth_field(*reynolds(), parameters_.side, parameters_.lid_velocity);
  std::vector<reference::CavityPoint> points = published();
  std::string description = "steady state: the tables of Marchi, Suero & Araki 2009, six digits";
  if (const CavityTable* table = own_table())
    description = fmt::format(
        "steady state: the table of this project (mpm-verify cavity-tables), to {:.1e} of the lid's velocity",
        table->largest_uncertainty);
  if (points.empty()) {
    double largest = 0;
    for (const reference::CavityLine& line : computed_lines(parameters_)) {
      points.push_back(line.point);
      largest = std::max(largest, line.uncertainty);
    }
    description = fmt::format(
        "steady state: finite volumes on {0}, {1} and {2} cells, extrapolated, to {3:.1e} of the lid's "
        "velocity",
        coarsest(parameters_.curve), 2 * coarsest(parameters_.curve), 4 * coarsest(parameters_.curve),
        largest);
  }
  return std::make_shared<TabulatedField>(points, parameters_.side, parameters_.lid_velocity, description);
}

mpm::VectorField LidDrivenCavityFlow::tabulated_points() const {
  mpm::VectorField points;
  if (!has_exact() || parameters_.smooth) return points;
  if (parameters_.curve.yielding()) {
    for (int j = 0; j <= lattice_squares; ++j)
      for (int i = 0; i <= lattice_squares; ++i)
        points.emplace_back(parameters_.side * i / lattice_squares, parameters_.side * j / lattice_squares);
    return points;
  }
  std::vector<reference::CavityPoint> places = published();
  if (places.empty()) places = reference::marchi_2009(100);  // for the values that are computed
  for (const reference::CavityPoint& point : places)
    points.emplace_back(parameters_.side * point.x, parameters_.side * point.y);
  return points;
}

}  // namespace verification
