#include <variant>

#include "tests/catch.hpp"
#include "verification/flows/fluid_reader.hpp"

using namespace verification;

TEST_CASE("solver and reference are told the same fluid, with every parameter off its default") {
  const char* const fluids[] = {
      "kinematic_viscosity = 3e-6\ndensity = 700\n",
      "model = \"cross\"\nkinematic_viscosity = 3e-6\ndensity = 700\ninfinite_viscosity_ratio = "
      "0.3\ntime_constant = 0.7\n",
      "model = \"cross\"\nkinematic_viscosity = 3e-6\ndensity = 700\ninfinite_viscosity_ratio = "
      "0.3\ntime_constant = 0.7\n"
      "exponent = 0.6\n",
      "model = \"cross\"\nkinematic_viscosity = 3e-6\ndensity = 700\ninfinite_viscosity_ratio = "
      "4\ntime_constant = 0.7\n"
      "exponent = 1.7\n",
      "model = \"power-law\"\nkinematic_viscosity = 3e-6\ndensity = 700\nindex = 0.7\nshear_rate_floor = "
      "1e-4\n",
      "model = \"power-law\"\nkinematic_viscosity = 3e-6\ndensity = 700\nindex = 1.6\nlargest_shear_rate = "
      "20\n",
      "model = \"carreau-yasuda\"\nkinematic_viscosity = 3e-6\ndensity = 700\ninfinite_viscosity_ratio = "
      "0.05\n"
      "time_constant = 2\nyasuda_exponent = 1.3\nindex = 0.4\n",
      "model = \"carreau-yasuda\"\nkinematic_viscosity = 3e-6\ndensity = 700\ninfinite_viscosity_ratio = "
      "0.05\n"
      "time_constant = 2\nyasuda_exponent = 0.8\nindex = 1.4\nlargest_shear_rate = 20\n"};
  for (const char* const text : fluids) {
    INFO(text);
    const FluidConfig fluid =
        read_fluid(TomlTable::from_text(std::string(text) + "pressure = false\n", "fluid.toml"), 20);
    CHECK(fluid.solver.density == 700);
    double largest = 0;
    for (const double rate : {1e-3, 0.05, 0.4, 1.0, 3.0, 17.0}) {
      const double mu = std::visit(
          [&](const auto& law) {
            if constexpr (std::decay_t<decltype(law)>::needs_shear_rate)
              return static_cast<double>(law.viscosity(rate * rate));
            else
              return law.viscosity();
          },
          fluid.solver.rheology);
      CHECK(mu / 700 == Approx(fluid.curve.viscosity(rate)).epsilon(1e-13));
      largest = std::max(largest, mu / 700);
    }
    // What an explicit step resolves is not less than anything that the fluid shows in the range it was told.
    CHECK(fluid.solver.largest_kinematic_viscosity() >= largest * (1 - 1e-12));
  }
}
