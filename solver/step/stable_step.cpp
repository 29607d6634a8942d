#include "solver/step/stable_step.hpp"

#include <algorithm>
#include <array>
#include <limits>

namespace mpm {
namespace {

/// By stepping: stress first (and modified last), stress last, leapfrog.
using Limits = std::array<StableStep, 3>;
enum TransferRow { FlipRow, PicRow, ApicRow, FullMassRow, TransferRows };
/// By basis and transfer.
using Table = std::array<std::array<Limits, TransferRows>, 3>;

// Predicted by verification/stability, rounded down to four digits.
constexpr Table one_particle = {{
    {{{{{0.1648, 0.7071}, {0.1420, 0.6666}, {0.1648, 0.7071}}},  // linear: flip
      {{{0.1648, 0.7071}, {0.1591, 0.7071}, {0.1648, 0.7071}}},  // pic
      {{{0.1648, 0.7071}, {0.1648, 0.7071}, {0.1648, 0.7071}}},  // apic
      {{{0, 0}, {0, 0}, {0, 0}}}}},                              // full mass
    {{{{{1.5000, 2.0000}, {0.1875, 0.7071}, {1.5000, 2.0000}}},  // quadratic
      {{{1.0928, 1.7071}, {0.1875, 0.7071}, {0.9053, 1.0000}}},  //
      {{{0.3750, 1.0000}, {0.3750, 1.0000}, {0.3750, 1.0000}}},  //
      {{{0, 0}, {0, 0}, {0, 0}}}}},                              //
    {{{{{2.7240, 2.6952}, {0.7039, 1.3700}, {2.7240, 2.6952}}},  // cubic
      {{{2.1331, 2.3850}, {0.7385, 1.4033}, {1.9443, 1.8371}}},  //
      {{{1.4261, 1.9501}, {1.0891, 1.7042}, {1.4136, 1.8371}}},  //
      {{{0, 0}, {0, 0}, {0, 0}}}}},
}};
constexpr Table two_particles = {{
    {{{{{0.6366, 1.3976}, {0.1727, 0.7410}, {0.6366, 1.3976}}},    // linear: flip
      {{{0.4808, 1.2152}, {0.1920, 0.7677}, {0.4285, 1.0000}}},    // pic
      {{{0.3094, 1.0000}, {0.2617, 1.0000}, {0.3081, 1.0000}}},    // apic
      {{{0.0383, 0.4226}, {0.0383, 0.4226}, {0.0383, 0.4226}}}}},  // full mass
    {{{{{1.8598, 2.2270}, {0.3894, 1.0191}, {1.8598, 2.2270}}},    // quadratic
      {{{1.4245, 1.9490}, {0.4099, 1.0455}, {1.2666, 1.3976}}},    //
      {{{0.8816, 1.5333}, {0.6027, 1.2678}, {0.8667, 1.3976}}},    //
      {{{0.0490, 0.4710}, {0.0490, 0.4710}, {0.0490, 0.4710}}}}},  //
    {{{{{2.7354, 2.7008}, {0.8000, 1.4606}, {2.7354, 2.7008}}},    // cubic
      {{{2.1582, 2.3990}, {0.8756, 1.5281}, {1.9861, 1.9016}}},    //
      {{{1.5241, 2.0160}, {1.1735, 1.7690}, {1.5111, 1.9016}}},    //
      {{{0.0502, 0.4649}, {0.0502, 0.4649}, {0.0502, 0.4649}}}}},
}};

std::size_t column(Scheme::Stepping stepping) {
  switch (stepping) {
    case Scheme::Stepping::Usl:
      return 1;
    case Scheme::Stepping::Leapfrog:
    case Scheme::Stepping::ImplicitSdirk2:
      return 2;
    default:
      return 0;
  }
}

StableStep entry(const Table& table, const Scheme& scheme, TransferRow row) {
  return table[static_cast<std::size_t>(scheme.basis)][row][column(scheme.stepping)];
}

}  // namespace

StableStep stable_step(const Scheme& scheme, int particles_per_cell) {
  const Table& table = particles_per_cell < 2 ? one_particle : two_particles;
  StableStep step{};
  switch (scheme.transfer) {
    case Scheme::Transfer::Flip:
      step = entry(table, scheme, FlipRow);
      break;
    case Scheme::Transfer::Pic:
      step = entry(table, scheme, PicRow);
      break;
    case Scheme::Transfer::FlipBlend: {
      const StableStep flip = entry(table, scheme, FlipRow), pic = entry(table, scheme, PicRow);
      step = {std::min(flip.viscous, pic.viscous), std::min(flip.acoustic, pic.acoustic)};
      break;
    }
    case Scheme::Transfer::Apic:
      step = entry(table, scheme, ApicRow);
      break;
    case Scheme::Transfer::FullMass:
      step = entry(table, scheme, FullMassRow);
      break;
  }
  if (scheme.stepping == Scheme::Stepping::ImplicitEuler ||
      scheme.stepping == Scheme::Stepping::ImplicitSdirk2)
    step.viscous = std::numeric_limits<double>::infinity();
  return step;
}

int fewest_particles_per_cell(const Scene& scene) {
  int fewest = std::numeric_limits<int>::max();
  for (const int axis : {0, 1}) {
    const auto a = static_cast<std::size_t>(axis);
    if (scene.cells[a] == 1 && scene.periodic(axis)) continue;  // nothing varies that way
    fewest = std::min(fewest, scene.particles_per_cell[a]);
  }
  return fewest;
}

}  // namespace mpm
