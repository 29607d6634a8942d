# A profile whose error is made, not computed: settled Couette flow plus
#   u: plate (a h^p + floor) sqrt(1 + h) sin(pi y / H),  v: plate across sin(pi y / H),  h in units of the gap,
# so that every norm, order and uncertainty is known in closed form. `bump` multiplies the error of the grid of that many
# cells by `times` (5). With history=1 it delivers a history too, whose mass grows by `mass` and whose momentum across the flow by
# `momentum` (in units of mass times plate velocity) to the end.
#   awk -v n=CELLS -v out=DIRECTORY -v a=1 -v p=2 -f ladder.awk
BEGIN {
  height = 1e-3; plate = 1e-4; end = 4; pi = 3.14159265358979323846
  if (a == "") a = 1
  if (p == "") p = 2
  error = a * (1 / n) ^ p + floor
  error *= sqrt((n + 1) / n)  # the mean over n + 1 points is then 1/sqrt(2), on every grid
  if (n == bump) error *= times ? times : 5
  file = out "/profile.csv"
  print "t,location,x,y,u,v" > file
  for (j = 0; j <= n; ++j) {
    y = j / n
    printf "%s,grid,0,%.17g,%.17g,%.17g\n", end, y * height, plate * (y + error * sin(pi * y)), plate * across * sin(pi * y) > file
  }
  if (!history) exit
  file = out "/history.csv"
  print "t,probe,mass,momentum_x,momentum_y,impulse_x,impulse_y,kinetic_energy" > file
  for (k = 0; k <= 20; ++k) {
    f = k / 20
    printf "%.17g,%.17g,%.17g,5e-8,%.17g,0,0,1e-12\n", f * end, plate / 2, 1e-3 * (1 + mass * f), 1e-7 * momentum * f > file
  }
}
