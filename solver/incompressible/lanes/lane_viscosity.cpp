// Compiled once for every instruction set, see CMakeLists.txt.
#include "solver/incompressible/lanes/lane_sites.hpp"

namespace mpm::MPM_ISA {

std::unique_ptr<SiteKernel> make_site_kernel(const SiteSetup& setup) {
  switch (setup.degree) {
    case 2:
      return std::make_unique<LaneSites<2>>(setup);
    case 3:
      return std::make_unique<LaneSites<3>>(setup);
    default:
      return std::make_unique<LaneSites<4>>(setup);
  }
}

void flow_curve(const Rheology& fluid, int count, const double* gdot_squared, double* viscosity) {
  std::visit(
      [&]<class Law>(const Law& law) {
        const auto at = [&](Lanes q) -> Lanes {
          if constexpr (Law::needs_shear_rate)
            return law.viscosity(q);
          else
            return law.viscosity();
        };
        int i = 0;
        for (; i + width <= count; i += width) store(viscosity + i, at(load(gdot_squared + i)));
        if (i == count) return;
        Lanes last = gdot_squared[i];  // harmless beyond the end
        for (int lane = 0; i + lane < count; ++lane) last[lane] = gdot_squared[i + lane];
        store_first(count - i, viscosity + i, at(last));
      },
      fluid);
}

}  // namespace mpm::MPM_ISA
