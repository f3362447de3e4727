# One panel of tools/figures/collision_figures.gnuplot, in logarithmic axes: a line and a parabola through the points
# of every method by their relative deviations, as the times differ by factors. Needs: series.
do for [m = 1:n] {
  data = rows(series, m, 3, everything)
  stats data using (1 / $5) name 'S' nooutput
  total = S_records - S_sum ** 2 / S_sumsq  # of squared relative deviations from the weighted mean
  a = 1; b = 0.1; c = 1e-4
  fit a + b * x data using ($3 / 1000):5:5 yerrors via a, b
  c0[m] = a; c1[m] = b; c_sd[m] = 100 * FIT_STDFIT
  print sprintf('| %s | %s | %.3g %+.3g x | %.0f %% | %.4f |', figure, word(methods, m), a, b, c_sd[m], 1 - FIT_WSSR / total)
  if (S_records > 3) {
    fit a + b * x + c * x**2 data using ($3 / 1000):5:5 yerrors via a, b, c
    print sprintf('| %s | %s | %.3g %+.3g x %+.3g x² | %.0f %% | %.4f |', figure, word(methods, m), a, b, c, 100 * FIT_STDFIT, 1 - FIT_WSSR / total)
  }
}
plot for [m = 1:n] rows(series, m, 3, everything) using 3:5 with points pt 7 ps 0.5 lc rgb colour(m) notitle, \
  for [m = 1:n] line(m, x / 1000) lw 1.5 lc rgb colour(m) title sprintf('%s: σ %.0f %%', name(m), c_sd[m])
