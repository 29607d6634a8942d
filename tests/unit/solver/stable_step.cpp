#include "solver/step/stable_step.hpp"

#include <algorithm>

#include "tests/catch.hpp"

using namespace mpm;

TEST_CASE("a blend of FLIP and PIC bears what both of them bear, for every basis and stepping") {
  for (std::size_t basis = 0; basis < basis_parts().size(); ++basis)
    for (std::size_t stepping = 0; stepping < stepping_parts().size(); ++stepping)
      for (const int particles : {1, 2}) {
        Scheme scheme;
        scheme.basis = static_cast<Scheme::Basis>(basis);
        scheme.stepping = static_cast<Scheme::Stepping>(stepping);
        const auto limit = [&](Scheme::Transfer transfer) {
          scheme.transfer = transfer;
          return stable_step(scheme, particles);
        };
        const StableStep flip = limit(Scheme::Transfer::Flip), pic = limit(Scheme::Transfer::Pic),
                         blend = limit(Scheme::Transfer::FlipBlend);
        INFO(name(scheme.basis) << " " << name(scheme.stepping) << " " << particles);
        CHECK(blend.viscous == std::min(flip.viscous, pic.viscous));
        CHECK(blend.acoustic == std::min(flip.acoustic, pic.acoustic));
      }
}
