# One panel of tools/figures/collision_figures.gnuplot: a line and a parabola through the points of every method,
# one standard deviation of the points from each, and R². Needs: figure, series, column_of_x, limit, and
# curved, which fit is the article's: that one is drawn with its standard deviation, the other one dashed.
set xrange [*:*]
furthest = 0
do for [m = 1:n] {
  data = rows(series, m, column_of_x, limit)
  stats data using (column(column_of_x) / 1000):5 name 'S' nooutput
  furthest = S_max_x > furthest ? S_max_x : furthest
  total = S_records * S_stddev_y ** 2
  a = S_mean_y; b = 1; c = 0.1
  fit a + b * x data using (column(column_of_x) / 1000):5 via a, b
  c0[m] = a; c1[m] = b; c_sd[m] = FIT_STDFIT; c_r2[m] = 1 - FIT_WSSR / total
  print sprintf('| %s | %s | %.3g %+.3g x | %.2g | %.4f |', figure, word(methods, m), a, b, c_sd[m], c_r2[m])
  # A parabola through three points has no deviation from them.
  q0[m] = a; q1[m] = b; q2[m] = 0; q_sd[m] = c_sd[m]; q_r2[m] = c_r2[m]
  if (S_records > 3) {
    fit a + b * x + c * x**2 data using (column(column_of_x) / 1000):5 via a, b, c
    q0[m] = a; q1[m] = b; q2[m] = c; q_sd[m] = FIT_STDFIT; q_r2[m] = 1 - FIT_WSSR / total
    print sprintf('| %s | %s | %.3g %+.3g x %+.3g x² | %.2g | %.4f |', figure, word(methods, m), a, b, c, q_sd[m], q_r2[m])
  }
}
solid(m, x) = curved ? parabola(m, x) : line(m, x)
dashed(m, x) = curved ? line(m, x) : parabola(m, x)
solid_sd(m) = curved ? q_sd[m] : c_sd[m]
solid_r2(m) = curved ? q_r2[m] : c_r2[m]
dashed_r2(m) = curved ? c_r2[m] : q_r2[m]

set xrange [0:1.05 * furthest]
set yrange [0:*]
set offsets 0, 0, graph 0.3, 0  # room for the key
plot for [m = 1:n] '+' using 1:(solid(m, $1) - solid_sd(m)):(solid(m, $1) + solid_sd(m)) \
    with filledcurves lc rgb colour(m) notitle, \
  for [m = 1:n] rows(series, m, column_of_x, limit) using (column(column_of_x) / 1000):5 \
    with points pt 7 ps 0.5 lc rgb colour(m) notitle, \
  for [m = 1:n] solid(m, x) lw 1.5 lc rgb colour(m) title sprintf('%s, %s: R² %.3f', name(m), curved ? 'quadratic' : 'linear', solid_r2(m)), \
  for [m = 1:n] dashed(m, x) dt 2 lw 1.5 lc rgb colour(m) title sprintf('%s: %.3f', curved ? 'linear' : 'quadratic', dashed_r2(m))
