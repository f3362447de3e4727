# One panel of tools/collision_figures.gnuplot: a power law through the points of every method. Needs: series.
do for [m = 1:n] {
  data = rows(series, m, 3, everything)
  stats data using (log($3 / 1000)):(log($5)) name 'S' nooutput
  a = S_mean_y; b = 1
  fit a + b * x data using (log($3 / 1000)):(log($5)) via a, b
  c0[m] = a; c1[m] = b
  print sprintf('| %s | %s | %.3g N^%.2f | %.0f %% | %.4f |', series, word(methods, m), exp(a), b, \
    100 * (exp(FIT_STDFIT) - 1), 1 - FIT_WSSR / (S_records * S_stddev_y ** 2))
}
plot for [m = 1:n] rows(series, m, 3, everything) using 3:5 with points pt 7 ps 0.7 lc rgb colour(m) title word(methods, m), \
  for [m = 1:n] exp(c0[m]) * (x / 1000)**c1[m] lc rgb colour(m) title sprintf('%.2g ms · (N/1000)^{%.2f}', exp(c0[m]), c1[m])
