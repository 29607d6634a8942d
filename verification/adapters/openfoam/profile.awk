# The velocities of a field file U of OpenFOAM as rows of profile.csv. Cells are numbered along x first.
# "internalField uniform (u v w);" or "internalField nonuniform List<vector> N((u v w) ...);", in one line or in many.
/^internalField/ { reading = 1 }
reading {
  last = /;/
  gsub(/[();]/, " ")
  for (f = 1; f <= NF; ++f) word[++words] = $f
  if (last) reading = 0
  next
}

# Value of a component between centres and walls, linear in x and in y.
function column(field, i, j, lid) {
  if (j < 0) return 0
  if (j >= ny) return lid
  return field[i + nx * j]
}
function at(field, x, y, lid,    sx, sy, i, j, fx, fy, a, b) {
  sx = x / width * nx - 0.5; sy = y / height * ny - 0.5
  i = int(sx + 1) - 1; j = int(sy + 1) - 1
  fx = sx - i; fy = sy - j
  if (i < 0) fx = 2 * (fx - 0.5)              # from the wall: half a cell
  else if (i >= nx - 1) fx = 2 * fx
  if (j < 0) fy = 2 * (fy - 0.5)
  else if (j >= ny - 1) fy = 2 * fy
  if (i < 0) a = 0; else a = (1 - fy) * column(field, i, j, lid) + fy * column(field, i, j + 1, lid)
  if (i >= nx - 1) b = 0; else b = (1 - fy) * column(field, i + 1, j, lid) + fy * column(field, i + 1, j + 1, lid)
  return (1 - fx) * a + fx * b
}
END {
  if (word[2] != "uniform" && (word[4] != nx * ny || words != 4 + 3 * nx * ny)) {
    print "the field of " nx * ny " cells is not whole" > "/dev/stderr"
    exit 1
  }
  for (c = 0; c < nx * ny; ++c) {
    first = word[2] == "uniform" ? 3 : 5 + 3 * c
    u[c] = word[first]; v[c] = word[first + 1]
  }
  if (points_x != "") {
    count = split(points_x, px, " "); split(points_y, py, " ")
    for (k = 1; k <= count; ++k)
      printf "%s,grid,%s,%s,%.12g,%.12g\n", t, px[k], py[k], at(u, px[k], py[k], top), at(v, px[k], py[k], 0)
  }
  for (j = 0; j < ny; ++j)
    for (i = 0; i < (channel ? 1 : nx); ++i)
      printf "%s,grid,%.17g,%.17g,%.12g,%.12g\n", t, width * (i + 0.5) / nx, height * (j + 0.5) / ny, u[i + nx * j], v[i + nx * j]
}
