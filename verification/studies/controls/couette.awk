# Couette start-up by central differences in space and explicit steps in time: somebody else's solver, sound but for the
# fault that `fault` names. The studies beside it plant one each.
#   awk -v n=CELLS -v out=DIRECTORY -v fault=NAME -f couette.awk
BEGIN {
  height = 1e-3; plate = 1e-4; viscosity = 1e-6
  if (fault == "viscosity") viscosity *= 1.01
  if (fault == "breaks") { print "iteration 17: residual 1e+80"; print "solver: no convergence, giving up"; exit 7 }
  if (fault == "silent") exit 0
  h = height / n
  file = out "/profile.csv"
  print "t,location,x,y,u,v" > file
  for (j = 0; j <= n; ++j) u[j] = 0
  u[n] = plate
  step = 0.25 * h * h / 1e-6
  for (k = 1; k <= 2; ++k) {
    count = int(0.1 / step + 0.5); r = viscosity * (0.1 / count) / (h * h)
    for (s = 0; s < count; ++s) {
      for (j = 1; j < n; ++j) w[j] = u[j] + r * (u[j + 1] - 2 * u[j] + u[j - 1])
      for (j = 1; j < n; ++j) u[j] = w[j]
      # The resting plate is felt half a cell too far out.
      if (fault == "wall") u[0] = u[1] / 3
    }
    if (fault == "missing-time" && k == 1) continue
    for (j = 0; j <= n; ++j) {
      if (fault == "walls-only" && j > 0 && j < n) continue
      value = sprintf("%.17g", u[j])
      if (fault == "nan" && k == 2 && j == 3) value = "nan"
      printf "%s,grid,0,%.17g,%s,0\n", k * 0.1, j * h, value > file
    }
  }
}
