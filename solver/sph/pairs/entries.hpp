#pragma once

#include "solver/particles.hpp"
#include "solver/sph/pairs/pair_loops.hpp"

namespace mpm::sph {

/// State of everything that a particle may meet, by slot.
struct Entries : EntryFields<ScalarField> {
  /// f(array) for all of them.
  template <class F>
  void each_array(const F& f) {
    for (ScalarField* field : {&position[0], &position[1], &velocity[0], &velocity[1], &mass, &pressure_term,
                               &inverse_density, &viscosity, &stress[0], &stress[1], &stress[2], &stress[3],
                               &wall_normal[0], &wall_normal[1], &wall_offset, &wall_depth})
      f(*field);
  }
  void clear(std::size_t slots) {
    each_array([&](ScalarField& field) { field.assign(slots, 0); });
  }

  [[nodiscard]] EntryFields<const double*> fields() const {
    return {{position[0].data(), position[1].data()},
            {velocity[0].data(), velocity[1].data()},
            mass.data(),
            pressure_term.data(),
            inverse_density.data(),
            viscosity.data(),
            {stress[0].data(), stress[1].data(), stress[2].data(), stress[3].data()},
            {wall_normal[0].data(), wall_normal[1].data()},
            wall_offset.data(),
            wall_depth.data()};
  }
};

}  // namespace mpm::sph
